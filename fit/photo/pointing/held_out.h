// What a calibration is worth for stars that it has not seen.
//
// A star's residual by a fit without it (calibration.h) says how well its neighbours foretell it. That by a
// fit without all stars of its ninth of the picture says how well the rest of the picture foretells that
// part: the truth about a lens between and beyond its stars.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/pointing/calibration.h"
#include "fit/photo/pointing/star_finder.h"

namespace vegard::fit {

/// The stars in use in a ninth of the picture.
struct RegionHeldOut {
  std::string name;  ///< "upper left", "middle"
  int stars = 0;
  double without_rms_px = 0.0;         ///< of the residuals by fits without each star
  double without_region_rms_px = 0.0;  ///< by a fit without the region's stars; NaN: the others are too few
};

/// Returns the ninths of the picture that have stars in use, from the upper left on by rows.
std::vector<RegionHeldOut> regions_held_out(const Calibration& calibration);

/// Returns the share of the points of light that stars explain. `sky`: the catalogue's stars in that sky,
/// the brightest first.
ExplainedPoints explained_points(const Calibration& calibration, const std::vector<FoundStar>& points,
                                 const std::vector<StarSighting>& sky);

/// Returns "stars held out: each by a fit without it 0.35 px, each ninth of the picture by a fit without its
/// stars 0.52 px, the worst (lower right, 8 stars) 1.2 px".
std::string held_out_line(const Calibration& calibration);

/// Returns "143 of 214 points of light (67 %) are stars to magnitude 6, 5 of them by chance"; empty if no
/// points are known.
std::string explained_line(const Calibration& calibration);

}  // namespace vegard::fit
