// The probability that stars and points of light agree by chance.
//
// Among points at random, as dense as around the star, a star would have one within r with the probability
// p = 1 - exp(-density pi r^2). The number of stars with a point is then nearly a Poisson variable with the
// mean sum p. Two fitted numbers use up the two coordinates of a star, so that of n stars n - k / 2 are
// evidence. The probability of at least that many, times the number of cameras and of ways to count that were
// tried, is the expected number of wrong recognitions in this search; `log10_false` is its logarithm.
//
// A count needs a quarter of the stars that it looks for. And clouds, trees and twilight hide bright stars no
// more than faint ones: if the bright half of a count's stars has a point less than half as often as the
// faint half, and a binomial variable with the faint half's share is as small once in a thousand, the points
// are no stars.
#pragma once

#include <cmath>
#include <vector>

#include "fit/photo/pointing/sky_camera.h"
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

/// Where the picture shows sky.
struct SkyPixels {
  SkyPixels() = default;
  explicit SkyPixels(std::vector<char> usable_pixels);

  std::vector<char> usable;  ///< per pixel, 0 where it shows no sky; empty: it shows sky everywhere
  double share = 1.0;        ///< the share of the pixels that show sky
};

/// A star where a camera has its image.
struct ExpectedStar {
  int star;
  double x, y;
};

/// Returns the stars that the camera should see in the frame's sky, in the order of `stars`.
std::vector<ExpectedStar> expected_stars(const SkyCamera& camera, const Frame& frame,
                                         const std::vector<StarSighting>& stars,
                                         const SkyPixels& pixels = {});

/// Returns the stars and points that are each other's nearest; `tolerance` gives the radius for a star, 0 for
/// none.
template <class Tolerance>
std::vector<StarMatch> each_others_nearest(const std::vector<ExpectedStar>& expected,
                                           const std::vector<FoundStar>& points, const PointCells& cells,
                                           const Tolerance& tolerance) {
  std::vector<int> of_point(points.size(), -1);
  std::vector<double> distance_of(points.size(), 0.0);
  for (const ExpectedStar& one : expected) {
    const double radius = tolerance(one);
    if (!(radius > 0.0)) continue;
    double distance = 0.0;
    const int p = cells.nearest(one.x, one.y, radius, distance);
    if (p < 0 || (of_point[p] >= 0 && distance_of[p] <= distance)) continue;
    of_point[p] = one.star;
    distance_of[p] = distance;
  }
  std::vector<StarMatch> matches;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (of_point[p] >= 0) matches.push_back({of_point[p], static_cast<int>(p)});
  return matches;
}

/// The count of stars that chance explains least.
struct ChanceAgreement {
  std::vector<StarMatch> matches;
  int in_frame = 0;          ///< number of stars up to `faintest` that should be seen
  double faintest = 0.0;     ///< limiting magnitude of the count
  double radius_px = 0.0;    ///< radius of the count
  double by_chance = 0.0;    ///< expected number of stars with a point by chance
  double log10_false = 0.0;  ///< log10 of the expected number of wrong recognitions
};

/// Counts in several radii and to several magnitudes. `stars`: the brightest first; `numbers`: how many of
/// the camera's were fitted to the points; `trials`: number of cameras that were tried.
ChanceAgreement agreement_against_chance(const SkyCamera& camera, const Frame& frame,
                                         const std::vector<StarSighting>& stars,
                                         const std::vector<FoundStar>& points, const PointCells& cells,
                                         double numbers, double trials, const SkyPixels& pixels = {});

/// Returns log10 of the probability that a Poisson variable is at least n, which need not be whole.
double log10_poisson_tail(double n, double mean);

/// True if less than one in 10^8 searches would be wrong.
bool is_no_chance(const ChanceAgreement& agreement);

/// Returns "3 of the 38 stars to magnitude 2.5 that it should show have a point within 1.5 px, where chance
/// gives 2.1".
std::string words_of(const ChanceAgreement& agreement);

}  // namespace vegard::fit
