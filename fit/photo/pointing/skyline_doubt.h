// Checks a picture's skyline against the sky, once the camera is known.
//
// A sharp lower border of an arc over a dark sky looks like a skyline, and the sky below it would be masked,
// with its stars. Ground high above the horizon consists of trees, houses and hills, whose outline is rough
// and through which no star shines.
#pragma once

#include <optional>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/photo/pointing/horizon_calibration.h"
#include "fit/photo/pointing/star_table.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct SkylineDoubt {
  double from_deg = 0.0, to_deg = 0.0;  ///< elevations of its high part
  double azimuths_deg = 0.0;            ///< its extent in azimuth
  int stars_below = 0;     ///< catalogue stars below the high part, above the horizon, with a point of light
  double by_chance = 0.0;  ///< their expected number by chance

  /// True if it is certainly no ground.
  bool has_stars() const;
};

/// Checks a skyline with a point per column, from left to right. Returns nothing if it is nowhere higher than
/// 10 degrees over 20 degrees of azimuth, or if it is as rough as ground and has no stars below it. Stars are
/// examined if `sky` has time and site.
std::optional<SkylineDoubt> skyline_doubt(const std::vector<PixelPoint>& skyline, const sim::Camera& camera,
                                          const Photo& photo, const SkyOfPicture& sky);

}  // namespace vegard::fit
