#include "sim/render/volume_files.h"

#include "sim/render/depth_file.h"
#include "sim/scene/footprint_files.h"

namespace vegard::sim {

VolumeFiles read_volume_files(const Scene& scene) {
  VolumeFiles files;
  files.depth = read_depth(scene);
  files.pictures = read_footprint_pictures(scene);
  return files;
}

}  // namespace vegard::sim
