#include "sim/render/sun_emitters.h"

#include "sim/render/strand_emitters.h"

namespace vegard::sim {

template <class T>
void add_sun_emitters(const Scene& scene, const VolumeFiles& /*files*/, const NumberAs<T>& number,
                      int /*threads*/, std::vector<std::unique_ptr<Emitter<T>>>& all) {
  if (!scene.sun.shown) return;
  add_strand_emitters(scene, number, all);
}

template void add_sun_emitters(const Scene&, const VolumeFiles&, const NumberAs<double>&, int,
                               std::vector<std::unique_ptr<Emitter<double>>>&);
template void add_sun_emitters(const Scene&, const VolumeFiles&, const NumberAs<FreeDual>&, int,
                               std::vector<std::unique_ptr<Emitter<FreeDual>>>&);

}  // namespace vegard::sim
