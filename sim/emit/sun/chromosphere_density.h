// The density of a chromosphere: turbulence, cut off, and a bias from a map (rows C2 to C5 of the source).
//
//   x(place)  = sum over octaves i of roughness^i |n(1.99^i p)|,   p = place / scale + shift,
//   F(x)      = amplitude (1 - exp(-(x - coverage) sharpness)), 0 where that is negative,
//   density   = F(x) + peak texel(latitude, longitude), 0 where that is negative;
// without the cutoff x stands for F(x). The turbulence is that of M. Pharr and G. Humphreys, "Physically
// based rendering" (2004), chapter 11, whose lattice is 1.99 and not 2 times finer by the octave so that the
// zeros of the lattices do not fall together; n is the gradient noise of sim/base/number/noise_lattice.h.
// Where the Sun turns (solar_rotation.h), noise and map are those of the place that has come here by then.
#pragma once

#include <memory>
#include <optional>

#include "sim/base/image.h"
#include "sim/base/number/noise_lattice.h"
#include "sim/emit/sun/latitude_map.h"
#include "sim/emit/sun/solar_rotation.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// F of the head of this file.
template <class T>
T cloud_cutoff(const T& x, const T& coverage, const T& sharpness, const T& amplitude) {
  const T over = (x - coverage) * sharpness;
  if (!(value_of(over) > 0.0)) return T(0.0);
  return amplitude * (T(1.0) - exponential(T(0.0) - over));
}

template <class T>
class ChromosphereDensity {
 public:
  /// Of chromosphere `index` of the scene, at an instant of its clock: without one, at time.start_s.
  /// `biasmap` is its picture, of one channel, or null; it must outlive this.
  ChromosphereDensity(const Scene& scene, int index, const Image* biasmap, const NumberAs<T>& number,
                      std::optional<double> instant_s = std::nullopt);

  /// At a place in the Sun's frame, whatever the two radii are.
  T at(const T place[3]) const;

 private:
  /// The turbulence x; where it stays below `least` for certain, anything below that.
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
