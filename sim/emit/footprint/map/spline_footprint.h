// Footprints of a curve: light along it, with a Gaussian across.
//
// After Lawlor and Genetti, "Interactive Volume Rendering Aurora on the GPU", Journal of WSCG 19 (2011),
// whose footprints begin as splines. The law is ours: every stretch ds of the curve lays down
//   flux ds / (sqrt(2 pi) width) exp(-r² / (2 width²)),
// so that the sum across a straight curve is the Gaussian of standard deviation `width_km` whose peak is
// `flux`, and the whole of it is flux × length × sqrt(2 pi) width however the curve runs. Where arms cross or
// come near each other the light adds: electrons bring what they bring, and the map stays smooth, which the
// larger of two would not. An open end falls to a half at the last point. The energy is the mean of ln E,
// weighed by what each stretch lays down.
#pragma once

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// How far from the curve there is light, in standard deviations: 3e-7 of the peak.
inline constexpr double kGaussianReach = 5.5;

/// Of a box. Exact derivatives by everything that `number` gives a tangent; by center_km only where it moves
/// on the grid, and not where the grid goes with it.
template <class T>
PlaneFootprint<T> spline_plane(const Footprint& footprint, const NumberAs<T>& number, int threads,
                               bool centre_moves = true);

/// Of a shell: on the sphere of the feet, at 110 km altitude. Points are less than 90 degrees apart; across
/// the curve exp(-chord² / (2 width²)), which is Fisher's distribution on the sphere.
CubeFootprint<double> spline_cube(const Footprint& footprint, double sphere_km, int threads);

}  // namespace vegard::sim
