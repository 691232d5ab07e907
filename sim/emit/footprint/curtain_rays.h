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
#include "sim/base/number/smooth_step.h"
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

  /// Returns the factor on the light at a distance from the curve's beginning, by cubic convolution (R. Keys,
  /// 1981) of its logarithm. `length_km` is the curve's, with its derivatives. T is double or FreeDual.
  template <class T>
  T factor(const T& along_km, const T& length_km) const {
    if (!any()) return T(1.0);
    if (!closed_) return exponential(ln_factor(along_km));
    const T half_km = length_km * 0.5;
    const T passage_km = value_of(half_km) < longest_passage_km_ ? half_km : T(longest_passage_km_);
    const T past_km = along_km - (length_km - passage_km);
    if (!(value_of(past_km) > 0.0)) return exponential(ln_factor(along_km));
    // Both have unit variance, and so has their sum.
    const double middle = 0.5 * contrast_ * contrast_;
    const T share = smooth_step(past_km / passage_km), rest = T(1.0) - share;
    const T sum = (ln_factor(along_km) + middle) * rest + (ln_factor(along_km - length_km) + middle) * share;
    return exponential(sum / square_root(rest * rest + share * share) - middle);
  }
  double factor(double along_km) const { return factor(along_km, length_km_); }

 private:
  template <class T>
  T ln_factor(const T& along_km) const {
    const T place = along_km * (1.0 / step_km_) - static_cast<double>(first_);
    const int last = static_cast<int>(ln_factor_.size()) - 1;
    const int i = std::clamp(static_cast<int>(std::floor(value_of(place))), 0, std::max(0, last - 1));
    const auto node = [&](int k) { return ln_factor_[std::clamp(k, 0, last)]; };
    const double p[4] = {node(i - 1), node(i), node(i + 1), node(i + 2)};
    const T t = place - static_cast<double>(i);
    const double bend = 2.0 * p[0] - 5.0 * p[1] + 4.0 * p[2] - p[3],
                 twist = 3.0 * (p[1] - p[2]) + p[3] - p[0];
    return t * (t * (t * twist + bend) + (p[2] - p[0])) * 0.5 + p[1];
  }

  double step_km_ = 1.0;
  double length_km_ = 0.0;
  bool closed_ = false;
  double contrast_ = 0.0;
  double longest_passage_km_ = 0.0;
  int first_ = 0;                  ///< step of the first number
  std::vector<double> ln_factor_;  ///< at multiples of the step
};

}  // namespace vegard::sim
