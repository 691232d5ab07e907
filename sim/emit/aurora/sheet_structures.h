// The structures of a sheet: the slots that they live in, folds, and curls and spirals.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/base/number/dual.h"
#include "sim/base/number/random.h"
#include "sim/base/number/smooth_step.h"
#include "sim/scene/structs/sheet.h"

namespace vegard::sim {

// Slots: the places and lifetimes of a sheet's structures.
//
// The paper has folds at quasi-periodic places (section 3.1.1) and gives the lifetimes of folds and curls
// (section 2.2). Here both are made from slots of the length `spacing`, which begin at the zero of the
// coordinate along the sheet and have one structure each. A structure is a pure function of (seed, stream,
// address, slot, generation) and of the instant, so that a frame of an animation is the picture taken at that
// time.

/// Which of a slot's successive structures lives at an instant, and how strong it is.
struct SlotLife {
  std::uint32_t generation = 0;
  double strength = 1.0;  ///< sin², 0 at birth and death; 1 for what lasts
};

/// Returns the slot of a place along the sheet.
std::int64_t slot_at(double along_km, double spacing_km);

/// Returns the state of a slot at an instant. With a lifetime of 0 there is a single generation, which lasts.
SlotLife slot_life(std::uint64_t seed, Stream stream, std::uint32_t address, std::int64_t slot,
                   double instant_s, double lifetime_s);

/// Returns the random numbers of one structure.
Words slot_words(std::uint64_t seed, Stream stream, std::uint32_t address, std::int64_t slot,
                 std::uint32_t generation);

// Folds: stretches of a layer's sine that have turned about their middle, replaced by Bézier curves.
//
// Source: Baranoski et al. 2000, section 3.1.1 (folds are Bézier curves in place of portions of the sine, at
// quasi-periodic intervals, their rotational stage set by the control points) and figures 6a and 9b; row B8
// of docs/physics.md. The paper gives neither degree nor control points. Ours are six cubics, C1 to the sine
// and to each other. Their ends lie at even places of the stretch, on the sine swirled about its point M at
// the fold's centre: turned by θ (1 - q²)², q from 0 at M to 1 at the ends of the stretch, and so do their
// handles. θ is σ (3 - σ)/2 of 155 degrees at the stage σ: at 0 the fold is a ripple that can hardly be
// distinguished from the sine; from about 1/2 on the curve overhangs; at 1 it is an S of two round horseshoe
// bends, whose radius is a sixth of half the stretch or more.
//
// Sense: folds turn clockwise seen along the field B, which is counter-clockwise seen against it, from the
// ground in the north. That is how a charged sheet turns: the electric field points to its excess of
// electrons from either side, and the drift E x B shears it (T. J. Hallinan, T. N. Davis, Planet. Space Sci.
// 18, 1735, 1970; docs/physics.md says what of it could be checked). In the south, where the sheet's sine is
// mirrored, so are the folds.
//
// The curve's parameter runs evenly in the coordinate along the sheet: the light of a stretch of the fold is
// that of the same stretch of the sine, moved with the electrons.

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
  double from_center_km = 0.0;  ///< of the place along the sheet
  double half_km = 0.0;         ///< of the stretch that the fold replaces
  double stage = 0.0;           ///< of this fold, fraction of the sheet's fold_stage
  double presence = 1.0;        ///< 0: the plain sine, as at a fold's birth and death
};

/// The folds of one arc of a sheet at an instant, the same for all its layers.
class Folds {
 public:
  /// `drifted_km` is how far the sheet has drifted along itself.
  Folds(const Sheet& sheet, std::uint32_t arc_address, std::uint64_t seed, double instant_s,
        double drifted_km);

  bool any() const { return spacing_km_ > 0.0; }

  /// Returns the fold at `along_km`, the coordinate along the sheet as defined by StretchOfSheet.
  Fold at(double along_km) const;

 private:
  std::uint64_t seed_;
  std::uint32_t address_;
  double spacing_km_, length_km_, jitter_, stage_spread_, lifetime_s_, instant_s_, moved_km_;
};

