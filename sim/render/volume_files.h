// What a scene's volumes read from files.
#pragma once

#include <map>
#include <string>

#include "sim/base/image.h"
#include "sim/scene/scene.h"
#include "sim/view/depth_image.h"

namespace vegard::sim {

struct VolumeFiles {
  DepthImage depth;                       ///< march.depth
  std::map<std::string, Image> pictures;  ///< one channel, 0 to 1, by the name that the scene has
};

/// Throws Error(unreadable_input) that names the key.
VolumeFiles read_volume_files(const Scene& scene);

}  // namespace vegard::sim
