#include "fit/search/sine_numbers.h"

#include <cmath>

#include "fit/parameters/parameter_map.h"
#include "sim/base/number/constants.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {
namespace {

using sim::ParameterRole;

double within_limits(const FreeNumber& n, double value) { return n.value(n.coordinate(value)); }

/// A phase, by whole turns between its limits if it can be, else nearest to 0.
double turned_inside(const FreeNumber& n, double phase_rad) {
  double near = std::remainder(phase_rad, 2.0 * sim::kPi);
  if (n.limited()) near += 2.0 * sim::kPi * std::ceil((n.min - near) / (2.0 * sim::kPi));
  return within_limits(n, near);
}

sim::Scene scene_at(const sim::Scene& start, const std::vector<FreeNumber>& free,
                    const std::vector<double>& values) {
  sim::Scene scene = start;
  ParameterMap(start, free).put(values, scene);
  return scene;
}

}  // namespace

SineNumbers sine_numbers(const std::vector<FreeNumber>& free, int sheet) {
  SineNumbers sine;
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (free[j].id.sheet() != sheet) continue;
    if (free[j].id.role() == ParameterRole::wavelength) sine.wavelength = static_cast<int>(j);
    if (free[j].id.role() == ParameterRole::phase) sine.phase = static_cast<int>(j);
    if (free[j].id.role() == ParameterRole::amplitude) sine.thickness = static_cast<int>(j);
  }
  return sine;
}

void take_sine(const sim::Scene& start, const std::vector<FreeNumber>& free, const SineThroughOffsets& found,
               int s, std::vector<double>& values) {
  const sim::Scene scene = scene_at(start, free, values);
  const sim::Sheet& sheet = scene.sheets[s];
  const double bearing = sheet.bearing_deg * sim::kPi / 180.0,
               side = scene.field.inclination_deg < 0.0 ? -1.0 : 1.0;
  const double along[2] = {std::sin(bearing), std::cos(bearing)};
  const double aside[2] = {-side * along[1], side * along[0]};
  int centre[2] = {-1, -1};
  for (std::size_t j = 0; j < free.size(); ++j)
    if (free[j].id.role() == ParameterRole::centre && free[j].id.sheet() == s)
      centre[free[j].id.component] = static_cast<int>(j);
  const auto move = [&](int j, double by) {
    if (j >= 0) values[j] = within_limits(free[j], values[j] + by);
  };
  // The centre moves aside; if one of its components is held, the other goes further. If it follows from a
  // number without a place in the scene, that moves.
  double shift[2] = {found.offset_km * aside[0], found.offset_km * aside[1]};
  if (centre[0] < 0 && centre[1] < 0) {
    shift[0] = shift[1] = 0.0;
    for (std::size_t j = 0; j < free.size(); ++j) {
      if (free[j].has_path()) continue;
      std::vector<double> further = values;
      further[j] = within_limits(free[j], values[j] + 1.0);
      const sim::EastNorth there = scene_at(start, free, further).sheets[s].center_km;
      const double by[2] = {there.east - sheet.center_km.east, there.north - sheet.center_km.north};
      const double sideways = by[0] * aside[0] + by[1] * aside[1];
      if (std::abs(sideways) < 0.2) continue;
      move(static_cast<int>(j), found.offset_km / sideways);
      for (int c = 0; c < 2; ++c) shift[c] = by[c] * found.offset_km / sideways;
      break;
    }
  } else if (centre[0] < 0 || centre[1] < 0) {
    const int only = centre[0] >= 0 ? 0 : 1;
    shift[1 - only] = 0.0;
    shift[only] = std::abs(aside[only]) > 0.2 ? found.offset_km / aside[only] : 0.0;
  }
  move(centre[0], shift[0]);
  move(centre[1], shift[1]);
  const double moved_along = shift[0] * along[0] + shift[1] * along[1];
  for (std::size_t j = 0; j < free.size(); ++j)
    if (free[j].id == sim::parameter_with(ParameterRole::bearing, s))
      move(static_cast<int>(j), -side * std::atan(found.slope) * 180.0 / sim::kPi);
  const SineNumbers sine = sine_numbers(free, s);
  if (sine.wavelength >= 0)
    values[sine.wavelength] = within_limits(free[sine.wavelength], found.wavelength_km);
  if (sine.thickness >= 0) values[sine.thickness] = within_limits(free[sine.thickness], found.amplitude_km);
  if (sine.phase >= 0) {
    const double of_mean_layer = sheet.layers > 1 ? 0.5 * sheet.phase_shift_rad : 0.0;
    values[sine.phase] =
        turned_inside(free[sine.phase],
                      found.phase_rad - of_mean_layer + 2.0 * sim::kPi * moved_along / found.wavelength_km);
  }
}

}  // namespace vegard::fit
