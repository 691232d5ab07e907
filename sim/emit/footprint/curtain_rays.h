// The rays of a curtain: its light varies along the foot as a sheet's does.
//
// The law is that of a sheet's rays (sim/emit/aurora/beam_light.h): exp(c g - c²/2), g a Gaussian process of
// unit variance, which is 1 in the mean. It goes by the distance along the curve, so that rays lie along the
// lines of fall and move with the curve.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/base/number/dual.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {

class CurtainRays {
 public:
  /// No rays: the factor is 1 everywhere.
  CurtainRays() = default;

  /// The rays at an instant on a curve of this length. On a closed curve they pass into each other where its
  /// ends meet.
  CurtainRays(const Footprint& footprint, std::uint64_t seed, double instant_s, double length_km,
              bool closed);

  bool any() const { return !ln_factor_.empty(); }

  /// Returns the factor on the light, by cubic convolution (R. Keys, 1981) of its logarithm. T is double or
  /// FreeDual.
  template <class T>
  T factor(const T& along_km) const {
    if (!any()) return T(1.0);
    const T place = along_km * (1.0 / step_km_);
    const int last = static_cast<int>(ln_factor_.size()) - 1;
    const int i = std::clamp(static_cast<int>(std::floor(value_of(place))), 0, std::max(0, last - 1));
    const auto node = [&](int k) { return ln_factor_[std::clamp(k, 0, last)]; };
    const double p[4] = {node(i - 1), node(i), node(i + 1), node(i + 2)};
    const T t = place - static_cast<double>(i);
    const double bend = 2.0 * p[0] - 5.0 * p[1] + 4.0 * p[2] - p[3],
                 twist = 3.0 * (p[1] - p[2]) + p[3] - p[0];
    return exponential(t * (t * (t * twist + bend) + (p[2] - p[0])) * 0.5 + p[1]);
  }

 private:
  double step_km_ = 1.0;
  std::vector<double> ln_factor_;  ///< at multiples of the step
};

}  // namespace vegard::sim
