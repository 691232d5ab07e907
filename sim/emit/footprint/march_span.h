// Cuts rays through a footprint into stretches (spans) of equal steps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/emit/footprint/step_profile.h"
#include "sim/light/field/field_patch.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

// The stretches of a ray inside a spherical shell of air.
//
// A ray from the radius r0 with the direction's upward part u comes closest to the body's centre at t_c =
// -r0 u, and meets the sphere of radius R at t_c -+ sqrt(t_c^2 + R^2 - r0^2): the path at the limb is exact.

/// Beginning and end of a stretch, in km along a ray.
template <class T>
struct RaySpan {
  T from_km, to_km;
};

/// Finds the spans between two altitudes, in their order along the ray: none, one, or one before and one
/// behind the point closest to the body's centre. They are cut to the range from `from_km` to `end_km`.
template <class T>
int shell_spans(double observer_altitude_km, const T& up, double bottom_km, double top_km, const T& from_km,
                double end_km, double sphere_km, RaySpan<T> out[2]) {
  const double r0 = sphere_km + observer_altitude_km;
  const T closest = up * -r0;
  const auto half_chord_squared = [&](double altitude_km) {
    const double radius = sphere_km + altitude_km;
    return closest * closest + (radius - r0) * (radius + r0);
  };
  // A chord of a metre is none: its length has no derivative where it vanishes.
  constexpr double kMin = 1e-6;
  const T outer2 = half_chord_squared(top_km), inner2 = half_chord_squared(bottom_km);
  if (value_of(outer2) <= kMin) return 0;
  const T outer = square_root(outer2);
  RaySpan<T> all[2] = {{closest - outer, closest + outer}, {}};
  int count = 1;
  if (value_of(inner2) > kMin) {
    const T inner = square_root(inner2);
    all[1] = {closest + inner, all[0].to_km};
    all[0].to_km = closest - inner;
    count = 2;
  }
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    RaySpan<T> span = all[i];
    if (value_of(span.from_km) < value_of(from_km)) span.from_km = from_km;
    if (value_of(span.to_km) > end_km) span.to_km = T(end_km);
    if (value_of(span.from_km) < value_of(span.to_km)) out[kept++] = span;
  }
  return kept;
}

inline constexpr int kBlockSteps = 16;  ///< steps that are marched, or skipped, together

/// How feet are found, vertically below or along a field: for a box in the axes of its site (the observer's,
/// or its own home), for a shell on the cube's faces in the body's axes.
enum class FootProjection { vertical, field, dipole, reference, shell, shell_dipole, shell_reference };

constexpr bool is_shell_projection(FootProjection projection) { return projection >= FootProjection::shell; }
/// True if the foot is vertically below.
constexpr bool is_vertical_projection(FootProjection projection) {
  return projection == FootProjection::vertical || projection == FootProjection::shell;
}

/// The rule to find feet, with its data.
template <class T>
struct FootRule {
  FootProjection projection = FootProjection::vertical;
  double sphere_km = kEarthRadiusKm;      ///< radius of the body
  T axis[3] = {T(0.0), T(0.0), T(-1.0)};  ///< direction of fall, or axis of the dipole
  /// For the projection `reference` only the first is used, for `shell_reference` one for each face.
  std::shared_ptr<const std::array<FieldPatch, 6>> patches;
};

/// Computes the direction of fall at a place on the body, given as a unit vector from its centre in the
/// march's axes.
void fall_at_place(const FootRule<double>& rule, const double up[3], double fall[3]);

/// True if a box has a site of its own that differs from the scene's.
inline bool is_given_elsewhere(const Scene& scene, const Footprint& footprint) {
  return footprint.home && (footprint.home->latitude_deg != scene.site.latitude_deg ||
                            footprint.home->longitude_deg != scene.site.longitude_deg);
}

/// A stretch of a ray cut into steps, relative to a place in its middle to keep precision in floats. T is
/// double or FreeDual.
template <class T>
struct MarchSpanOf {
  T place_km[3];   ///< from the body's centre
  T direction[3];  ///< unit vector
  T square_km2;    ///< `square` of the place (AirPoint)
  T along_km;      ///< component of the place along the direction
  T at_km;         ///< distance of the place along the ray
  T first_km;      ///< beginning of the first step relative to the place: negative
  T step_km;
  int steps;
};
using MarchSpan = MarchSpanOf<double>;

/// Cuts rays from the scene's observer into spans with steps.
class MarchRays {
 public:
  /// Spans are in the axes of the footprint's site for a box, in the Earth's axes for a shell. A shell is
  /// turned to the east by `turned_deg`.
  MarchRays(const Scene& scene, const Footprint& footprint, double bottom_km, double turned_deg = 0.0);

