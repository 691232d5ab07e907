// Objections to a calibration by stars, and the limits of what stars can constrain.
//
// An error of the time turns the computed sky about the celestial pole, one of the longitude too, one of the
// latitude about the east; and a camera turned as much sees the wrong sky as well as the right one the right
// sky: residuals do not show it. What shows it is that a camera was level, or pointed to the zenith.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/calibration.h"
#include "fit/photo/pointing/star_finder.h"

namespace vegard::fit {

/// Catalogue stars that should be seen, and have no point of light near.
struct UnseenStars {
  int in_view = 0;
  double radius_px = 0.0, faintest = 0.0;
  std::vector<StarSighting> stars;  ///< with the places where they were computed, the brightest first
};

/// Of the stars of `sky` (catalogue_sky()) that this camera has in the picture, where `usable` (per pixel, or
/// empty) does not hide them. Seen are those with a point of light or a recognised star of the calibration
/// within five times its rms and at least 3 px.
UnseenStars unseen_stars(const Calibration& calibration, const std::vector<StarSighting>& sky,
                         double faintest, const std::vector<FoundStar>& points,
                         const std::vector<char>& usable = {});

/// "4 of the 23 stars to magnitude 2.5 in view have no point of light within 3.0 px of their places: Vega
/// (0.0) at (311, 40), …"; empty if all have one.
std::string words_of(const UnseenStars& unseen);

struct LevelEvidence {
  std::string why;            ///< "--camera looks to the zenith"
  double latitude_deg = 0.0;  ///< of the site
};

/// If the axis is more than 2.5 degrees from the zenith, by how much, and by how much the time would have to
/// differ if that were its error: the rotation about the pole that brings the axis nearest to the zenith,
/// at 15.041 degrees an hour, reported where it leaves less than a third. Empty if the axis is at the zenith.
std::string level_doubt(const Calibration& calibration, const LevelEvidence& level);

/// That stars alone cannot reveal an error of the time or of the site; empty if the turns were not all free.
std::string time_and_site_doubt(const Calibration& calibration);

}  // namespace vegard::fit
