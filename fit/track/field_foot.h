// The place of a satellite over the Earth, and the foot of the magnetic field line through one.
//
// Places are on the ellipsoid WGS 84. The true equator of an orbit's state is turned to the Earth by
// Greenwich mean sidereal time (Vallado et al. 2006, AIAA 2006-6753, appendix C); the pole's wander, 10 m,
// and UT1 - UTC, 0.9 s at most or 400 m at the equator, are left out. The field is IGRF-14's, followed by
// Runge and Kutta's method of fourth order.
#pragma once

#include <optional>

#include "fit/track/sgp4.h"
#include "fit/triangulation/earth_shape.h"
#include "sim/light/field/igrf.h"

namespace vegard::fit {

/// Returns where a satellite of this state is at a time, seconds since 1970 in UTC.
GeodeticPlace place_of_state(const OrbitState& state, double utc_s);

/// Returns the point at `height_km` of the field line through a place, downwards; to a metre. Nothing if the
/// place is below, or the line does not come down within 100000 km.
std::optional<GeodeticPlace> field_foot(const sim::Igrf& igrf, const GeodeticPlace& from, double height_km);

}  // namespace vegard::fit
