#include "sim/render/volume_files.h"

#include "sim/scene/footprint_files.h"

namespace vegard::sim {

VolumeFiles read_volume_files(const Scene& scene) {
  VolumeFiles files;
  files.pictures = read_footprint_pictures(scene);
  return files;
}

}  // namespace vegard::sim
