// Folds: stretches of a layer's sine that have turned about their middle, replaced by Bézier curves.
//
// Source: Baranoski et al. 2000, section 3.1.1 (folds are Bézier curves in place of portions of the sine, at
// quasi-periodic intervals, their rotational stage set by the control points) and figures 6a and 9b; row B8
// of docs/physics.md. The paper gives neither degree nor control points. Ours are two cubics P0 → M → P3, C1
// to the sine at P0 and P3 and to each other at M. A single cubic will not do: C1 to the sine, its handles
// lie nearly on one line, and all that sweeping them past each other does is to fold the line flat upon
// itself. The two inner handles lie opposite each other about M, the sine's point at the centre, and turn
// about it with the stage: by 0 they lie along the sine and the fold is a ripple that can hardly be told from
// it; from about a half the curve overhangs; by 1 they have turned by 155 degrees, σ (3 - σ)/2 of that at the
// stage σ, grown to 1 + 4 σ² times their length, and the curve is an S of two horseshoe bends.
//
// Sense: counter-clockwise seen against the field B, from the ground in the north. That is how a charged
// sheet turns: the electric field points to its excess of electrons from either side, and the drift E x B
// shears it. In the south, where the sheet's sine is mirrored, so are the folds.
//
// A fold is passed through evenly in the coordinate along the sheet: its light is the sine's, carried with
// the electrons.
#pragma once

#include <cstdint>

#include "sim/base/number/dual.h"
#include "sim/emit/aurora/slot.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A layer's sine, aside = amplitude sin(phase + wave_number x), x counted from a beam along the sheet.
/// `aside` runs to the side of the sine's positive values.
template <class T>
struct LayerSine {
  T amplitude_km;
  T wave_number_per_km;
  T phase_rad;

  T aside(double x_km) const { return amplitude_km * sine(phase_rad + wave_number_per_km * x_km); }
  T slope(double x_km) const {
    return amplitude_km * wave_number_per_km * cosine(phase_rad + wave_number_per_km * x_km);
  }
};

/// The fold that a place along the sheet lies in.
struct Fold {
  bool here = false;
  double from_center_km = 0.0;  ///< of the place
  double half_km = 0.0;         ///< of the stretch that the fold replaces
  double stage = 0.0;           ///< of this fold, fraction of the sheet's fold_stage
  double presence = 1.0;        ///< 0 leaves the sine as it is: what a fold is born from and dies into
};

/// The folds of one arc of a sheet at an instant, the same for all its layers.
class Folds {
 public:
  /// `drifted_km` is how far the sheet has drifted along itself.
  Folds(const Sheet& sheet, std::uint32_t arc_address, std::uint64_t seed, double instant_s,
        double drifted_km);

  bool any() const { return spacing_km_ > 0.0; }

  /// `along_km` is the coordinate along the sheet, as StretchOfSheet counts it.
  Fold at(double along_km) const;

 private:
  std::uint64_t seed_;
  std::uint32_t address_;
  double spacing_km_, length_km_, jitter_, stage_spread_, lifetime_s_, instant_s_, moved_km_;
};

/// A point of a layer's curve, x counted from the beam that the sine is given at.
template <class T>
struct CurvePoint {
  T x_km, aside_km;
  T turn_cos, turn_sin;  ///< of the curve's tangent against the sine's at the same place along the sheet
};

/// The point of a folded layer at `x_km` from the beam. `stage` is the sheet's fold_stage.
template <class T>
CurvePoint<T> folded_curve(const LayerSine<T>& layer, const Fold& fold, const T& stage, double x_km) {
  constexpr double kLargestTurnRad = 155.0 * 3.14159265358979323846 / 180.0;
  constexpr double kGrowth = 4.0;  // of the inner handles, from stage 0 to 1
  const T aside = layer.aside(x_km);
  if (!fold.here) return {T(x_km), aside, T(1.0), T(0.0)};

  const double center = x_km - fold.from_center_km, half = fold.half_km;
  const bool second = fold.from_center_km >= 0.0;
  const double joint = second ? center + half : center - half;
  // The inner handle. It turns clockwise in (x, aside), which seen from below is the other way round.
  const T own_stage = stage * fold.stage;
  const T angle = own_stage * (1.5 - 0.5 * own_stage) * kLargestTurnRad, slope = layer.slope(center);
  const T size = (own_stage * own_stage * kGrowth + 1.0) * (half / 3.0);
  const T handle_x = (cosine(angle) + slope * sine(angle)) * size;
  const T handle_aside = (slope * cosine(angle) - sine(angle)) * size;
  const double to_joint = second ? half / 3.0 : -half / 3.0, sign = second ? 1.0 : -1.0;
  // From the middle outwards: M, inner handle, outer handle, joint.
  const T px[4] = {T(center), center + handle_x * sign, T(joint - to_joint), T(joint)};
  const T middle = layer.aside(center), end = layer.aside(joint);
  const T py[4] = {middle, middle + handle_aside * sign, end - layer.slope(joint) * to_joint, end};

  const double u = fold.from_center_km / half * sign, v = 1.0 - u;
  const double b[4] = {v * v * v, 3.0 * v * v * u, 3.0 * v * u * u, u * u * u};
  // Derivatives by x: du/dx is sign / half.
  const double per_km = 3.0 * sign / half;
  const double d[4] = {-v * v * per_km, (v * v - 2.0 * v * u) * per_km, (2.0 * v * u - u * u) * per_km,
                       u * u * per_km};
  const auto sum = [](const double* weight, const T* point) {
    return point[0] * weight[0] + point[1] * weight[1] + point[2] * weight[2] + point[3] * weight[3];
  };
  const T sine_slope = layer.slope(x_km);
  const double p = fold.presence;
  const T tangent_x = (sum(d, px) - 1.0) * p + 1.0;
  const T tangent_aside = (sum(d, py) - sine_slope) * p + sine_slope;
  const T dot = tangent_x + tangent_aside * sine_slope, cross = tangent_aside - tangent_x * sine_slope;
  const T length = square_root(dot * dot + cross * cross + 1e-30);
  return {(sum(b, px) - x_km) * p + x_km, (sum(b, py) - aside) * p + aside, dot / length, cross / length};
}

}  // namespace vegard::sim
