#include "fit/photo/pointing/blind/pair_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace {

constexpr int kPairStars = 26, kComparedStars = 60;
constexpr double kPairScale = 1.18;                         // half of a step between assumed lenses
constexpr double kShortestPair = 0.06, kLongestPair = 0.5;  // of the picture's longer side
constexpr double kLevelRoll = 0.26, kNearZenith = 0.90;     // sine of 15 degrees, cosine of 26 degrees
constexpr double kPairScore = 4.0;

/// Three axes of two directions: the first, across towards the second, and the third.
Eigen::Matrix3d axes_of_pair(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  Eigen::Matrix3d axes;
  axes.col(0) = (first + second).normalized();
  axes.col(2) = first.cross(second).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

struct StarPair {
  int first, second;
  double angle;
};

/// What the searches under all lenses share.
struct PairSky {
  std::vector<Eigen::Vector3d> stars;  ///< those above the horizon
  std::vector<int> indices;            ///< their indices in the catalogue
  std::vector<StarPair> pairs;         ///< in the order of their angles; each in both orders
};

PairSky pair_sky(const std::vector<StarSighting>& stars) {
  PairSky sky;
  for (std::size_t i = 0; i < stars.size() && sky.stars.size() < kComparedStars; ++i) {
    if (!std::isfinite(stars[i].enu[0])) continue;
    sky.stars.emplace_back(stars[i].enu[0], stars[i].enu[1], stars[i].enu[2]);
    sky.indices.push_back(static_cast<int>(i));
  }
  const int n = std::min(kPairStars, static_cast<int>(sky.stars.size()));
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      if (a == b) continue;
      const double angle = angle_between(sky.stars[a], sky.stars[b]);
      if (angle > 0.02 && angle < 2.3) sky.pairs.push_back({a, b, angle});
    }
  std::stable_sort(sky.pairs.begin(), sky.pairs.end(),
                   [](const StarPair& a, const StarPair& b) { return a.angle < b.angle; });
  return sky;
}

/// The search under one assumed lens.
class LensPairs {
 public:
  LensPairs(const std::vector<FoundStar>& points, const Frame& frame, const PairSky& sky,
            const Eigen::Vector3d& zenith, const PointCells& near, double near_count)
      : points_(points), frame_(frame), sky_(sky), zenith_(zenith), near_(near) {
    unit_ = std::max(1.0, std::max(frame.width_px, frame.height_px) / 1500.0);
    density_ = 1.5 * near_count / (static_cast<double>(frame.width_px) * frame.height_px);
  }

  void run(const SkyCamera& assumed, int first_points, PairSearch& found) {
    const sim::Lens<double> lens = lens_of(assumed, assumed.numbers.data());
    const double size = std::max(frame_.width_px, frame_.height_px);
    std::vector<Eigen::Vector3d> seen;
    std::vector<int> index;
    for (int i = 0; i < first_points; ++i) {
      double v[3];
      if (!sim::unproject(lens, points_[i].x_px, points_[i].y_px, v)) continue;
      seen.emplace_back(v[0], v[1], v[2]);
      index.push_back(i);
    }
    for (std::size_t i = 0; i < seen.size(); ++i)
      for (std::size_t j = i + 1; j < seen.size(); ++j) {
        const FoundStar &a = points_[index[i]], &b = points_[index[j]];
        const double length = std::hypot(a.x_px - b.x_px, a.y_px - b.y_px);
        if (length < kShortestPair * size || length > kLongestPair * size) continue;
        const double angle = angle_between(seen[i], seen[j]);
        const auto begin =
            std::lower_bound(sky_.pairs.begin(), sky_.pairs.end(), angle / kPairScale,
                             [](const StarPair& pair, double least) { return pair.angle < least; });
        for (auto pair = begin; pair != sky_.pairs.end() && pair->angle <= angle * kPairScale; ++pair)
          compare(assumed, index[i], index[j], angle, *pair, found);
      }
  }

 private:
  /// Whether people put up a camera so.
  bool is_put_up(const Eigen::Matrix3d& camera_from_sky) const {
    const Eigen::Vector3d up = camera_from_sky * zenith_;
    if (up[2] > kNearZenith) return true;
    const double across = std::hypot(up[0], up[1]);
    return up[1] < 0.0 && std::abs(up[0]) < kLevelRoll * across && up[2] > -0.5;
  }

