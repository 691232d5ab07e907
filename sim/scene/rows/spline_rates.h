// The coefficients of free-form height profiles, Sheet::spline_rate: their number, names and defaults.
#pragma once

#include <optional>
#include <string>

#include "sim/base/number/altitude_spline.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

bool has_spline_profile(const Sheet& sheet);

AltitudeSpline altitude_spline(const Sheet& sheet);

/// Returns the index into spline_rate of a line's coefficient.
inline int spline_rate_index(const Sheet& sheet, int line, int knot) {
  return line * sheet.spline_knots + knot;
}

/// Returns the component name of a coefficient: "5577_3" is the fourth from the bottom of 557.7 nm.
std::string spline_rate_component(const Scene& scene, int sheet, int index);

/// Sets default coefficients in sheets with a free-form profile that have none: one broad layer around 120
/// km, the same for all lines, without a model of electrons.
void fill_spline_rates(Scene& scene);

/// Adapts the coefficients after a change of emission.lines or of the number of knots from `before`. Lines
/// that were there keep theirs if the number of knots is the same; all others get the defaults.
void follow_spline_grid(const Scene& before, Scene& after);

}  // namespace vegard::sim
