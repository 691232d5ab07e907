#include "sim/render/light_fields.h"

#include "sim/emit/grid/grid_field.h"
#include "sim/emit/nebula/nebula_field.h"
#include "sim/emit/sun/ejection_shell.h"
#include "sim/emit/sun/sun_fields.h"
#include "sim/render/bias_map.h"
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
  for (std::size_t c = 0; c < scene.chromospheres.size(); ++c)
    all.push_back({"chromosphere '" + scene.chromospheres[c].name + "'",
                   std::make_unique<ChromosphereField>(scene, static_cast<int>(c),
                                                       bias_map(files, scene.chromospheres[c]))});
  for (const Corona& corona : scene.coronae)
    all.push_back({"corona '" + corona.name + "'", std::make_unique<CoronaField>(scene, corona)});
  if (scene.sun.shown)
    for (const Ejection& ejection : scene.ejections)
      if (ejection.kind == "shell")
        all.push_back(
            {"ejection '" + ejection.name + "'", std::make_unique<EjectionShellField>(scene, ejection)});
  return all;
}

}  // namespace vegard::sim
