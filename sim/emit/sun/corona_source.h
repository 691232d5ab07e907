// The light that a corona emits or scatters at a place.
//
//   density = density0 (Σ share (r / R)^-power) (1 + (polar - 1) sin²(latitude)),
// and the light is the density, its square, or, for "scattered", the density times the photosphere's light
// that is scattered at the place to the observer (sim/emit/sun/thomson.h), relative to that scattered at a
// right angle at the photosphere.
#pragma once

#include <vector>

#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

template <class T>
class CoronaSource {
 public:
  CoronaSource(const Scene& scene, const Corona& corona, const NumberAs<T>& number);

  /// `square` is r², in the Sun's unit.
  T density(const T& square, const T& square_sine_latitude) const;
  /// Returns the factor on `rayleigh` of the scene; chi is the angle between the vertical and the direction
  /// to the observer.
  T light(const T& square, const T& square_sine_latitude, const T& square_sine_chi) const;

 private:
  CoronaLight kind_;
  double square_radius_;
  T density_, polar_, darkening_, darkening_square_, scattered_below_;
  std::vector<T> share_, power_;
};

extern template class CoronaSource<double>;
extern template class CoronaSource<FreeDual>;

}  // namespace vegard::sim
