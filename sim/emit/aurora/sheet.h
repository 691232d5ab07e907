// Sheets of precipitating electrons: where their beams start.
//
// Source: Baranoski et al. 2000, section 3.1.1, equations (1) and (2), as read in docs/physics.md (rows
// B1-B7).
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/base/number/gauss_quadrature.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/sheet_structures.h"
#include "sim/light/sample.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The parameters of a sheet that determine the feet of its beams. T is double or FreeDual.
template <class T>
struct SheetShape {
  T center_east_km, center_north_km;
  T along_east, along_north;  ///< unit vector along the sheet: sine and cosine of the bearing
  T length_km;
  T thickness_km;
  T wavelength_km;
  T phase_rad;
  T phase_shift_rad;
  T width_km;
  T energy_flux_mw_m2;
  T arc_offset_km;  ///< of this arc of a system, to the side of the sine's positive values
  double side;      ///< +1 in the northern hemisphere, -1 in the southern: the direction of u x B
  T fold_stage{};
};

/// Where a beam is on its layer, independent of the scene's parameters: these numbers are pure functions of
/// the seed and frozen during a fit. Places along the sheet are fractions of the line from start (0) to end
/// (1) of a StretchOfSheet.
struct BeamPlace {
  double s = 0.0;               ///< of the beam
  double from = 0.0, to = 0.0;  ///< the stretch of the sheet that the beam represents
  double s_of_phase = 0.0;  ///< where the sine is evaluated: s itself, or the even place of the literal rule
  double across = 0.0;      ///< place in the Gaussian cross-section, in standard deviations
  double depth = 0.0;       ///< uniform in (0, 1), for the random depth
  double node = 0.0;        ///< with quadrature nodes: place of the first node between two
  double along_in_tube = 0.0;  ///< with nodes: place along the sheet in the tube of deflections
  double width_slope = 1.0;    ///< with nodes: factor on the derivative with respect to the sheet's width
  double weight = 1.0;         ///< with nodes: share of the stretch's light among beams side by side
  double ray = 0.0;            ///< with nodes: value of the Gaussian process of long and short rays
};

/// Density of the quadrature nodes of a sheet, for the mean over all draws.
struct SheetNodes {
  /// Number of places per layer in each of several equally long parts of the line, from its start to its end;
  /// beyond either end the density is that of the neighbouring part. Empty: the scene's number of beams,
  /// drawn at random.
  std::vector<double> beams;
  /// Number of beams side by side, across the sheet, at each place along it.
  int across = 1;
  PathNodes path;
};

/// The line on which beams are laid out. Coordinates along a sheet are relative to the foot of the
/// perpendicular from the observer. The line stays fixed while a fit moves the sheet's start and end over it.
/// So beams do not move along the arc with the sheet's centre, and if neither end is in view, the derivatives
/// with respect to the ends are exactly 0, without sampling noise.
struct StretchOfSheet {
  double center_km = 0.0;
  double length_km = 0.0;
  double drifted_km = 0.0;  ///< how far the sheet has drifted along itself since the clock's zero

  /// Returns the coordinate of a beam's place, to which the sheet's structures are anchored; a fit never
  /// changes it.
  double along_km(double s) const { return center_km + length_km * (s - 0.5); }
};

/// The folds and curls of one layer at an instant, and the spirals of its arc.
struct LayerStructure {
  Folds folds;
  Curls curls;
  Curls spirals;

  LayerStructure(const Folds& folds, const Curls& curls, const Curls& spirals = {})
      : folds(folds), curls(curls), spirals(spirals) {}
  /// The structures of a layer of a sheet. `arc_address` is the address of the arc's first layer.
  LayerStructure(const Sheet& sheet, std::uint32_t arc_address, std::uint32_t layer_address,
                 std::uint64_t seed, double instant_s, double drifted_km)
      : folds(sheet, arc_address, seed, instant_s, drifted_km),
        curls(sheet, layer_address, seed, instant_s, drifted_km),
        spirals(Curls::spirals(sheet, arc_address, seed, instant_s, drifted_km)) {}

