#include "fit/photo/pointing/blind/deeper_stars.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace vegard::fit {
namespace {

constexpr double kDeeperStep = 0.5;  // magnitudes
constexpr double kDeeperShare = 0.25, kDeeperChance = 0.1;
constexpr double kBlend_px = 7.0;         // the finder's ring
constexpr double kBlendMagnitudes = 1.5;  // a star so much fainter shifts a place by less than its noise
constexpr double kTaken_px = 2.5;

/// Whether another star of about its brightness, or a brighter one, stands in its ring.
bool is_blend(const std::vector<StarSighting>& sky, const std::vector<ExpectedStar>& expected,
              const ExpectedStar& one, double reach_px) {
  return std::any_of(expected.begin(), expected.end(), [&](const ExpectedStar& other) {
    return other.star != one.star && std::abs(other.x - one.x) < reach_px &&
           std::hypot(other.x - one.x, other.y - one.y) < reach_px &&
           sky[static_cast<std::size_t>(other.star)].magnitude <
               sky[static_cast<std::size_t>(one.star)].magnitude + kBlendMagnitudes;
  });
}

}  // namespace

std::vector<StarSighting> with_deeper_stars(const Calibration& calibration,
                                            const std::vector<StarSighting>& sky,
                                            const std::vector<FoundStar>& points, const SkyPixels& pixels,
                                            int smaller) {
  std::vector<StarSighting> stars = calibration.stars;
  std::set<std::string> names;
  for (const StarSighting& star : stars) names.insert(star.name);
  const double unit = smaller;
  const double radius = std::clamp(3.0 * calibration.rms_px, unit, 2.5 * unit);
  const double noisiest = std::max(2.0 * calibration.rms_px, 0.25 * unit);
  // The points that are left: sharp enough, and no star's yet.
  std::vector<FoundStar> free;
  for (const FoundStar& point : points) {
    const bool taken = std::any_of(stars.begin(), stars.end(), [&](const StarSighting& star) {
      return std::hypot(star.x_px - point.x_px, star.y_px - point.y_px) < kTaken_px * unit;
    });
    if (!taken && point.sigma_px <= noisiest) free.push_back(point);
  }
  const Frame& frame = calibration.frame;
  const PointCells cells(free, frame, free.size());
  const std::vector<ExpectedStar> expected = expected_stars(calibration.camera, frame, sky, pixels);
  std::vector<ExpectedStar> alone;
  for (const ExpectedStar& one : expected)
    if (names.count(sky[static_cast<std::size_t>(one.star)].name) == 0 &&
        !is_blend(sky, expected, one, kBlend_px * unit))
      alone.push_back(one);
  const std::vector<StarMatch> matches =
      each_others_nearest(alone, free, cells, [&](const ExpectedStar&) { return radius; });
  const double around = std::max(25.0, 0.06 * std::max(frame.width_px, frame.height_px));
  double begin = -3.0;
  const double faintest = sky.empty() ? 0.0 : std::ceil(sky.back().magnitude / kDeeperStep) * kDeeperStep;
  for (double end = 4.0; end <= faintest + 1e-9; begin = end, end += kDeeperStep) {
    int in_frame = 0;
    double by_chance = 0.0;
    const auto is_in_step = [&](int star) {
      const double magnitude = sky[static_cast<std::size_t>(star)].magnitude;
      return magnitude > begin && magnitude <= end;
    };
    for (const ExpectedStar& one : alone) {
      if (!is_in_step(one.star)) continue;
      ++in_frame;
      const double density = cells.within(one.x, one.y, around) / (M_PI * around * around);
      by_chance += 1.0 - std::exp(-density * M_PI * radius * radius);
    }
    std::vector<StarSighting> found;
    for (const StarMatch& one : matches) {
      if (!is_in_step(one.star)) continue;
      found.push_back(sky[static_cast<std::size_t>(one.star)]);
      found.back().x_px = free[static_cast<std::size_t>(one.point)].x_px;
      found.back().y_px = free[static_cast<std::size_t>(one.point)].y_px;
    }
    // Among the bright ones most are taken already, and the rest is hidden.
    const auto n = static_cast<double>(found.size());
    const bool good = n >= kDeeperShare * in_frame && by_chance <= kDeeperChance * n;
    if (good) stars.insert(stars.end(), found.begin(), found.end());
    if (!good && begin > 0.0) break;
  }
  std::stable_sort(stars.begin(), stars.end(),
                   [](const StarSighting& a, const StarSighting& b) { return a.magnitude < b.magnitude; });
  return stars;
}

}  // namespace vegard::fit
