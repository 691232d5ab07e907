// Grows a camera from a few recognised stars to all stars in the picture, and computes the probability that
// the agreement is by chance.
//
// The camera grows outwards from an asterism of four stars: stars of the catalogue are predicted within a
// radius, each is matched with the nearest point if it is also the point's nearest, the camera is fitted
// robustly, the radius grows and the tolerance shrinks. The centre and the lens are fitted as soon as there
// are enough stars; of several lenses the one with the smallest residuals is taken.
//
// Among points at random, as dense as around the star, a star would have one within r with the probability
// p = 1 - exp(-density pi r^2). The number of stars with a point is then nearly a Poisson variable with the
// mean sum p. Two fitted numbers use up the two coordinates of a star, so that of n stars n - k / 2 are
// evidence. The probability of at least that many, times the number of cameras and of ways to count that were
// tried, is the expected number of wrong recognitions in this search; `log10_false` is its logarithm.
#pragma once

#include <vector>

#include "fit/photo/pointing/camera_fit.h"
#include "fit/photo/pointing/lens_form.h"
#include "fit/photo/pointing/star_finder.h"

namespace vegard::fit {

/// Indices of a star and a point that are matched.
struct StarMatch {
  int star = 0, point = 0;
};

/// Points of light by place.
class PointCells {
 public:
  PointCells(const std::vector<FoundStar>& points, const Frame& frame, std::size_t first);
  /// Returns the nearest point within the radius, or -1; `distance` is in px.
  int nearest(double x, double y, double radius, double& distance) const;
  int within(double x, double y, double radius) const;  ///< number of points within the radius

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
  int in_frame = 0;          ///< number of stars up to `faintest` that should be seen
  double faintest = 0.0;     ///< limiting magnitude of the count
  double radius_px = 0.0;    ///< radius of the count
  double by_chance = 0.0;    ///< expected number of stars with a point by chance
  double log10_false = 0.0;  ///< log10 of the expected number of wrong recognitions
  double rms_px = 0.0;       ///< sqrt(sum (dx^2 + dy^2) / N)
};

/// Grows `start`. `stars`: in any axes, the brightest first. `seed`: the stars recognised so far; `reach_px`:
/// radius around their middle within which they constrain the camera. `trials`: number of cameras tried
/// before.
GrownCamera grow_camera(const SkyCamera& start, const Frame& frame, const std::vector<StarSighting>& stars,
                        const std::vector<FoundStar>& points, const PointCells& cells,
                        const std::vector<StarMatch>& seed, double reach_px, double trials);

/// True if the recognition is certain: less than one wrong recognition in 10^8 searches, and a quarter of the
/// stars that should be seen.
bool is_certain(const GrownCamera& grown);

}  // namespace vegard::fit
