#include "sim/render/volume_files.h"

#include "sim/render/footprint_pictures.h"

namespace vegard::sim {

VolumeFiles read_volume_files(const Scene& scene) {
  VolumeFiles files;
  read_footprint_pictures(scene, files);
  return files;
}

}  // namespace vegard::sim
