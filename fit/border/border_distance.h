// The distance and the position of a border for an assumed height, on a sphere of 6371 km.
#pragma once

#include <array>

#include "sim/scene/structs/site.h"

namespace vegard::fit {

/// Altitudes for which distances are given, km: lower borders of arcs lie between 95 and 110 km (Störmer
/// 1955, "The polar aurora"; docs/forms.md).
inline constexpr std::array<double, 4> kBorderAltitudesKm = {95.0, 100.0, 105.0, 110.0};

/// Returns the true elevation for an apparent one, i.e. without refraction: Saemundsson's formula
/// (sim/view/sky/star_place.h), inverted, for the standard atmosphere above the site's height.
double true_elevation_deg(double apparent_elevation_deg, double site_altitude_m);

struct BorderPlace {
  double distance_km = 0.0;        ///< along the ground, at sea level, to the point below the border
  double distance_error_km = 0.0;  ///< from the elevation's error alone
  double latitude_deg = 0.0, longitude_deg = 0.0;  ///< on the sphere; longitude above -180, to 180
};

/// Returns the place of a border that is seen in a direction of the camera (apparent elevation). NaN where
/// the line of sight does not reach the altitude.
BorderPlace border_place(const sim::Site& site, double azimuth_deg, double apparent_elevation_deg,
                         double elevation_error_deg, double altitude_km);

/// Returns the distance along the ground by the true elevation; NaN as above.
double ground_distance_km(double true_elevation_deg, double site_altitude_m, double altitude_km);

/// The inverse: returns the true elevation of a point at this distance and altitude.
double elevation_of_place_deg(double ground_distance_km, double site_altitude_m, double altitude_km);

/// Returns the latitude at this distance along the ground.
double latitude_of_place_deg(const sim::Site& site, double azimuth_deg, double ground_distance_km);

}  // namespace vegard::fit
