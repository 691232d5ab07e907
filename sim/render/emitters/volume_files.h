// What a scene's volumes read from files.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/emit/grid/grid_bricks.h"
#include "sim/scene/file/precipitation_file.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/film/depth_image.h"

namespace vegard::sim {

struct VolumeFiles {
  DepthImage depth;                              ///< march.depth
  std::map<std::string, Image> pictures;         ///< one channel, 0 to 1, by the name that the scene has
  std::map<std::string, PrecipitationMap> maps;  ///< of precipitation, likewise
  std::vector<std::shared_ptr<const GridBricks>> grids;  ///< [volume of the scene]
};

/// Throws Error(unreadable_input) that names the key.
VolumeFiles read_volume_files(const Scene& scene);

/// Null if it has none. It lives as long as `files`.
inline const Image* bias_map(const VolumeFiles& files, const Chromosphere& chromosphere) {
  const auto found = files.pictures.find(chromosphere.biasmap);
  return found == files.pictures.end() ? nullptr : &found->second;
}

}  // namespace vegard::sim