  bool any() const { return folds.any() || curls.any() || spirals.any(); }
};

/// Returns the length of the line that a sheet's layers follow: from start to end, or along its curve.
double line_length_km(const Sheet& sheet);

/// Returns the stretch that a sheet occupies at an instant; it drifts with the sheet.
StretchOfSheet stretch_of(const Sheet& sheet, double instant_s);
/// Returns the stretch `later_s` seconds later.
StretchOfSheet moved(const StretchOfSheet& stretch, const Sheet& sheet, double later_s);

/// Returns the distance of a beam, as laid out, from the straight line to the side of the sine's positive
/// values; for a sheet whose course is a sine.
double aside_laid_out_km(const Sheet& sheet, const BeamPlace& place, int layer, double instant_s);

/// Returns the slope of the sine at this place, in km aside per km along.
double slope_laid_out(const Sheet& sheet, const BeamPlace& place, int layer, double instant_s);

/// Returns the largest step of a beam's path as a fraction of the path: as given in the scene, or from the
/// electrons' energy.
double path_step_of(const Sheet& sheet);

/// Largest number of beams per layer.
inline constexpr int kSheetMaxBeams = 10000000;

/// Returns the number of beams per layer: as given in the scene, or in proportion to the sheet's length.
int beams_per_layer(const Sheet& sheet);

/// Returns the address of a layer in the random streams.
std::uint32_t layer_address(int sheet_index, int arc, int layer);

/// The places of one layer's beams, in order along the arc, including those up to `beyond` sheet lengths past
/// either end (with as many beams per kilometre; they are dark until a fit moves an end). Across the layer
/// the places follow van der Corput's sequence, so that places along and across together fill the sheet
/// evenly (a Hammersley set, shifted by the seed). The rules for places along are: stratified: beam i is at
/// (i + 1/2 + j (u - 1/2)) / n, inside its own stretch, whose light it carries; so noise falls faster than
/// 1/sqrt(n). tied: s += d_s (1 + j (2u - 1)), then scaled to end at 1; the phase is evaluated at the
/// jittered s, the light is that of the stretch. literal: s += d_s (1 ± ξ); the phase is 2πD/λ · i/n whatever
/// s is, the mean step 1.25 d_s, the light is shared equally; `beyond` is 0.
///
/// With quadrature nodes, for the mean over all draws, beams are evenly spaced along the line (under the
/// literal rule over 1.25 of it, scattered about the place of their phase like the sum of its random steps).
/// Their other random numbers are replaced by additive recurrences, which fill every stretch of the sheet
/// evenly.
///
/// Places are computed stretch by stretch on request. Of the preceding steps, which the tied and the literal
/// rule add up, only the sums are stored, one per kSumEvery beams.
class LayerPlaces {
 public:
  static constexpr int kSumEvery = 256;

  LayerPlaces(const Sheet& sheet, std::uint32_t layer_address, std::uint64_t seed, double beyond,
              const SheetNodes& nodes = {});

  int size() const { return beams_; }

  /// Writes beams first to first + count - 1 to out[0], out[1], ... `first` is a multiple of kSumEvery,
  /// `count` at most kSumEvery.
  void fill(int first, int count, BeamPlace* out) const;

 private:
  struct Step {
    double length, shift, depth;
  };
  Step step(int beam) const;
  BeamPlace place_in_nodes(int beam) const;
  void lay_out_nodes(double beyond);
  /// Returns the place on the line below which a given share of the beams in nodes lies.
  double on_line(double share) const;

