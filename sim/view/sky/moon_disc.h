// The Moon's disc with its phase.
//
// A sphere with the Lommel-Seeliger law (mu0 / (mu0 + mu): a full Moon is uniformly bright up to its limb),
// without maria and earthshine. Its total brightness is that of magnitude_of_moon() at its distance, its
// colour is B - V = 0.92 (Allen's Astrophysical Quantities).
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Adds the disc to linear RGB of the scene's camera: the mean over the instants.
void add_moon_disc(const Scene& scene, const std::vector<double>& instants_s, int threads, Image& light);

/// Returns the relative light at the point (u, v) of the disc, in radii from the middle, u towards the Sun:
/// 1/2 everywhere on a full Moon, 0 off the disc and on the night side.
double moon_spot(double u, double v, double phase_angle_deg);

}  // namespace vegard::sim
