// Footprints of fractal noise in a box: bands that wander, as of a sky full of arcs.
//
// Source: the second approach of "Rendering volume nebulae and aurorae" (Gaia Sky), a bounded box with
// fractal Brownian motion for a footprint. The law is ours: ridges of gradient noise, (1 - |noise|)², each
// octave weighed by the one before (F. K. Musgrave in D. Ebert et al., "Texturing and modeling", 1994), at
// places that noise has pushed aside.
#pragma once

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Share of a box's half extent over which its footprint fades towards the edges.
inline constexpr double kNoiseFade = 0.25;

/// In units of energy_flux_mw_m2, from 0 to 1, dark at the box's edges. `index` is the footprint's number in
/// its scene: others have other noise. Which level of the noise is dark follows from noise_coverage, by the
/// share of the box that lies above it, before its edges fade. It stands still in the box, and with a
/// lifetime becomes another: the plane through the noise goes on by a node in that time.
PlaneFootprint<double> noise_plane(const Footprint& footprint, std::uint64_t seed, int index,
                                   double instant_s, int threads);

}  // namespace vegard::sim
