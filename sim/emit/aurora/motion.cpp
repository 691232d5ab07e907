#include "sim/emit/aurora/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/base/number/smooth_step.h"
#include "sim/emit/aurora/sheet_curve.h"

namespace vegard::sim {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLivesToMean = 4.0;

/// Returns the time of change of a structure with this lifetime (0: for ever), width and speed.
double change_s(double lifetime_s, double width_km, double speed_km_s) {
  const double own = lifetime_s > 0.0 ? lifetime_s : kNever;
  return speed_km_s != 0.0 ? std::min(own, width_km / std::abs(speed_km_s)) : own;
}

double narrowest_km(const Sheet& sheet) {
  return sheet.point_width_km.empty()
             ? sheet.width_km
             : *std::min_element(sheet.point_width_km.begin(), sheet.point_width_km.end());
}

}  // namespace

std::vector<double> instants_s(const Time& time) {
  std::vector<double> all;
  for (int k = 0; k < time.instants; ++k) all.push_back(time.start_s + k * time.exposure_s / time.instants);
  return all;
}

double substorm_level(const Substorm& s, double instant_s) {
  if (s.quiet >= 1.0) return 1.0;
  const double since_onset = instant_s - s.onset_s;
  if (since_onset < 0.0) return s.quiet + (s.grown - s.quiet) * smooth_step(1.0 + since_onset / s.growth_s);
  if (since_onset < s.expansion_s)
    return s.grown + (1.0 - s.grown) * smooth_step(since_onset / s.expansion_s);
  return 1.0 + (s.quiet - 1.0) * smooth_step((since_onset - s.expansion_s) / s.recovery_s);
}

ChangeTimes change_times(const Sheet& sheet) {
  const double bearing = sheet.bearing_deg * kRadiansPerDegree;
  const EastNorth& drift = sheet.drift_km_s;
  const double all = std::hypot(drift.east, drift.north);
  double along = all, aside = all;  // a curve has no one direction
  double course_s = kNever;
  if (!is_curve(sheet)) {
    along = drift.east * std::sin(bearing) + drift.north * std::cos(bearing);
    aside = drift.east * std::cos(bearing) - drift.north * std::sin(bearing);
    const double slope = kTwoPi * sheet.thickness_km / sheet.wavelength_km;
    aside = std::abs(aside) + slope * (std::abs(along) + std::abs(sheet.sine_speed_km_s));
    constexpr double kEnds = 0.05;  // of the length: how far the ends may go unseen
    course_s = change_s(0.0, kEnds * sheet.length_km, along);
  }
  ChangeTimes times{kNever, kNever, kNever, kNever, kNever, kNever, kNever};
  times.course = std::min(course_s, change_s(0.0, narrowest_km(sheet), aside));
  if (sheet.ray_contrast > 0.0 || sheet.ray_length_contrast > 0.0)
    times.rays = change_s(sheet.ray_lifetime_s, sheet.ray_width_km, along + sheet.ray_speed_km_s);
  if (sheet.patch_size_km > 0.0 && sheet.patch_contrast > 0.0)
    times.patches = change_s(sheet.patch_lifetime_s, sheet.patch_size_km, all);
  if (sheet.border_amplitude_km > 0.0)
    times.border = change_s(sheet.border_lifetime_s, sheet.border_scale_km, all);
  if (sheet.fold_spacing_km > 0.0)
    times.folds = change_s(sheet.fold_lifetime_s, sheet.fold_length_km, along + sheet.fold_speed_km_s);
  if (sheet.curl_spacing_km > 0.0)
    times.curls = change_s(sheet.curl_lifetime_s, sheet.curl_radius_km, along + sheet.curl_speed_km_s);
  if (sheet.spiral_spacing_km > 0.0)
    times.spirals =
        change_s(sheet.spiral_lifetime_s, sheet.spiral_radius_km, along + sheet.spiral_speed_km_s);
  return times;
}

double soonest_change_s(const Sheet& sheet, const Substorm& substorm) {
  const ChangeTimes t = change_times(sheet);
  const double of_sheet = std::min({t.rays, t.patches, t.border, t.folds, t.curls, t.spirals, t.course});
  if (substorm.quiet >= 1.0) return of_sheet;
  return std::min({of_sheet, substorm.growth_s, substorm.expansion_s, substorm.recovery_s});
}

SheetOverTime sheet_over(const Sheet& sheet, double stretch_s) {
  const ChangeTimes times = change_times(sheet);
  const auto is_mean = [stretch_s](double change_s) { return stretch_s > kLivesToMean * change_s; };
  SheetOverTime over{sheet};
  if (is_mean(times.rays)) {
    over.draws_ray_length = sheet.ray_length_contrast > 0.0;
    over.sheet.ray_contrast = over.sheet.ray_length_contrast = 0.0;
  }
  if (is_mean(times.patches)) over.sheet.patch_contrast = 0.0;
  if (is_mean(times.border)) over.sheet.border_amplitude_km = 0.0;
  if (is_mean(times.folds)) over.sheet.fold_spacing_km = 0.0;
  if (is_mean(times.curls)) over.sheet.curl_spacing_km = 0.0;
  if (is_mean(times.spirals)) over.sheet.spiral_spacing_km = 0.0;
  return over;
}

}  // namespace vegard::sim
