// A free-form height profile: for each line a cubic B-spline in altitude whose coefficients are parameters.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the profile rate = sum of c_k B_k(altitude), with c the line's Sheet::spline_rate and B the basis
/// functions of sim/base/number/altitude_spline.h. The coefficients are positive, hence so is the rate; the
/// electrons' energy has no effect. A line that the scene does not have is dark.
HeightProfile spline_profile(const std::vector<double>& wavelengths_nm, const Scene& scene,
                             const Sheet& sheet);

/// Returns d rate / d coefficient, indexed as HeightProfile::rate: the coefficient's basis function for its
/// line, 0 for the other lines. `index`: of the coefficient in Sheet::spline_rate.
std::vector<float> spline_slope(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                const Sheet& sheet, int index);

}  // namespace vegard::sim