  static constexpr int kRecurrences = 3;
  bool in_nodes_;
  std::vector<double> from_, before_;  ///< parts of the line in nodes: their begin; number of beams before
  int drawn_;                          ///< number of beams of the sheet if they are drawn
  double recurrence_from_[kRecurrences] = {};
  SheetNodes nodes_;
  std::vector<NormalNode> across_;
  std::uint64_t seed_;
  std::uint32_t address_;
  int beams_;
  SpacingRule rule_;
  double jitter_, beyond_, shift_;
  std::vector<double>
      sums_;  ///< sums of the steps before beam i * kSumEvery, and last that of all; empty if stratified
};

template <class T>
struct BeamFoot {
  T east_km, north_km;  ///< in the tangent plane, of the point of the field line at 110 km altitude
  T flux_km2_mw_m2;  ///< energy flux times the horizontal area that the beam represents; 0 beyond the sheet's
                     ///< ends
};

template <class T>
struct PlanePoint {
  T x_km, aside_km;
};

/// Returns where folds, curls and spirals move a beam that is `across_km` beside its layer's sine, relative
/// to its place on the straight line. In a fold the cross-section turns with the curve. `middle` is the sine
/// in the middle between the first and the last layer, about whose points spirals turn.
template <class T>
PlanePoint<T> structured_point(const LayerSine<T>& layer, const LayerStructure& structure,
                               const T& fold_stage, double along_km, const T& across_km,
                               const LayerSine<T>& middle) {
  const auto curve_at = [&](double at_km) {
    return folded_curve(layer, structure.folds.at(at_km), fold_stage, at_km - along_km);
  };
  double gathered_km = along_km;
  if (structure.curls.any())
    structure.curls.near(along_km, [&](const Curl& curl) { gathered_km = curl.gathered(gathered_km); });
  const CurvePoint<T> curve = curve_at(gathered_km);
  PlanePoint<T> point{curve.x_km - across_km * curve.turn_sin, curve.aside_km + across_km * curve.turn_cos};
  if (structure.curls.any()) {
    structure.curls.near(along_km, [&](const Curl& curl) {
      const double hold = Curls::hold(along_km - curl.center_km, curl.radius_km);
      if (curl.turn_rad == 0.0 || hold == 0.0) return;
      const CurvePoint<T> center = curve_at(curl.center_km);
      turn_about(center.x_km, center.aside_km, curl.radius_km, curl.turn_rad * hold, point.x_km,
                 point.aside_km);
    });
  }
  if (structure.spirals.any()) {
    structure.spirals.near(along_km, [&](const Curl& spiral) {
      const double center = spiral.center_km - along_km, hold = Curls::hold(center, spiral.radius_km);
      if (spiral.turn_rad == 0.0 || hold == 0.0) return;
      turn_about(T(center), middle.aside(center), spiral.radius_km, spiral.turn_rad * hold, point.x_km,
                 point.aside_km);
    });
  }
  return point;
}

/// structured_point() for a sheet whose layers all have the same sine.
template <class T>
PlanePoint<T> structured_point(const LayerSine<T>& layer, const LayerStructure& structure,
                               const T& fold_stage, double along_km, const T& across_km) {
  return structured_point(layer, structure, fold_stage, along_km, across_km, layer);
}

/// Returns the number with its derivatives multiplied by `slope`.
inline double with_slope(double x, double) { return x; }
inline FreeDual with_slope(FreeDual x, double slope) {
  for (double& t : x.d.t) t *= slope;
  return x;
}