  /// Limits the steps so that none moves the foot by more than `foot_km`.
  void limit_feet(const FootRule<double>& rule, double foot_km) {
    rule_ = rule;
    foot_km_ = foot_km;
  }

  /// Cuts a ray into at most two spans and returns their number. Each span has a whole number of equal steps,
  /// not longer than march.step_km, so that a ray's light does not jump when the ray is turned a little.
  template <class T>
  int cut(const T enu[3], double end_km, MarchSpanOf<T> out[2]) const {
    const double r0 = sphere_km_ + observer_km_;
    // The source's rule against ghosts uses all points ahead of the body's middle, also those behind the
    // camera.
    const T from = literal_ghosts_ ? enu[2] * -r0 : T(0.0);
    RaySpan<T> spans[2];
    const int count = shell_spans(observer_km_, enu[2], bottom_km_, top_km_, from, end_km, sphere_km_, spans);
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
          middle * (middle + enu[2] * (2.0 * r0)) + observer_km_ * (observer_km_ + 2.0 * sphere_km_);
      span.along_km = enu[2] * r0 + middle;
      span.at_km = middle;
      const double longest = longest_step_km(span, 0.5 * value_of(length));
      span.steps = std::max(1, static_cast<int>(std::ceil(value_of(length) / longest - 1e-9)));
      span.step_km = length * (1.0 / span.steps);
      span.first_km = length * -0.5;
    }
    return count;
  }

  /// Converts a point from the observer's east, north and up to the march's own axes, from the body's centre;
  /// also gives the square of its distance less that of the body's radius.
  void place_of(const double enu_km[3], double place_km[3], double& square_km2) const {
    const double up = enu_km[2] + sphere_km_ + observer_km_;
    for (int a = 0; a < 3; ++a)
      place_km[a] = enu_km[0] * axes_[0][a] + enu_km[1] * axes_[1][a] + up * axes_[2][a];
    const double height = enu_km[2] + observer_km_;
    square_km2 = enu_km[0] * enu_km[0] + enu_km[1] * enu_km[1] + height * (height + 2.0 * sphere_km_);
  }
  /// Converts a point back to the observer's east, north and up.
  void enu_of(const double place_km[3], double enu_km[3]) const {
    for (int i = 0; i < 3; ++i)
      enu_km[i] = place_km[0] * axes_[i][0] + place_km[1] * axes_[i][1] + place_km[2] * axes_[i][2];
    enu_km[2] -= sphere_km_ + observer_km_;
  }
  double bottom_km() const { return bottom_km_; }
  double top_km() const { return top_km_; }

 private:
  template <class T>
  double longest_step_km(const MarchSpanOf<T>& span, double half_km) const {
    if (foot_km_ >= step_km_ * (is_vertical_projection(rule_.projection) ? 1.0 : kMaxFootShare))
      return step_km_;
    double share = 0.0;
    for (const double at_km : {-half_km, 0.0, half_km}) {
      double place[3], direction[3];
      for (int a = 0; a < 3; ++a) {
        direction[a] = value_of(span.direction[a]);
        place[a] = value_of(span.place_km[a]) + at_km * direction[a];
      }
      share = std::max(share, foot_share(place, direction));
    }
    return std::min(step_km_, foot_km_ / std::max(share, 1e-6));
  }

  /// Returns how many km the foot of a point moves per km of the point's motion.
  double foot_share(const double place_km[3], const double direction[3]) const;

  static constexpr double kMaxFootShare = 10.0;  ///< reached where the field is inclined by 6 degrees

  double sphere_km_, observer_km_, bottom_km_, top_km_, step_km_;
  bool literal_ghosts_;
  double axes_[3][3];  ///< east, north and up
  FootRule<double> rule_;
  double foot_km_ = std::numeric_limits<double>::infinity();
};

/// Chooses the table of the profile for the steps of a block: the one whose width is nearest to the range of
/// altitude of a step. The radius is that of the middle of the span, which is accurate to 2 %.
class WidthOfBlock {
 public:
  WidthOfBlock(const StepProfile& profile, const MarchSpan& span, double sphere_km)
      : along_(span.along_km + span.first_km + 0.5 * kBlockSteps * span.step_km),
        step_(span.step_km),
        widths_per_km_(span.step_km / profile.width_step_km() /
                       std::sqrt(span.square_km2 + sphere_km * sphere_km)),
        most_(profile.widths() - 1) {}

  int operator()(int first_step) const {
    // Rounds half up instead of away from zero, which is the same here and faster.
    return std::min(
        static_cast<int>(std::fabs(along_ + first_step * step_) * widths_per_km_ + 0.5),  // NOLINT
        most_);
  }

 private:
  double along_, step_, widths_per_km_;
  int most_;
};

}  // namespace vegard::sim
