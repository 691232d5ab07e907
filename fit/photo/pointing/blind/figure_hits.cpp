#include "fit/photo/pointing/blind/figure_hits.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "sim/base/parallel.h"

namespace vegard::fit {
namespace {

constexpr double kLowestOfFigure = -0.01;  // refraction lifts the horizon by half a degree

/// Three axes of two directions: the middle, across towards the second, and the third.
Eigen::Matrix3d figure_axes(const Eigen::Vector3d& middle, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to) {
  Eigen::Matrix3d axes;
  axes.col(0) = middle;
  axes.col(1) = ((to - from) - middle * middle.dot(to - from)).normalized();
  axes.col(2) = middle.cross(axes.col(1));
  return axes;
}

/// Rotation and scale by the figure, then the stars around it.
void try_figure(const FigureSky& all, const SkyCamera& assumed, const Asterism& picture, const Asterism& sky,
                const PointCells& near, double near_count, FigureHits& found_hits) {
  const std::vector<Eigen::Vector3d>& stars = all.stars;
  const Frame& frame = all.frame;
  const FigureLimits& limits = all.limits;
  Eigen::Vector3d sky_middle = Eigen::Vector3d::Zero();
  for (const int m : sky.members) {
    if (all.zenith && stars[m].dot(*all.zenith) < kLowestOfFigure) return;
    sky_middle += stars[m];
  }
  sky_middle.normalize();
  found_hits.tried += 1.0;
  SkyCamera camera = assumed;
  camera.numbers[focal_px_number] *= picture.size_rad / sky.size_rad;
  const sim::Lens<double> lens = lens_of(camera, camera.numbers.data());
  Eigen::Vector3d seen[4], middle = Eigen::Vector3d::Zero();
  double middle_x = 0.0, middle_y = 0.0, size_px = 0.0, reach_angle = 0.0;
  for (int i = 0; i < 4; ++i) {
    const FoundStar& point = all.points[picture.members[i]];
    double v[3];
    if (!sim::unproject(lens, point.x_px, point.y_px, v)) return;
    seen[i] = {v[0], v[1], v[2]};
    middle += seen[i];
    middle_x += 0.25 * point.x_px;
    middle_y += 0.25 * point.y_px;
  }
  middle.normalize();
  int faintest = 0;
  for (int i = 0; i < 4; ++i) {
    const FoundStar& point = all.points[picture.members[i]];
    size_px = std::max(size_px, std::hypot(point.x_px - middle_x, point.y_px - middle_y));
    const Eigen::Vector3d& star = stars[sky.members[i]];
    reach_angle = std::max(reach_angle, std::atan2(star.cross(sky_middle).norm(), star.dot(sky_middle)));
    faintest = std::max(faintest, sky.members[i]);
  }
  camera.camera_from_enu = figure_axes(middle, seen[0], seen[1]) *
                           figure_axes(sky_middle, stars[sky.members[0]], stars[sky.members[1]]).transpose();
  const double least = std::cos(std::min(limits.around * reach_angle, limits.most_around_rad));
  const double density = 1.5 * near_count / (static_cast<double>(frame.width_px) * frame.height_px);
  const double unit = std::max(1.0, std::max(frame.width_px, frame.height_px) / 1500.0);
  CameraHit hit{0.0, camera, {}, limits.grown_share * size_px};
  const int last = std::min(static_cast<int>(stars.size()), faintest + faintest / 2 + 6);
  std::vector<int> taken;
  for (int i = 0; i < last; ++i) {
    if (stars[i].dot(sky_middle) < least) continue;
    const auto member = std::find(sky.members.begin(), sky.members.end(), i);
    if (member != sky.members.end()) {
      hit.seed.push_back({i, picture.members[member - sky.members.begin()]});
      continue;
    }
    const Eigen::Vector3d v = camera.camera_from_enu * stars[i];
    const double in_camera[3] = {v[0], v[1], v[2]};
    double x = 0.0, y = 0.0, distance = 0.0;
    if (!sim::project(lens, in_camera, x, y) || x < 0.0 || y < 0.0 || x > frame.width_px ||
        y > frame.height_px)
      continue;
    const double from = std::hypot(x - middle_x, y - middle_y);
    const double tolerance = limits.near_px * unit + limits.near_share * std::max(from, size_px);
    const int p = near.nearest(x, y, tolerance, distance);
    if (p < 0 || std::find(taken.begin(), taken.end(), p) != taken.end() ||
        std::find(picture.members.begin(), picture.members.end(), p) != picture.members.end()) {
      hit.count_missing(i <= faintest);
    } else {
      hit.count_seen(i <= faintest, density, tolerance);
      taken.push_back(p);
    }
  }
  if (taken.empty() && all.points.size() > limits.alone_points) return;
  if (hit.score > limits.least_score) found_hits.hits.push_back(std::move(hit));
}

}  // namespace

std::vector<AsterismMembers> fresh_sets(const std::vector<Eigen::Vector3d>& places, int first, int neighbours,
                                        std::vector<AsterismMembers>& before) {
  const std::vector<AsterismMembers> sets = neighbour_sets(places, first, neighbours);
  std::vector<AsterismMembers> fresh;
  std::set_difference(sets.begin(), sets.end(), before.begin(), before.end(), std::back_inserter(fresh));
  before.insert(before.end(), fresh.begin(), fresh.end());
  std::sort(before.begin(), before.end());
  return fresh;
}

FigureHits look_up_figures(const FigureSky& sky, const SkyCamera& assumed, std::size_t n,
                           const std::vector<AsterismMembers>& sets, const PointCells& near,
                           double near_count) {
  FigureHits hits;
  const sim::Lens<double> lens = true_lens(assumed);
  std::vector<Eigen::Vector3d> directions(n);
  std::vector<char> has(n);
  for (std::size_t i = 0; i < n; ++i) {
    double v[3];
    has[i] = sim::unproject(lens, sky.points[i].x_px, sky.points[i].y_px, v);
    if (has[i]) directions[i] = {v[0], v[1], v[2]};
  }
  const FigureLimits& limits = sky.limits;
  std::vector<const Asterism*> found;
  for (const AsterismMembers& set : sets) {
    if (!has[set[0]] || !has[set[1]] || !has[set[2]] || !has[set[3]]) continue;
    Asterism one;
    if (!make_asterism(directions, set, one)) continue;
    for (const Asterism& order : orders_of(one, limits.code_tolerance)) {
      found.clear();
      sky.index.find(order, limits.code_tolerance, limits.size_factor, found);
      for (const Asterism* figure : found) try_figure(sky, assumed, order, *figure, near, near_count, hits);
    }
  }
  return hits;
}

std::vector<CameraHit> best_hits(std::vector<FigureHits> all, std::size_t most, double& tried) {
  std::vector<CameraHit> hits;
  for (FigureHits& one : all) {
    tried += one.tried;
    for (CameraHit& hit : one.hits) hits.push_back(std::move(hit));
  }
  std::stable_sort(hits.begin(), hits.end(),
                   [](const CameraHit& a, const CameraHit& b) { return a.score > b.score; });
  if (hits.size() > most) hits.resize(most);
  return hits;
}

bool grow_until_certain(const std::vector<CameraHit>& hits,
                        const std::function<GrownCamera(const CameraHit&)>& grown_of, bool& has_best,
                        GrownCamera& best) {
  constexpr std::size_t kTogether = 4;
  // A few at a time, and the first one that is certain counts: the same for any number of threads.
  for (std::size_t begin = 0; begin < hits.size(); begin += kTogether) {
    std::vector<GrownCamera> grown(std::min(kTogether, hits.size() - begin));
    sim::parallel_for(grown.size(), 0, [&](std::size_t i, int) { grown[i] = grown_of(hits[begin + i]); });
    for (const GrownCamera& one : grown) {
      if (!has_best || one.agreement.log10_false < best.agreement.log10_false) best = one;
      has_best = true;
      if (is_certain(best)) return true;
    }
  }
  return false;
}

}  // namespace vegard::fit
