// A free-form height profile: for each line a cubic B-spline in altitude whose coefficients are parameters.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// rate = sum of c_k B_k(altitude), c = Sheet::spline_rate of the line, B of
/// sim/base/number/altitude_spline.h. The coefficients are positive, hence so is the rate; the electrons'
/// energy does nothing. A line that the scene does not have is dark.
HeightProfile spline_profile(const std::vector<double>& wavelengths_nm, const Scene& scene,
                             const Sheet& sheet);

/// d rate / d coefficient, as HeightProfile::rate: the coefficient's basis function, in its line's lane.
std::vector<float> spline_slope(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                const Sheet& sheet, int index);

}  // namespace vegard::sim
