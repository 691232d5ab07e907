// Writes points with their light to a file for graphics programs: PLY, or CSV.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/file/whole_file.h"
#include "sim/render/beams/points.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/colour/colour.h"

namespace vegard::apps {

enum class PointFormat { ply, csv };

/// The format by the extension, in upper or lower case. Throws Error(usage).
PointFormat point_format(const std::string& path);

/// A file to which points are written in parts; its contents are described in docs/file_formats.md.
class PointFile {
 public:
  /// `unit`: "km" or "m". `every`: only every such point was kept. Throws as sim::WholeFile.
  PointFile(const std::string& path, const sim::Scene& scene, const std::string& unit, int every,
            bool overwrite);

  /// Throws Error(unwritable_output).
  void write(const sim::EmissionPoints& points);

  /// Fills in the number of points and gives the file its final name. Throws Error(unwritable_output,
  /// existing_output).
  void commit();

 private:
  struct Closer {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };

  std::string header() const;
  void put(const std::string& bytes);

  std::string path_;
  PointFormat format_;
  std::string unit_;
  std::vector<std::string> remarks_, columns_;
  std::vector<sim::Vector3> rgb_;  ///< colour of each line, per photon
  float scale_;
  std::uint64_t count_ = 0;
  sim::WholeFile file_;
  std::unique_ptr<std::FILE, Closer> stream_;
};

}  // namespace vegard::apps
