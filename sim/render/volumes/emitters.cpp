#include "sim/render/volumes/emitters.h"

#include "sim/emit/grid/grid_emitter.h"
#include "sim/emit/nebula/nebula_emitter.h"
#include "sim/render/volumes/footprint_volumes.h"
#include "sim/render/volumes/sun_emitters.h"

namespace vegard::sim {

template <class T>
std::vector<std::unique_ptr<Emitter<T>>> make_emitters(const Scene& scene, const VolumeFiles& files,
                                                       const NumberAs<T>& number, int threads) {
  std::vector<std::unique_ptr<Emitter<T>>> all;
  for (const Footprint& footprint : scene.footprints)
    all.push_back(footprint_emitter<T>(scene, footprint, files, number, threads));
  for (const Nebula& nebula : scene.nebulae)
    if (nebula.method != NebulaMethod::literal)
      all.push_back(std::make_unique<NebulaEmitter<T>>(scene, nebula, number));
  for (std::size_t v = 0; v < scene.volumes.size(); ++v)
    all.push_back(std::make_unique<GridEmitter<T>>(*files.grids[v], scene.volumes[v], number, &scene.sun));
  add_sun_emitters(scene, files, number, threads, all);
  return all;
}

template std::vector<std::unique_ptr<Emitter<double>>> make_emitters(const Scene&, const VolumeFiles&,
                                                                     const NumberAs<double>&, int);
template std::vector<std::unique_ptr<Emitter<FreeDual>>> make_emitters(const Scene&, const VolumeFiles&,
                                                                       const NumberAs<FreeDual>&, int);

}  // namespace vegard::sim