  void compare(const SkyCamera& assumed, int a, int b, double angle, const StarPair& pair,
               PairSearch& found) {
    SkyCamera camera = assumed;
    // The directions change with the scale: what is kept is the lens that has the pair's angle.
    camera.numbers[focal_px_number] *= angle / pair.angle;
    const sim::Lens<double> lens = lens_of(camera, camera.numbers.data());
    double va[3], vb[3];
    if (!sim::unproject(lens, points_[a].x_px, points_[a].y_px, va) ||
        !sim::unproject(lens, points_[b].x_px, points_[b].y_px, vb))
      return;
    camera.camera_from_enu = axes_of_pair({va[0], va[1], va[2]}, {vb[0], vb[1], vb[2]}) *
                             axes_of_pair(sky_.stars[pair.first], sky_.stars[pair.second]).transpose();
    if (!is_put_up(camera.camera_from_enu)) return;
    found.cameras += 1.0;
    const double middle_x = 0.5 * (points_[a].x_px + points_[b].x_px);
    const double middle_y = 0.5 * (points_[a].y_px + points_[b].y_px);
    const double length = std::hypot(points_[a].x_px - points_[b].x_px, points_[a].y_px - points_[b].y_px);
    const double reach = 1.2 * length;
    CameraHit hit;
    hit.camera = camera;
    hit.reach_px = reach;
    hit.seed = {{sky_.indices[pair.first], a}, {sky_.indices[pair.second], b}};
    const int faintest = std::max({pair.first, pair.second, kPairStars / 2});
    const int last = std::min(static_cast<int>(sky_.stars.size()), 2 * faintest);
    for (int i = 0; i < last; ++i) {
      if (i == pair.first || i == pair.second) continue;
      const Eigen::Vector3d v = camera.camera_from_enu * sky_.stars[i];
      const double in_camera[3] = {v[0], v[1], v[2]};
      double x = 0.0, y = 0.0, distance = 0.0;
      if (!sim::project(lens, in_camera, x, y) || x < 0.0 || y < 0.0 || x > frame_.width_px ||
          y > frame_.height_px)
        continue;
      const double from = std::hypot(x - middle_x, y - middle_y);
      if (from > reach) continue;
      const double tolerance = 2.0 * unit_ + 0.03 * std::max(from, 0.5 * length);
      const int p = near_.nearest(x, y, tolerance, distance);
      const bool taken = p < 0 || std::any_of(hit.seed.begin(), hit.seed.end(),
                                              [&](const StarMatch& m) { return m.point == p; });
      if (taken) {
        hit.count_missing(i <= faintest);
        continue;
      }
      hit.count_seen(i <= faintest, density_, tolerance);
      hit.seed.push_back({sky_.indices[i], p});
    }
    if (hit.seed.size() >= 4 && hit.score > kPairScore) found.hits.push_back(std::move(hit));
  }

  const std::vector<FoundStar>& points_;
  const Frame& frame_;
  const PairSky& sky_;
  const Eigen::Vector3d& zenith_;
  const PointCells& near_;
  double unit_ = 1.0, density_ = 0.0;
};

void keep_best(std::vector<CameraHit>& hits, std::size_t most) {
  std::stable_sort(hits.begin(), hits.end(),
                   [](const CameraHit& a, const CameraHit& b) { return a.score > b.score; });
  if (hits.size() > most) hits.resize(most);
}

}  // namespace

PairSearch search_pairs(const std::vector<FoundStar>& points, const Frame& frame,
                        const std::vector<StarSighting>& stars, const Eigen::Vector3d& zenith,
                        int first_points, std::size_t most_hits) {
  const int n = std::min(first_points, static_cast<int>(points.size()));
  const PairSky sky = pair_sky(stars);
  const auto near_count = static_cast<std::size_t>(std::min(2 * n + 10, static_cast<int>(points.size())));
  const PointCells near(points, frame, near_count);
  const std::vector<AssumedLens>& lenses = assumed_lenses();
  std::vector<PairSearch> by_lens(2 * lenses.size());
  sim::parallel_for(by_lens.size(), 0, [&](std::size_t i, int) {
    LensPairs pairs(points, frame, sky, zenith, near, static_cast<double>(near_count));
    const SkyCamera camera =
        assumed_camera(lenses[i / 2], i % 2 == 1, frame, 0.5 * frame.width_px, 0.5 * frame.height_px);
    pairs.run(camera, n, by_lens[i]);
    keep_best(by_lens[i].hits, most_hits);
  });
  PairSearch all;
  for (PairSearch& one : by_lens) {
    all.cameras += one.cameras;
    for (CameraHit& hit : one.hits) all.hits.push_back(std::move(hit));
  }
  keep_best(all.hits, most_hits);
  return all;
}

}  // namespace vegard::fit
