// A map's directory as a later fit reads it: its curtains, and what they were found in.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/curtain_sheets.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Of map.json: a later vegard that writes it otherwise counts on.
inline constexpr int kMapFormat = 1;

/// Names of the tables of curtains in a map's directory.
inline constexpr const char* kCurtainTable = "curtains.csv";
inline constexpr const char* kFaintCurtainTable = "faint_curtains.csv";

struct MapRecord {
  /// Of one photograph that was mapped.
  struct Picture {
    std::string name;  ///< of its entry; empty if it is the only one
    int width_px = 0, height_px = 0;
    double latitude_deg = 0.0, longitude_deg = 0.0;
  };

  std::string directory;
  std::vector<Picture> pictures;
  std::vector<InputFile> inputs;
  std::vector<Ridge> curtains;  ///< those long enough for a curve: "curtain_1", "curtain_2": that which
                                ///< carries most energy first
  std::vector<Ridge> faint;     ///< "faint_1": ridges below the brightness limit, likewise
  std::vector<std::string> decodings;  ///< of the photographs, as a report words them
  double altitude_scale = 1.0;
  std::string sha256;  ///< of all that was read
};

/// Throws sim::Error(unreadable_input) for what is no map's directory, one of another version or format of
/// vegard, a map that was interrupted, files that are damaged, and a map without a curtain.
MapRecord read_map_record(const std::string& directory);

/// That a map is of these inputs (by the bytes of the photographs), decoded likewise, and of the scene's site
/// and size. Throws sim::Error(scene).
void check_same_subject(const MapRecord& record, const sim::Scene& scene,
                        const std::vector<InputFile>& inputs, const std::vector<std::string>& decodings);

}  // namespace vegard::fit
