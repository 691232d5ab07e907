#include "sim/render/volume_files.h"

#include "sim/render/depth_file.h"

namespace vegard::sim {

VolumeFiles read_volume_files(const Scene& scene) {
  VolumeFiles files;
  files.depth = read_depth(scene);
  return files;
}

}  // namespace vegard::sim
