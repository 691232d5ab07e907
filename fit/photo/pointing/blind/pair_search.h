// Finds cameras under a sky that is known by time and place.
//
// An assumed lens (assumed_lens.h) makes directions of two points of light; two stars as far apart, within
// the steps between the lenses, give the rotation and the scale. Only cameras that people put up are looked
// at: with the horizon nearly level in the picture, or near the zenith. Each is compared with the stars
// around the pair. Unlike an asterism of four, a pair needs but two true stars among the brightest points,
// and a known sky has few bright stars: pictures with many false points are recognised so.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/photo/pointing/blind/assumed_lens.h"
#include "fit/photo/pointing/star_finder.h"

namespace vegard::fit {

struct PairSearch {
  std::vector<CameraHit> hits;  ///< the best first
  double cameras = 0.0;         ///< number of cameras that were compared
};

/// Searches with the `first_points` first points. `stars`: directions in any axes, the brightest first; those
/// that are not above the horizon have NaN; `zenith` in the same axes. The result is deterministic.
PairSearch search_pairs(const std::vector<FoundStar>& points, const Frame& frame,
                        const std::vector<StarSighting>& stars, const Eigen::Vector3d& zenith,
                        int first_points, std::size_t most_hits);

}  // namespace vegard::fit