/// A point of a layer's curve; x is relative to the beam at which the sine is given.
template <class T>
struct CurvePoint {
  T x_km, aside_km;
  T turn_cos, turn_sin;  ///< angle from the sine's tangent to the curve's at the same place along the sheet
};

/// A point of the swirled sine, relative to M, and its derivative with respect to the place along the sheet.
template <class T>
struct SwirledPoint {
  T x_km, aside_km, x_slope, aside_slope;
};

/// Returns the point at `from_center_km` from the fold's centre, which is `center_km` from the beam at which
/// the sine is given. `turn_rad` is the turn of the fold's middle.
template <class T>
SwirledPoint<T> swirled_point(const LayerSine<T>& layer, double center_km, const T& middle_aside_km,
                              double from_center_km, double half_km, const T& turn_rad) {
  const double q = from_center_km / half_km, left = 1.0 - q * q;
  // Clockwise in (x, aside): seen from below, against B in the north, that is the other way round.
  const T angle = turn_rad * (left * left), by_x = turn_rad * (-4.0 * q * left / half_km);
  const T c = cosine(angle), s = sine(angle);
  const T aside = layer.aside(center_km + from_center_km) - middle_aside_km,
          slope = layer.slope(center_km + from_center_km);
  const T x = c * from_center_km + s * aside, y = c * aside - s * from_center_km;
  return {x, y, c + s * slope + by_x * y, c * slope - s - by_x * x};
}

/// Returns the point of a folded layer at `x_km` from the beam. `stage` is the sheet's fold_stage.
template <class T>
CurvePoint<T> folded_curve(const LayerSine<T>& layer, const Fold& fold, const T& stage, double x_km) {
  constexpr double kLargestTurnRad = 155.0 * 3.14159265358979323846 / 180.0;
  constexpr int kCubics = 3;  // of each half
  const T aside = layer.aside(x_km);
  if (!fold.here) return {T(x_km), aside, T(1.0), T(0.0)};

  const double center = x_km - fold.from_center_km, sign = fold.from_center_km >= 0.0 ? 1.0 : -1.0;
  const T own_stage = stage * fold.stage, middle = layer.aside(center);
  const T turn = own_stage * (1.5 - 0.5 * own_stage) * kLargestTurnRad;
  const double place = fold.from_center_km / fold.half_km * sign * kCubics;
  const int cubic = place < kCubics - 1 ? static_cast<int>(place) : kCubics - 1;
  // From the middle outwards.
  const double length = sign * fold.half_km / kCubics;
  const auto end = [&](int k) {
    return swirled_point(layer, center, middle, length * k, fold.half_km, turn);
  };
  const SwirledPoint<T> first = end(cubic), last = end(cubic + 1);
  const double handle = length / 3.0;
  const T px[4] = {first.x_km, first.x_km + first.x_slope * handle, last.x_km - last.x_slope * handle,
                   last.x_km};
  const T py[4] = {first.aside_km, first.aside_km + first.aside_slope * handle,
                   last.aside_km - last.aside_slope * handle, last.aside_km};

  const double u = place - cubic, v = 1.0 - u;
  const double b[4] = {v * v * v, 3.0 * v * v * u, 3.0 * v * u * u, u * u * u};
  // Derivatives by x: du/dx is 1 / length.
  const double per_km = 3.0 / length;
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
  const T length_of_tangent = square_root(dot * dot + cross * cross + 1e-30);
  return {(sum(b, px) - fold.from_center_km) * p + x_km, (sum(b, py) + middle - aside) * p + aside,
          dot / length_of_tangent, cross / length_of_tangent};
}

