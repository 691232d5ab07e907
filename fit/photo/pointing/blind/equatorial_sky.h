// The stars of the table in equatorial axes, for pictures of which no time is known.
//
// A StarSighting's three numbers are then x to the vernal equinox, y to right ascension 90 degrees, z to the
// north pole, J2000: right-handed as east, north, up are, so that all that fits cameras serves them too.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "fit/photo/pointing/star_sighting.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

/// All stars of data/stars in its order, the brightest first, at the epoch J2000; x_px and y_px are 0.
const std::vector<StarSighting>& equatorial_sky();

/// x, y, z of length 1 of a place, and back.
Eigen::Vector3d equatorial_vector(const sim::Equatorial& place);
sim::Equatorial equatorial_place(const Eigen::Vector3d& vector);

}  // namespace vegard::fit
