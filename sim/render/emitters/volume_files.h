// The files that a scene's volumes are made from.
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
  DepthImage depth;                                      ///< march.depth
  std::map<std::string, Image> pictures;                 ///< one channel, 0 to 1, by the name in the scene
  std::map<std::string, PrecipitationMap> maps;          ///< maps of precipitation, by the name in the scene
  std::vector<std::shared_ptr<const GridBricks>> grids;  ///< [volume of the scene]
};

/// Reads all files. Throws Error(unreadable_input) that names the key.
VolumeFiles read_volume_files(const Scene& scene);

/// Returns the chromosphere's map of bias, which lives as long as `files`; null if it has none.
inline const Image* bias_map(const VolumeFiles& files, const Chromosphere& chromosphere) {
  const auto found = files.pictures.find(chromosphere.biasmap);
  return found == files.pictures.end() ? nullptr : &found->second;
}

}  // namespace vegard::sim
