// Places about the Earth, and the foot of the magnetic field line through one.
//
// The ellipsoid is that of WGS 84; geodetic latitude by B. R. Bowring 1976, Survey Review 23, 323, repeated
// until it stays. The true equator of an orbit's state is turned to the Earth by Greenwich mean sidereal time
// (Vallado et al. 2006, AIAA 2006-6753, appendix C); the pole's wander, 10 m, and UT1 - UTC, 0.9 s at most or
// 400 m at the equator, are left out. The field is IGRF-14's, followed by Runge and Kutta's method of fourth
// order.
#pragma once

#include <array>
#include <optional>

#include "fit/track/sgp4.h"
#include "sim/light/field/igrf.h"

namespace vegard::fit {

using EarthFixed = std::array<double, 3>;  ///< km; x to 0 N 0 E, z to the pole

struct SatellitePlace {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;  ///< above -180, to 180
  double altitude_km = 0.0;
};

EarthFixed earth_fixed(const SatellitePlace& place);
SatellitePlace geodetic(const EarthFixed& km);

/// Returns where a satellite of this state is at a time, seconds since 1970 in UTC.
SatellitePlace place_of_state(const OrbitState& state, double utc_s);

/// Returns the point at `altitude_km` of the field line through a place, downwards; to a metre. Nothing if
/// the place is below, or the line does not come down within 100000 km.
std::optional<SatellitePlace> field_foot(const sim::Igrf& igrf, const SatellitePlace& from,
                                         double altitude_km);

}  // namespace vegard::fit
