#include "sim/render/volume_files.h"

#include "sim/scene/volume_grid_file.h"

namespace vegard::sim {

namespace {

void read_grids(const Scene& scene, VolumeFiles& files) {
  for (const Volume& volume : scene.volumes) {
    const VolumeGridFile file = read_volume_grid(scene, volume);
    files.grids.push_back(std::make_shared<const GridBricks>(file.grid, file.emission, file.density,
                                                             file.place, file.site, scene.site));
  }
}

}  // namespace

VolumeFiles read_volume_files(const Scene& scene) {
  VolumeFiles files;
  read_grids(scene, files);
  return files;
}

}  // namespace vegard::sim
