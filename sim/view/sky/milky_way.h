// The Milky Way: the light of all stars that are too faint to be seen individually.
//
// Our own model with eleven numbers: stars in a disc and a bulge, dust in a thinner disc, and the integral of
// the attenuated starlight along the line of sight. It has the band, its width, the brighter half towards the
// centre and the dark lane along the middle, but no single clouds and rifts. Scale lengths and heights are
// those of stars and dust near the Sun (J. Bland-Hawthorn and O. Gerhard 2016, Annual Review of Astronomy and
// Astrophysics 54, 529: disc 2.6 and 0.30 kpc, the Sun at 8.2 kpc); the dust's opacity and the bulge are
// ESTIMATED. The brightness is scaled to 30 stars of tenth magnitude per square degree at the galactic poles,
// which gives 130 to 600 along the band; Allen's Astrophysical Quantities have 160 to 640 there. ESTIMATED to
// be right within a factor of 2.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the brightness above the air in stars of V magnitude 10 per square degree, at galactic
/// coordinates.
double milky_way_s10(double longitude_deg, double latitude_deg);

/// Adds the Milky Way to linear RGB of the scene's camera, at the middle of the instants.
void add_milky_way(const Scene& scene, const std::vector<double>& instants_s, int threads, Image& light);

}  // namespace vegard::sim
