// Converts stars of a blind recognition to those of a calibration, once time and site are known.
#pragma once

#include <vector>

#include "fit/photo/pointing/blind/picture_stars.h"
#include "fit/photo/pointing/identification.h"
#include "fit/photo/pointing/sky_camera.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

struct LocalStars {
  /// More than a tenth of the recognised stars were below the horizon: time or site is not this picture's,
  /// and nothing else is set but the count.
  bool elsewhere = false;
  int recognised = 0, below_horizon = 0;
  std::vector<StarSighting> stars;  ///< for the calibration
  SkyCamera camera;                 ///< for it to start from
  Identification again;             ///< all of the catalogue's among all points, under the local sky
};

/// `picture` has been recognised. The catalogue is asked to the magnitude `faintest` and down to the
/// elevation `min_elevation_deg`, not below the horizon.
LocalStars local_stars(const PictureStars& picture, const Frame& frame, const sim::Observer& observer,
                       double julian_date, double faintest, double min_elevation_deg);

}  // namespace vegard::fit
