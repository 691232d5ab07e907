// A camera grown from a few recognised stars to all that the picture shows, and the chance that it is none.
//
// From the place of a figure of four stars outwards: stars of the table are predicted within a radius, each
// is matched with the nearest point (and the point with it), the camera is fitted robustly, the radius grows
// and the tolerance shrinks. The centre and the lens are free as soon as enough stars hold them; of several
// lenses that one is taken which leaves the least.
//
// How likely is it that chance agrees as well? If points were strewn at random, as densely as they lie around
// the star, a star would find one within r with the probability p = 1 - exp(-density pi r^2). Of the stars
// that should be seen the number with a point is then nearly a Poisson variable of mean sum p. Two
// coordinates of a star are spent by two of the fitted numbers, so that of n stars n - k / 2 are evidence.
// The probability of that many or more, times the number of cameras and of ways to count that were tried, is
// the number of wrong recognitions to be expected of this search: `log10_false` is its logarithm.
#pragma once

#include <vector>

#include "fit/photo/pointing/camera_fit.h"
#include "fit/photo/pointing/lens_form.h"
#include "fit/photo/pointing/star_finder.h"

namespace vegard::fit {

/// Star and point that are each other's, as indices.
struct StarMatch {
  int star = 0, point = 0;
};

/// Points of light by place.
class PointCells {
 public:
  PointCells(const std::vector<FoundStar>& points, const Frame& frame, std::size_t first);
  /// The nearest within the radius, or -1; `distance` in px.
  int nearest(double x, double y, double radius, double& distance) const;
  int within(double x, double y, double radius) const;  ///< how many are that near

 private:
  int column(double x) const;
  int row(double y) const;
  const std::vector<FoundStar>& points_;
  double cell_px_;
  int columns_, rows_;
  std::vector<std::vector<int>> cells_;
};

struct GrownCamera {
  SkyCamera camera;
  LensForm form;
  std::vector<StarMatch> matches;
  int in_frame = 0;          ///< stars to `faintest` that should be seen
  double faintest = 0.0;     ///< magnitude that counted
  double radius_px = 0.0;    ///< within which a point counted
  double by_chance = 0.0;    ///< how many would have one by chance
  double log10_false = 0.0;  ///< of the expected number of wrong recognitions
  double rms_px = 0.0;       ///< sqrt(sum (dx^2 + dy^2) / N)
};

/// `stars`: in axes of any kind, the brightest first. `seed`: the stars recognised so far; `reach_px` how far
/// from their middle they tell. `trials`: how many cameras were thought of before.
GrownCamera grow_camera(const SkyCamera& start, const Frame& frame, const std::vector<StarSighting>& stars,
                        const std::vector<FoundStar>& points, const PointCells& cells,
                        const std::vector<StarMatch>& seed, double reach_px, double trials);

/// Whether it is beyond doubt: less than one wrong recognition in 10^8 searches, and a quarter of the stars
/// that should be seen.
bool is_certain(const GrownCamera& grown);

}  // namespace vegard::fit
