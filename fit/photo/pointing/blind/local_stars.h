// Converts stars of a blind recognition to those of a calibration, once time and site are known.
#pragma once

#include <vector>

#include "fit/photo/pointing/blind/star_recognition.h"
#include "fit/photo/pointing/identification.h"
#include "fit/photo/pointing/sky_camera.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

struct LocalStars {
  /// True if more than a tenth of the recognised stars were below the horizon: time or site do not belong to
  /// this picture, and only the counts are set.
  bool elsewhere = false;
  int recognised = 0, below_horizon = 0;
  std::vector<StarSighting> stars;  ///< for the calibration
  SkyCamera camera;                 ///< the start of the calibration
  Identification again;             ///< the catalogue's stars identified among all points, in the local sky
};

/// Converts the stars of a recognised picture. Stars of the catalogue are those up to the magnitude
/// `faintest` and above the elevation `min_elevation_deg`, at least above the horizon.
LocalStars local_stars(const PictureStars& picture, const Frame& frame, const sim::Observer& observer,
                       double julian_date, double faintest, double min_elevation_deg);

}  // namespace vegard::fit
