// The Moon's disc with its phase.
//
// A sphere that scatters as Lommel and Seeliger have it (mu0 / (mu0 + mu): a full Moon is evenly bright up to
// its limb), without its seas, as bright in all as magnitude_of_moon() says at its distance, and of its
// colour, B - V = 0.92 (Allen's Astrophysical Quantities). Without earthshine.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Adds it to linear RGB of the scene's camera: the mean of the instants.
void add_moon_disc(const Scene& scene, const std::vector<double>& instants_s, int threads, Image& light);

/// The light of a spot of the disc, at (u, v) of its radius from the middle, u towards the Sun; 0 off the
/// disc and by night. 1/2 everywhere on a full Moon.
double moon_spot(double u, double v, double phase_angle_deg);

}  // namespace vegard::sim
