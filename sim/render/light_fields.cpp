#include "sim/render/light_fields.h"

#include "sim/emit/grid/grid_field.h"
#include "sim/emit/nebula/nebula_field.h"
#include "sim/render/footprint_volumes.h"

namespace vegard::sim {

std::vector<NamedField> light_fields(const Scene& scene, const VolumeFiles& files, int threads) {
  std::vector<NamedField> all;
  for (const Footprint& footprint : scene.footprints)
    all.push_back({"footprint '" + footprint.name + "'", footprint_field(scene, footprint, files, threads)});
  for (const Nebula& nebula : scene.nebulae)
    all.push_back({"nebula '" + nebula.name + "'", std::make_unique<NebulaField>(scene, nebula)});
  for (std::size_t v = 0; v < scene.volumes.size(); ++v)
    all.push_back({"volume '" + scene.volumes[v].name + "'",
                   std::make_unique<GridField>(*files.grids[v], scene.volumes[v], &scene.sun)});
  return all;
}

}  // namespace vegard::sim
