// A map as its directory holds it, for a later fit: its curtains, and the photographs from which they were
// found.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/curtains/curtain_sheets.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Version of the format of map.json; it grows when a later vegard writes the file differently.
inline constexpr int kMapFormat = 1;

/// File names of the tables of curtains in a map's directory.
inline constexpr const char* kCurtainTable = "curtains.csv";
inline constexpr const char* kFaintCurtainTable = "faint_curtains.csv";

struct StoredMap {
  /// Facts about one photograph that was mapped.
  struct Picture {
    std::string name;  ///< of its entry; empty if it is the only one
    int width_px = 0, height_px = 0;
    double latitude_deg = 0.0, longitude_deg = 0.0;
  };

  std::string directory;
  std::vector<Picture> pictures;
  std::vector<InputFile> inputs;
  std::vector<Ridge> curtains;         ///< those long enough for a curve, by energy: "curtain_1", "curtain_2"
  std::vector<Ridge> faint;            ///< "faint_1": ridges below the brightness limit, in the same order
  std::vector<std::string> decodings;  ///< of the photographs, in the words of a report
  double altitude_scale = 1.0;
  std::string spectrum = "maxwellian";
  std::vector<double> modes;  ///< of the emission tables' uncertainty, as the map has them
  std::string sha256;         ///< of all files that were read
};

/// Reads a map's directory. Throws sim::Error(unreadable_input) if it is not a map's directory, was written
/// by another version of vegard or in another format, or holds an interrupted map, damaged files, or no
/// curtain.
StoredMap read_stored_map(const std::string& directory);

/// Checks that a map was made from these inputs (by the bytes of the photographs) with the same decodings,
/// and for the scene's site and picture size. Throws sim::Error(scene) if not.
void check_same_subject(const StoredMap& record, const sim::Scene& scene,
                        const std::vector<InputFile>& inputs, const std::vector<std::string>& decodings);

}  // namespace vegard::fit
