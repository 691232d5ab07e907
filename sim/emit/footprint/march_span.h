// A stretch of a ray cut into steps.
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/base/dual.h"
#include "sim/base/earth.h"
#include "sim/emit/footprint/ray_span.h"
#include "sim/emit/footprint/step_profile.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

inline constexpr int kBlockSteps = 16;  ///< steps that are marched, or passed over, together

/// About a place in its middle, so that floats keep their digits. T is double or FreeDual.
template <class T>
struct MarchSpanOf {
  T place_km[3];   ///< from the Earth's centre
  T direction[3];  ///< of length 1
  T square_km2;    ///< of the place, see AirPoint
  T along_km;      ///< the part of the place along the direction
  T at_km;         ///< where on the ray the place is
  T first_km;      ///< where the first step begins, from the place: negative
  T step_km;
  int steps;
};
using MarchSpan = MarchSpanOf<double>;

/// Cuts rays from the scene's observer into spans with steps.
class MarchRays {
 public:
  /// In the observer's axes for a box, in the Earth's for a shell.
  MarchRays(const Scene& scene, const Footprint& footprint, double bottom_km);

  /// Each span has a whole number of equal steps, not longer than march.step_km, so that a ray's light does
  /// not jump as the ray is turned a little.
  template <class T>
  int cut(const T enu[3], double end_km, MarchSpanOf<T> out[2]) const {
    const double r0 = kEarthRadiusKm + observer_km_;
    // The source's rule against ghosts takes what lies ahead of the Earth's middle, on either side of the
    // camera.
    const T from = literal_ghosts_ ? enu[2] * -r0 : T(0.0);
    RaySpan<T> spans[2];
    const int count = shell_spans(observer_km_, enu[2], bottom_km_, top_km_, from, end_km, spans);
    for (int i = 0; i < count; ++i) {
      const T length = spans[i].to_km - spans[i].from_km;
      const T middle = (spans[i].from_km + spans[i].to_km) * 0.5;
      MarchSpanOf<T>& span = out[i];
      const T place[3] = {middle * enu[0], middle * enu[1], middle * enu[2] + r0};
      for (int a = 0; a < 3; ++a) {
        span.place_km[a] = place[0] * axes_[0][a] + place[1] * axes_[1][a] + place[2] * axes_[2][a];
        span.direction[a] = enu[0] * axes_[0][a] + enu[1] * axes_[1][a] + enu[2] * axes_[2][a];
      }
      span.square_km2 =
          middle * (middle + enu[2] * (2.0 * r0)) + observer_km_ * (observer_km_ + 2.0 * kEarthRadiusKm);
      span.along_km = enu[2] * r0 + middle;
      span.at_km = middle;
      span.steps = std::max(1, static_cast<int>(std::ceil(value_of(length) / step_km_ - 1e-9)));
      span.step_km = length * (1.0 / span.steps);
      span.first_km = length * -0.5;
    }
    return count;
  }

 private:
  double observer_km_, bottom_km_, top_km_, step_km_;
  bool literal_ghosts_;
  double axes_[3][3];  ///< east, north and up
};

/// The table of the profile whose width is nearest to the altitude that the steps of a block pass through.
inline int width_of_block(const StepProfile& profile, const MarchSpan& span, int first_step) {
  const double u = span.first_km + (first_step + 0.5 * kBlockSteps) * span.step_km;
  const double square = span.square_km2 + u * (2.0 * span.along_km + u) + kEarthRadiusKm * kEarthRadiusKm;
  const double rise_km = std::fabs(span.along_km + u) / std::sqrt(square) * span.step_km;
  return std::min(static_cast<int>(rise_km / profile.width_step_km() + 0.5), profile.widths() - 1);
}

}  // namespace vegard::sim
