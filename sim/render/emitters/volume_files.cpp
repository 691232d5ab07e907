#include "sim/render/emitters/volume_files.h"

#include <new>

#include "sim/base/error.h"
#include "sim/render/emitters/depth_file.h"
#include "sim/scene/file/named_files.h"
#include "sim/scene/file/volume_grid_file.h"

namespace vegard::sim {
namespace {

std::vector<std::shared_ptr<const GridBricks>> read_grids(const Scene& scene) {
  std::vector<std::shared_ptr<const GridBricks>> grids;
  for (const Volume& volume : scene.volumes) {
    const VolumeGridFile file = read_volume_grid(scene, volume);
    ErrorDetails details;
    try {
      const auto grid =
          std::make_shared<GridBricks>(file.grid, file.emission, file.density, file.place, file.site,
                                       scene.site, kMaxGridBytes, scene.body.radius_km);
      if (volume.home) grid->set_home(*volume.home, scene.site);
      grids.push_back(grid);
      continue;
    } catch (const Error& error) {
      details = error.details();
    } catch (const std::bad_alloc&) {
      details.problem = "there is not enough memory for its grids";
      details.file = file.place;
    }
    details.key = "volume." + volume.name + ".file";
    throw Error(ErrorKind::unreadable_input, details);
  }
  return grids;
}

}  // namespace

VolumeFiles read_volume_files(const Scene& scene) {
  VolumeFiles files;
  files.depth = read_depth(scene);
  files.pictures = read_scene_pictures(scene);
  files.maps = read_precipitation_maps(scene);
  files.grids = read_grids(scene);
  return files;
}

}  // namespace vegard::sim
