// The Milky Way: the light of all stars that are too faint to be seen one by one.
//
// Ours, in eleven numbers: stars in a disc and a bulge, dust in a thinner disc, and the light of the stars
// that the dust lets through added up along the line of sight. It has the band, its width, the brighter half
// towards the centre and the dark lane along the middle; of single clouds and rifts it knows nothing. Scale
// lengths and heights are those of the stars and of the dust near the Sun (J. Bland-Hawthorn and O. Gerhard
// 2016, Annual Review of Astronomy and Astrophysics 54, 529: disc 2.6 and 0.30 kpc, the Sun at 8.2 kpc); the
// dust's opacity and the bulge are ESTIMATED. Scaled to 30 stars of tenth magnitude to a square degree at the
// galactic poles, which gives 130 to 600 along the band; Allen's Astrophysical Quantities have 160 to 640
// there. ESTIMATED to be right within a factor of 2.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// V magnitude 10 stars to a square degree, above the air, by galactic longitude and latitude.
double milky_way_s10(double longitude_deg, double latitude_deg);

/// Adds it to linear RGB of the scene's camera, at the middle of the instants.
void add_milky_way(const Scene& scene, const std::vector<double>& instants_s, int threads, Image& light);

}  // namespace vegard::sim
