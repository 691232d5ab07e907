// Identifies points of light in a picture with catalogued stars, starting from an approximate camera.
//
// First the camera is turned about its axis, by all angles or by a few degrees, and its centre is shifted, so
// that the largest number of bright stars, weighted by brightness, have a point of light near their computed
// places. Then the brightest stars are matched with the nearest points within a radius and the camera is
// fitted robustly; this is repeated with fainter stars and a smaller radius, down to a few times the scatter.
// A star and a point are matched if each is the other's nearest.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/pointing/camera_fit.h"
#include "fit/photo/pointing/chance_agreement.h"
#include "fit/photo/pointing/star_finder.h"

namespace vegard::fit {

struct IdentificationSettings {
  double first_radius_px = 12.0, last_radius_px = 2.5;
  double first_magnitude = 2.5, faintest = 4.0;
  double twist_deg = 5.0;    ///< largest error of the turn about the axis; 180: it is unknown
  double shift_px = 12.0;    ///< largest error of the centre
  double scale_share = 0.0;  ///< largest relative error of focal_px
  int rounds = 5;
  std::vector<LensNumber> free;  ///< the numbers that are fitted
  SkyPixels pixels;              ///< where the picture shows sky
};

struct Identification {
  SkyCamera camera;
  std::vector<StarSighting> stars;  ///< the recognised stars with their places in the picture
  int in_frame = 0;                 ///< number of the catalogue's stars that should be seen
  double by_chance = 0.0;           ///< expected number of stars with a point as near among points at random
  double last_radius_px = 0.0;
  ChanceAgreement agreement;  ///< the count that chance explains least, after so long a search
};

/// True if the search would find so many stars among points at random less than once in 10^8 times.
bool is_trustworthy(const Identification& found);

/// Returns the magnitude to which stars are looked for: `faintest`, or as much deeper as a narrow field needs
/// to show `enough` stars of `sky`, the brightest first.
double faintest_for_field(const SkyCamera& camera, const Frame& frame, const std::vector<StarSighting>& sky,
                          double faintest, int enough = 30);

/// Identifies the stars of `sky` (catalogue_sky(), the brightest first) among the points.
Identification identify(const SkyCamera& rough, const Frame& frame, const std::vector<StarSighting>& sky,
                        const std::vector<FoundStar>& points, const IdentificationSettings& settings);

}  // namespace vegard::fit
