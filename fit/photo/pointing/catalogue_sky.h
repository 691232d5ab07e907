// The catalogue's stars in the sky of a picture, and in equatorial axes for pictures whose time is unknown.
//
// In equatorial axes StarSighting::enu is x to the vernal equinox, y to right ascension 90 degrees, z to the
// north pole, J2000: axes that are right-handed as east, north, up are, so that the fits of cameras work with
// them too.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "fit/photo/pointing/star_sighting.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

/// Returns the stars up to a magnitude and above an elevation, the brightest first; x_px and y_px are 0.
/// Stars nearer than `apart_deg` to a brighter one are left out: in the picture they are one.
std::vector<StarSighting> catalogue_sky(const sim::Observer& observer, double julian_date, double faintest,
                                        double min_elevation_deg = 5.0, double apart_deg = 0.3);

/// Returns all stars of data/stars in its order, the brightest first, at the epoch J2000; x_px and y_px are
/// 0.
const std::vector<StarSighting>& equatorial_sky();

/// Convert a place to a vector (x, y, z) of length 1, and back.
Eigen::Vector3d equatorial_vector(const sim::Equatorial& place);
sim::Equatorial equatorial_place(const Eigen::Vector3d& vector);

}  // namespace vegard::fit
