// The coefficients of free-form height profiles, Sheet::spline_rate: how many there are, what they are called
// and what stands in for those that nobody gave.
#pragma once

#include <optional>
#include <string>

#include "sim/base/number/altitude_spline.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

bool has_spline_profile(const Sheet& sheet);

AltitudeSpline altitude_spline(const Sheet& sheet);

/// Index into spline_rate of a line's coefficient.
inline int spline_rate_index(const Sheet& sheet, int line, int knot) {
  return line * sheet.spline_knots + knot;
}

/// "5577_3", the fourth from the bottom of 557.7 nm.
std::string spline_rate_component(const Scene& scene, int sheet, int index);

/// Fills the coefficients of sheets with a free-form profile that have none: one broad layer about 120 km,
/// the same for all lines, that knows nothing of any electrons.
void fill_spline_rates(Scene& scene);

/// After a change from `before`: coefficients that were there for other lines or another number of knots are
/// carried over, line by line, where the knots are as they were, and else filled in again.
void follow_spline_grid(const Scene& before, Scene& after);

}  // namespace vegard::sim
