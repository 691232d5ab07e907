#include "sim/render/emitters.h"

#include "sim/emit/nebula/nebula_emitter.h"

namespace vegard::sim {

template <class T>
std::vector<std::unique_ptr<Emitter<T>>> make_emitters(const Scene& scene, const VolumeFiles&,
                                                       const NumberAs<T>& number, int) {
  std::vector<std::unique_ptr<Emitter<T>>> all;
  for (const Nebula& nebula : scene.nebulae)
    if (nebula.method != "literal") all.push_back(std::make_unique<NebulaEmitter<T>>(scene, nebula, number));
  return all;
}

template std::vector<std::unique_ptr<Emitter<double>>> make_emitters(const Scene&, const VolumeFiles&,
                                                                     const NumberAs<double>&, int);
template std::vector<std::unique_ptr<Emitter<FreeDual>>> make_emitters(const Scene&, const VolumeFiles&,
                                                                       const NumberAs<FreeDual>&, int);

}  // namespace vegard::sim
