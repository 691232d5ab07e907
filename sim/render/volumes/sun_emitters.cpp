#include "sim/render/volumes/sun_emitters.h"

#include "sim/emit/sun/chromosphere_emitter.h"
#include "sim/emit/sun/corona_emitter.h"
#include "sim/emit/sun/photosphere_emitter.h"
#include "sim/render/volumes/bias_map.h"
#include "sim/render/volumes/loop_grid.h"
#include "sim/render/volumes/strand_emitters.h"

namespace vegard::sim {

template <class T>
void add_sun_emitters(const Scene& scene, const VolumeFiles& files, const NumberAs<T>& number, int threads,
                      std::vector<std::unique_ptr<Emitter<T>>>& all) {
  if (!scene.sun.shown) return;
  all.push_back(std::make_unique<PhotosphereEmitter<T>>(scene, number));
  for (std::size_t c = 0; c < scene.chromospheres.size(); ++c)
    all.push_back(std::make_unique<ChromosphereEmitter<T>>(scene, static_cast<int>(c),
                                                           bias_map(files, scene.chromospheres[c]), number));
  for (const Corona& corona : scene.coronae)
    all.push_back(std::make_unique<CoronaEmitter<T>>(scene, corona, number));
  add_strand_emitters(scene, number, all);
  for (std::size_t i = 0; i < scene.loops.size(); ++i)
    if (scene.loops[i].voxel > 0.0)
      all.push_back(loop_grid_emitter<T>(scene, static_cast<std::uint32_t>(i), number, threads));
}

template void add_sun_emitters(const Scene&, const VolumeFiles&, const NumberAs<double>&, int,
                               std::vector<std::unique_ptr<Emitter<double>>>&);
template void add_sun_emitters(const Scene&, const VolumeFiles&, const NumberAs<FreeDual>&, int,
                               std::vector<std::unique_ptr<Emitter<FreeDual>>>&);

}  // namespace vegard::sim
