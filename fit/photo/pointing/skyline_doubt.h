// Checks a picture's skyline against the sky, once the camera is known.
//
// A sharp lower border of the light over a dark sky looks like a skyline, and what is below it was masked
// away with the stars that shine there. Ground high above the horizon is trees, houses and hills, whose
// outline is rough; and no star shines through it.
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
  double azimuths_deg = 0.0;            ///< how far along azimuth that is
  int stars_below = 0;     ///< catalogue stars below the high part, above the horizon, with a point of light
  double by_chance = 0.0;  ///< how many of them chance would give

  /// That it is no ground is certain.
  bool has_stars() const;
};

/// `skyline`: a point a column, from left to right. None if it is no higher than 10 degrees over 20 degrees
/// of azimuth, or if it is as rough as ground is and no stars are below it. Stars are asked for if `sky` has
/// time and site.
std::optional<SkylineDoubt> skyline_doubt(const std::vector<PixelPoint>& skyline, const sim::Camera& camera,
                                          const Photo& photo, const SkyOfPicture& sky);

}  // namespace vegard::fit