// Curls: small vortices that gather a layer's beams and wind them up.
//
// Source: Baranoski et al. 2000, section 2.2 and figure 6b (curls 2 to 10 km apart, living for 0.25 to 0.75
// s, electron beams evolving into rays) and section 3.1 (a beam represents a curl); row B9 of
// docs/physics.md. The map is ours. Beams are first gathered along the sheet about the curl's centre, x → x
// (1 - g exp(-x²/R²)), which keeps their order and puts them 1 - g of their spacing apart at the centre: a
// cluster of beams. Then they are turned about the centre by an angle that falls off as exp(-r²/R²): that
// preserves areas, as a flow without sources does. Sense as for folds, counter-clockwise seen against B.
//
// Spirals are the same map without gathering, larger and of the other sense, shared by all layers of an arc:
// they turn about a point of the arc's middle line. Source: T. J. Hallinan, J. Geophys. Res. 81, 3959 (1976):
// field lines twisted by an upward current, which winds a sheet up counter-clockwise seen along B
// (docs/physics.md has the derivation); all spirals that Viking saw are wound so (J. S. Murphree, L. L.
// Cogger, R. D. Elphinstone, IEEE Trans. Plasma Sci. 17, 109, 1989).

/// One curl at an instant.
struct Curl {
  double center_km = 0.0;  ///< along the sheet, as defined by StretchOfSheet
  double radius_km = 1.0;
  double gather = 0.0;
  double turn_rad = 0.0;

  /// Returns the place to which a beam at `along_km` is moved by gathering.
  double gathered(double along_km) const {
    const double x = along_km - center_km, q = x / radius_km;
    return center_km + x * (1.0 - gather * std::exp(-q * q));
  }
};

/// The curls of one layer at an instant, or the spirals of an arc.
class Curls {
 public:
  /// No curls.
  Curls() = default;
  Curls(const Sheet& sheet, std::uint32_t layer_address, std::uint64_t seed, double instant_s,
        double drifted_km);

  /// Returns the spirals that all layers of an arc share. Their turn_rad is negative where they wind
  /// counter-clockwise seen along B.
  static Curls spirals(const Sheet& sheet, std::uint32_t arc_address, std::uint64_t seed, double instant_s,
                       double drifted_km);

  bool any() const { return spacing_km_ > 0.0; }

  /// Calls see(curl) for every curl that reaches to a place along the sheet, from start to end.
  template <class See>
  void near(double along_km, const See& see) const {
    const double reach = kReach * radius_km_;
    const std::int64_t last = slot_at(along_km - moved_km_ + reach, spacing_km_);
    for (std::int64_t slot = slot_at(along_km - moved_km_ - reach, spacing_km_); slot <= last; ++slot) {
      const Curl curl = of_slot(slot);
      if (std::abs(along_km - curl.center_km) < reach) see(curl);
    }
  }

  /// Returns the factor on the turn of a beam laid out at this distance from a curl: 1 within five radii,
  /// decreasing to 0 at six. On an even sheet the turn is negligible there anyway, but a fold may bring such
  /// beams near the curl.
  static double hold(double from_center_km, double radius_km) {
    return smooth_step(kReach - std::abs(from_center_km) / radius_km);
  }

 private:
  static constexpr double kReach = 6.0;  // in radii

  Curl of_slot(std::int64_t slot) const;

  Stream stream_ = Stream::curl;
  std::uint64_t seed_ = 0;
  std::uint32_t address_ = 0;
  double spacing_km_ = 0.0, radius_km_ = 1.0, gather_ = 0.0, turn_rad_ = 0.0, lifetime_s_ = 0.0,
         instant_s_ = 0.0, moved_km_ = 0.0;
};

/// Turns the point (x, aside) about a curl's centre: clockwise in (x, aside), which seen from below is
/// counter-clockwise.
template <class T>
void turn_about(const T& center_x, const T& center_aside, double radius_km, double turn_rad, T& x, T& aside) {
  const T dx = x - center_x, dy = aside - center_aside;
  const T angle = exponential((dx * dx + dy * dy) * (-1.0 / (radius_km * radius_km))) * turn_rad;
  const T c = cosine(angle), s = sine(angle);
  x = center_x + dx * c + dy * s;
  aside = center_aside + dy * c - dx * s;
}

}  // namespace vegard::sim