/// Returns the foot of a beam, by equation (1) with P_i added: P = P_i + s u + w sin(phase) (u x B)/|u x B|,
/// in the tangent plane. The area is that of Q's Gaussian cross-section, width sqrt(2 pi), times the beam's
/// stretch of the arc. `structure` may be null: a sine without folds and curls.
template <class T>
BeamFoot<T> beam_foot(const SheetShape<T>& sheet, const StretchOfSheet& stretch, const BeamPlace& place,
                      int layer, int layers, bool literal, const LayerStructure* structure = nullptr) {
  const T &u_east = sheet.along_east, &u_north = sheet.along_north;
  const T center_along = sheet.center_east_km * u_east + sheet.center_north_km * u_north;
  const T center_left = sheet.center_north_km * u_east - sheet.center_east_km * u_north;
  const T start = center_along - sheet.length_km * 0.5;
  const double stretch_start = stretch.center_km - 0.5 * stretch.length_km;

  T along, from_start, share;
  if (literal) {
    along = start + sheet.length_km * place.s;
    from_start = sheet.length_km * place.s_of_phase;
    share = sheet.length_km * (place.to - place.from);
  } else {
    along = T(stretch_start + stretch.length_km * place.s);
    from_start = along - start;
    const T end = start + sheet.length_km;
    T first(stretch_start + stretch.length_km * place.from),
        last(stretch_start + stretch.length_km * place.to);
    if (value_of(start) > value_of(first)) first = start;
    if (value_of(end) < value_of(last)) last = end;
    share = value_of(last) > value_of(first) ? last - first : T(0.0);
  }
  const double layer_part = layers > 1 ? static_cast<double>(layer) / (layers - 1) : 0.0;
  const T phase =
      from_start * kTwoPi / sheet.wavelength_km + sheet.phase_rad + sheet.phase_shift_rad * layer_part;
  T aside;
  if (structure == nullptr) {
    aside = sheet.thickness_km * sine(phase) + with_slope(sheet.width_km, place.width_slope) * place.across;
  } else {
    const LayerSine<T> curve{sheet.thickness_km, kTwoPi / sheet.wavelength_km, phase};
    const LayerSine<T> middle{curve.amplitude_km, curve.wave_number_per_km,
                              phase + sheet.phase_shift_rad * (layers > 1 ? 0.5 - layer_part : 0.0)};
    const PlanePoint<T> point =
        structured_point(curve, *structure, sheet.fold_stage, stretch.along_km(place.s),
                         sheet.width_km * place.across, middle);
    along = along + point.x_km;
    aside = point.aside_km;
  }
  const T left = center_left + sheet.arc_offset_km * sheet.side + aside * sheet.side;
  return {along * u_east - left * u_north, along * u_north + left * u_east,
          sheet.energy_flux_mw_m2 * sheet.width_km * share * kSqrtTwoPi};
}

/// Returns the shape of one arc of a sheet's system at an instant. `number(n, scale)` gives scale times a
/// parameter of the scene as T, `number(n)` the parameter itself.
template <class T, class Number>
SheetShape<T> sheet_shape(const Scene& scene, int sheet, int arc, double instant_s, const Number& number) {
  const Sheet& s = scene.sheets[sheet];
  SheetShape<T> shape;
  shape.center_east_km = number(s.center_km.east) + s.drift_km_s.east * instant_s;
  shape.center_north_km = number(s.center_km.north) + s.drift_km_s.north * instant_s;
  const T bearing_rad = number(s.bearing_deg, kRadiansPerDegree);
  shape.along_east = sine(bearing_rad);
  shape.along_north = cosine(bearing_rad);
  shape.length_km = number(s.length_km);
  shape.thickness_km = number(s.thickness_km);
  shape.wavelength_km = number(s.wavelength_km);
  // A sine that travels: its phase at a place falls behind by the way it has gone.
  shape.phase_rad = number(s.phase_rad) - T(s.sine_speed_km_s * instant_s * kTwoPi) / shape.wavelength_km;
  shape.phase_shift_rad = number(s.phase_shift_rad);
  shape.width_km = number(s.width_km);
  const T flux = has_given_brightness(s) ? T(1.0) : T(number(s.energy_flux_mw_m2));
  shape.energy_flux_mw_m2 = flux * substorm_level(scene.substorm, instant_s);
  shape.arc_offset_km = number(s.arc_spacing_km) * (arc - 0.5 * (s.arcs - 1));
  shape.side = falls_along_field(scene) ? 1.0 : -1.0;
  shape.fold_stage = number(s.fold_stage);
  return shape;
}

}  // namespace vegard::sim
