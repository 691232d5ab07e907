// Objections to a calibration by stars, and the limits of what stars can constrain.
//
// An error of the time or of the longitude turns the computed sky about the celestial pole, an error of the
// latitude turns it about the east. A camera turned by the same angle fits the wrong sky as well as the true
// camera fits the true sky, so that residuals do not reveal such an error. That a camera was level, or
// pointed to the zenith, does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/calibration.h"
#include "fit/photo/pointing/star_finder.h"

namespace vegard::fit {

/// Catalogue stars that should be seen but have no point of light near.
struct UnseenStars {
  int in_view = 0;
  double radius_px = 0.0, faintest = 0.0;
  std::vector<StarSighting> stars;  ///< with their computed places, the brightest first
};

/// Returns the unseen ones of the stars of `sky` (catalogue_sky()) that this camera has in the picture and
/// that `usable` (per pixel, or empty) does not hide. A star counts as seen if a point of light or a
/// recognised star of the calibration is within five times the calibration's rms, at least 3 px.
UnseenStars unseen_stars(const Calibration& calibration, const std::vector<StarSighting>& sky,
                         double faintest, const std::vector<FoundStar>& points,
                         const std::vector<char>& usable = {});

/// Returns "4 of the 23 stars to magnitude 2.5 in view have no point of light within 3.0 px of their places:
/// Vega (0.0) at (311, 40), …"; empty if all have one.
std::string words_of(const UnseenStars& unseen);

struct LevelEvidence {
  std::string why;            ///< "--camera looks to the zenith"
  double latitude_deg = 0.0;  ///< of the site
};

/// Returns by how much the axis is off the zenith, if it is by more than 2.5 degrees, and the error of the
/// time that would explain it: the rotation about the pole that brings the axis nearest to the zenith,
/// at 15.041 degrees per hour, reported if it leaves less than a third. Returns an empty text if the axis is
/// at the zenith.
std::string level_doubt(const Calibration& calibration, const LevelEvidence& level);

/// Returns the warning that stars alone cannot reveal an error of the time or of the site; empty if the turns
/// were not all free.
std::string time_and_site_doubt(const Calibration& calibration);

}  // namespace vegard::fit
