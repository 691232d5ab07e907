// Where a camera looked, and from where, when neither time nor place is known: a horizon tells where among
// the recognised stars the zenith was, the celestial pole then tells north, and the declination of the zenith
// is the latitude. With the time, its right ascension gives the longitude.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/star_sighting.h"
#include "sim/scene/structs/camera.h"

namespace vegard::fit {

/// Standard errors are those that the camera's elevation and roll make.
struct StarsOverHorizon {
  double azimuth_deg = 0.0, azimuth_error_deg = 0.0;  ///< of the camera's axis, 0 to 360
  double latitude_deg = 0.0, latitude_error_deg = 0.0;
  double sidereal_time_deg = 0.0, sidereal_time_error_deg = 0.0;  ///< local, 0 to 360

  /// From -180 to 180 degrees; its error is that of the sidereal time.
  double longitude_deg(double julian_date) const;
};

/// `stars`: with directions as in equatorial_sky() (fit/photo/pointing/catalogue_sky.h). `camera`: by a
/// horizon, whose azimuth is assumed. The equinox is that of the catalogue, 0.3 degrees off at most until
/// 2050, and refraction is left out. There is no answer of fewer than three stars, of stars that do not stand
/// as in this camera to within two degrees, or near the Earth's poles, where there is no north.
std::optional<StarsOverHorizon> stars_over_horizon(const std::vector<StarSighting>& stars,
                                                   const sim::Camera& camera, double elevation_error_deg,
                                                   double roll_error_deg);

/// "the camera looked to azimuth 57 ± 5°, from a latitude of 64 ± 2°", and with a time the longitude.
std::string words_of(const StarsOverHorizon& found, std::optional<double> julian_date);

}  // namespace vegard::fit
