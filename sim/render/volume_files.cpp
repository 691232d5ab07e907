#include "sim/render/volume_files.h"

#include "sim/render/depth_file.h"
#include "sim/scene/footprint_files.h"
#include "sim/scene/volume_grid_file.h"

namespace vegard::sim {
namespace {

std::vector<std::shared_ptr<const GridBricks>> read_grids(const Scene& scene) {
  std::vector<std::shared_ptr<const GridBricks>> grids;
  for (const Volume& volume : scene.volumes) {
    const VolumeGridFile file = read_volume_grid(scene, volume);
    grids.push_back(std::make_shared<const GridBricks>(file.grid, file.emission, file.density, file.place, file.site,
                                                       scene.site));
  }
  return grids;
}

}  // namespace

VolumeFiles read_volume_files(const Scene& scene) {
  VolumeFiles files;
  files.depth = read_depth(scene);
  files.pictures = read_footprint_pictures(scene);
  files.grids = read_grids(scene);
  return files;
}

}  // namespace vegard::sim
