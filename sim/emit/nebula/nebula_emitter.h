// A nebula's light along rays: emission and absorption, in rayleighs.
//
// A ray's path through the bound is cut at multiples of `step` from its point nearest to the middle; each
// piece is taken as uniform, with the values at its middle. From a piece of optical depth tau, (1 -
// exp(-tau)) / tau of its own light emerges, and exp(-tau) of the light behind it (S. Chandrasekhar,
// "Radiative Transfer", 1950, chapter I). Pieces that are certainly empty are skipped, which does not change
// the light. For T = FreeDual the derivatives are exactly those of this sum.
#pragma once

#include "sim/emit/nebula/nebula_cloud.h"
#include "sim/emit/nebula/nebula_frame.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

template <class T>
class NebulaEmitter : public Emitter<T> {
 public:
  /// `skip` false: empty pieces are not skipped; for tests.
  NebulaEmitter(const Scene& scene, const Nebula& nebula, const NumberAs<T>& number, bool skip = true);

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override;
  bool absorbs() const override { return cloud_.has_dust(); }

 private:
  void march_ray(const T enu[3], double end_km, std::size_t ray, std::size_t rays,
                 const BundleLight<T>& out) const;

  NebulaFrame<T> frame_;
  NebulaCloud<T> cloud_;
  double step_;
  bool skip_;
};

extern template class NebulaEmitter<double>;
extern template class NebulaEmitter<FreeDual>;

}  // namespace vegard::sim
