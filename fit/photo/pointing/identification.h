// Identifies points of light in a picture with catalogued stars, starting from an approximate camera.
//
// First the camera is turned about its axis, through all angles or a few degrees, and its centre moved a
// little, until the most bright stars have a point of light near the place where they should be seen, each
// weighed by its brightness. Then the identification grows: the brightest stars are matched with the nearest
// points within a radius, the camera is fitted (robustly), and again with fainter stars and a smaller radius,
// down to a few times the scatter. A point is matched with one star and a star with one point, and only where
// each is the other's nearest.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/pointing/camera_fit.h"
#include "fit/photo/pointing/star_finder.h"

namespace vegard::fit {

struct IdentificationSettings {
  double first_radius_px = 12.0, last_radius_px = 2.5;
  double first_magnitude = 2.5, faintest = 4.0;
  double twist_deg = 5.0;    ///< how far the camera may be turned about its axis; 180: nothing is known
  double shift_px = 12.0;    ///< how far its centre may be off
  double scale_share = 0.0;  ///< how far its focal_px may be off, as a share of it
  int rounds = 5;
  std::vector<LensNumber> free;  ///< while growing
};

struct Identification {
  SkyCamera camera;
  std::vector<StarSighting> stars;  ///< those that were recognised, with the places where they are seen
  int in_frame = 0;                 ///< how many of the catalogue should be seen
  double by_chance = 0.0;           ///< how many would have a point that near if points were strewn at random
  double last_radius_px = 0.0;
};

/// Whether more stars were recognised than a search through many cameras brings together of points strewn at
/// random: a fifth of those that should be seen, and five more than three times those by chance.
bool is_trustworthy(const Identification& found);

/// `sky`: catalogue_sky(), the brightest first.
Identification identify(const SkyCamera& rough, const Frame& frame, const std::vector<StarSighting>& sky,
                        const std::vector<FoundStar>& points, const IdentificationSettings& settings);

}  // namespace vegard::fit
