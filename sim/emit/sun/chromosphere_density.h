// The density of a chromosphere: turbulence with a cutoff, plus a bias from a map (rows C2 to C5 of the
// source).
//
//   x(place)  = sum over octaves i of roughness^i |n(1.99^i p)|,   p = place / scale + shift,
//   F(x)      = amplitude (1 - exp(-(x - coverage) sharpness)), 0 where that is negative,
//   density   = F(x) + peak texel(latitude, longitude), 0 where that is negative;
// without the cutoff F(x) is x. The turbulence is that of M. Pharr and G. Humphreys, "Physically based
// rendering" (2004), chapter 11, whose lattice becomes finer by 1.99 and not 2 per octave, so that the zeros
// of the lattices do not coincide; n is the gradient noise of sim/base/number/noise.h. Where the Sun
// turns (solar_rotation.h), noise and map are evaluated at the place that has moved to this point by the
// instant.
#pragma once

#include <memory>
#include <optional>

#include "sim/base/image.h"
#include "sim/base/number/noise.h"
#include "sim/emit/sun/latitude_map.h"
#include "sim/emit/sun/solar_rotation.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The function F of this file's first comment.
template <class T>
T cloud_cutoff(const T& x, const T& coverage, const T& sharpness, const T& amplitude) {
  const T over = (x - coverage) * sharpness;
  if (!(value_of(over) > 0.0)) return T(0.0);
  return amplitude * (T(1.0) - exponential(T(0.0) - over));
}

template <class T>
class ChromosphereDensity {
 public:
  /// The density of chromosphere `index` of the scene at an instant of its clock; by default at time.start_s.
  /// `biasmap` is its picture, with one channel, or null; it must outlive this object.
  ChromosphereDensity(const Scene& scene, int index, const Image* biasmap, const NumberAs<T>& number,
                      std::optional<double> instant_s = std::nullopt);

  /// Returns the density at a place in the Sun's frame, without regard to the inner and outer radius.
  T at(const T place[3]) const;

 private:
  /// Returns the turbulence x; if x is certain to be below `least`, it may return any number below `least`.
  T turbulence(const T place[3], double least) const;

  T at_first(const T place[3]) const;

  NoiseLattice lattice_;
  SolarTurn turn_;
  int octaves_;
  bool cutoff_;
  T roughness_, per_scale_, shift_[3], coverage_, sharpness_, amplitude_, peak_;
  std::optional<LatitudeMap> biasmap_;
};

extern template class ChromosphereDensity<double>;
extern template class ChromosphereDensity<FreeDual>;

}  // namespace vegard::sim
