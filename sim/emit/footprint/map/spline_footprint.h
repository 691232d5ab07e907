// Footprints of a curve: light along it, with a Gaussian across.
//
// After Lawlor and Genetti, "Interactive Volume Rendering Aurora on the GPU", Journal of WSCG 19 (2011),
// whose footprints begin as splines. The law is ours: every stretch ds of the curve contributes
//   flux ds / (sqrt(2 pi) width) exp(-r² / (2 width²)),
// so that across a straight curve the sum is the Gaussian of standard deviation `width_km` with the peak
// `flux`, and the integral is flux × length × sqrt(2 pi) width for every course of the curve. Where arms
// cross or come near each other the flux adds up; this is physical, and the map stays smooth, unlike the
// larger of the two. At an open end the flux falls to a half at the last point. The energy is the mean of ln
// E, weighted by the contributions of the stretches.
#pragma once

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {

/// Distance from the curve up to which there is light, in standard deviations: at 3e-7 of the peak.
inline constexpr double kGaussianReach = 5.5;

/// Returns the map of a box, with exact derivatives with respect to every parameter to which `number` gives a
/// tangent. With respect to center_km there are derivatives only if `centre_moves`: the curve then moves on a
/// fixed grid, otherwise the grid moves with it.
template <class T>
PlaneFootprint<T> spline_plane(const Footprint& footprint, const NumberAs<T>& number, int threads,
                               bool centre_moves = true);

/// Returns the map of a shell, on the sphere of the feet at 110 km altitude. Neighbouring points must be less
/// than 90 degrees apart; across the curve the profile is exp(-chord² / (2 width²)), which is Fisher's
/// distribution on the sphere.
CubeFootprint<double> spline_cube(const Footprint& footprint, double sphere_km, int threads);

}  // namespace vegard::sim
