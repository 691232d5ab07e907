#include "sim/render/emitters.h"

namespace vegard::sim {

template <class T>
std::vector<std::unique_ptr<Emitter<T>>> make_emitters(const Scene&, const VolumeFiles&, const NumberAs<T>&,
                                                       int) {
  std::vector<std::unique_ptr<Emitter<T>>> all;
  return all;
}

template std::vector<std::unique_ptr<Emitter<double>>> make_emitters(const Scene&, const VolumeFiles&,
                                                                     const NumberAs<double>&, int);
template std::vector<std::unique_ptr<Emitter<FreeDual>>> make_emitters(const Scene&, const VolumeFiles&,
                                                                       const NumberAs<FreeDual>&, int);

}  // namespace vegard::sim
