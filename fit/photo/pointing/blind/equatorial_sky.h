// The stars of the catalogue in equatorial axes, for pictures whose time is unknown.
//
// StarSighting::enu is then x to the vernal equinox, y to right ascension 90 degrees, z to the north pole,
// J2000: axes that are right-handed as east, north, up are, so that the fits of cameras work with them too.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "fit/photo/pointing/star_sighting.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

/// Returns all stars of data/stars in its order, the brightest first, at the epoch J2000; x_px and y_px are
/// 0.
const std::vector<StarSighting>& equatorial_sky();

/// Convert a place to a vector (x, y, z) of length 1, and back.
Eigen::Vector3d equatorial_vector(const sim::Equatorial& place);
sim::Equatorial equatorial_place(const Eigen::Vector3d& vector);

}  // namespace vegard::fit
