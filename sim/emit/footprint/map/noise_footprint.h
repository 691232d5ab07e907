// Footprints of fractal noise in a box: winding bands, like a sky full of arcs.
//
// Source: the second approach of "Rendering volume nebulae and aurorae" (Gaia Sky), a bounded box with
// fractal Brownian motion for a footprint. The law is ours: ridges of gradient noise, (1 - |noise|)², each
// octave weighted by the one before (F. K. Musgrave in D. Ebert et al., "Texturing and modeling", 1994), at
// places displaced by noise.
#pragma once

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {

/// Share of a box's half extent over which its footprint fades towards the edges.
inline constexpr double kNoiseFade = 0.25;

/// Returns the map in units of energy_flux_mw_m2, from 0 to 1, dark at the box's edges. `index` is the
/// footprint's number in its scene; each has its own noise. The threshold below which the map is dark is
/// chosen so that the share noise_coverage of the box is above it, before the edges fade. The pattern is
/// fixed in the box; with a lifetime it changes: the plane through the noise moves by one node in this time.
PlaneFootprint<double> noise_plane(const Footprint& footprint, std::uint64_t seed, int index,
                                   double instant_s, int threads);

}  // namespace vegard::sim
