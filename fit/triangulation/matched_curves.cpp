#include "fit/triangulation/matched_curves.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

/// By how much heights differ along a border, beside their errors (ESTIMATED: lower borders vary by some
/// kilometres along an arc, Störmer 1955, "The polar aurora").
constexpr double kHeightsAlongBorder_km = 5.0;
constexpr double kLongestStep = 3.0;  ///< of a branch along the second curve, in its points
constexpr double kLeastCrossing_deg = 2.0;

PixelPoint between(const PictureCurve& curve, double along) {
  const std::size_t last = curve.points.size() - 2;
  const std::size_t i = std::min(last, static_cast<std::size_t>(std::max(0.0, along)));
  const double part = along - static_cast<double>(i);
  const PixelPoint &a = curve.points[i], &b = curve.points[i + 1];
  return {a.x_px + part * (b.x_px - a.x_px), a.y_px + part * (b.y_px - a.y_px)};
}

Eigen::Vector2d course(const PictureCurve& curve, std::size_t from, std::size_t to) {
  return {curve.points[to].x_px - curve.points[from].x_px, curve.points[to].y_px - curve.points[from].y_px};
}

/// Where the second curve crosses a plane through its camera.
class Crossings {
 public:
  Crossings(const ViewPoint& view, const PictureCurve& curve) : view_(view), curve_(curve) {
    for (const PixelPoint& point : curve.points) directions_.push_back(view.direction(point));
  }

  std::vector<double> with(const Eigen::Vector3d& normal) const {
    std::vector<double> found;
    for (std::size_t i = 0; i + 1 < directions_.size(); ++i) {
      if (!directions_[i] || !directions_[i + 1]) continue;
      const double here = normal.dot(*directions_[i]), there = normal.dot(*directions_[i + 1]);
      if ((here < 0.0) == (there < 0.0)) continue;
      if (const std::optional<double> part = root(normal, i, here))
        found.push_back(static_cast<double>(i) + *part);
    }
    return found;
  }

  const std::optional<Eigen::Vector3d>& direction(std::size_t i) const { return directions_[i]; }

 private:
  std::optional<double> root(const Eigen::Vector3d& normal, std::size_t i, double at_begin) const {
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      const auto direction = view_.direction(between(curve_, static_cast<double>(i) + middle));
      if (!direction) return std::nullopt;
      ((normal.dot(*direction) < 0.0) == (at_begin < 0.0) ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  const ViewPoint& view_;
  const PictureCurve& curve_;
  std::vector<std::optional<Eigen::Vector3d>> directions_;
};

/// Numbers the branches: a match continues the nearest one, along the second curve, of the vertex before.
std::size_t set_branches(std::vector<CurveMatch>& matches) {
  struct End {
    std::size_t vertex, branch;
    double along, height_km;
  };
  std::vector<End> ends;
  std::size_t branches = 0;
  for (CurveMatch& match : matches) {
    End* best = nullptr;
    double nearest = kLongestStep;
    for (End& end : ends) {
      if (end.vertex == match.vertex || end.vertex + 2 < match.vertex) continue;
      const double step = std::abs(end.along - match.along) / static_cast<double>(match.vertex - end.vertex);
      if (step > nearest) continue;
      nearest = step;
      best = &end;
    }
    if (!best) {
      ends.push_back({0, branches++, 0.0, 0.0});
      best = &ends.back();
    }
    best->vertex = match.vertex;
    best->along = match.along;
    match.branch = best->branch;
  }
  return branches;
}

/// Minus twice the logarithm of the probability of a branch's heights about their mean, and of the first
/// curve's points without a match: each costs as much as a height off by two standard deviations.
double badness(const std::vector<const TriangulatedPoint*>& points, double mean_km, std::size_t vertices) {
  double sum = 4.0 * static_cast<double>(vertices - std::min(vertices, points.size()));
  for (const TriangulatedPoint* point : points)
    sum += std::pow(point->place.height_km - mean_km, 2) /
           (std::pow(point->height_error_km, 2) + std::pow(kHeightsAlongBorder_km, 2));
  return sum;
}

/// Sorts the branches and numbers the matches anew.
void weigh_branches(MatchedCurves& found, const std::vector<ViewPoint>& cameras, std::size_t count,
                    std::size_t vertices, double drift_km_s) {
  std::vector<std::pair<double, std::size_t>> order;
  std::vector<CurveBranch> branches(count);
  double least = HUGE_VAL;
  for (std::size_t b = 0; b < count; ++b) {
    std::vector<const TriangulatedPoint*> points;
    for (const CurveMatch& match : found.matches)
      if (match.branch == b) points.push_back(&match.point);
    branches[b].mean = mean_height(cameras, points, drift_km_s);
    branches[b].share = static_cast<double>(points.size()) / static_cast<double>(vertices);
    order.emplace_back(badness(points, branches[b].mean.km, vertices), b);
    least = std::min(least, order.back().first);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  // Neighbouring points err together: a curve has as many independent pieces as it has tens of points.
  const double pieces = std::max(1.0, static_cast<double>(vertices) / 10.0);
  const double sharpness = pieces / static_cast<double>(vertices);
  double sum = 0.0;
  for (const auto& [bad, b] : order) sum += std::exp(-0.5 * sharpness * (bad - least));
  std::vector<std::size_t> place(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [bad, b] = order[i];
    place[b] = i;
    found.branches.push_back(branches[b]);
    found.branches.back().weight = std::exp(-0.5 * sharpness * (bad - least)) / sum;
  }
  for (CurveMatch& match : found.matches) match.branch = place[match.branch];
  std::stable_sort(found.matches.begin(), found.matches.end(), [](const CurveMatch& a, const CurveMatch& b) {
    return a.vertex != b.vertex ? a.vertex < b.vertex : a.branch < b.branch;
  });
}

}  // namespace

MatchedCurves matched_curves(const std::vector<ViewPoint>& cameras, const PictureCurve& first,
                             const PictureCurve& second, const HeightRange& range, double drift_km_s) {
  MatchedCurves found;
  const ViewPoint &here = cameras[first.camera], &there = cameras[second.camera];
  const Eigen::Vector3d base = there.place_km() - here.place_km();
  const Crossings crossings(there, second);
  for (std::size_t v = 0; v < first.points.size(); ++v) {
    const auto direction = here.direction(first.points[v]);
    if (!direction) continue;
    const Eigen::Vector3d normal = base.cross(*direction);
    if (!(normal.norm() > 1e-9 * base.norm())) continue;
    for (const double along : crossings.with(normal.normalized())) {
      CurveMatch match;
      match.vertex = v;
      match.along = along;
      match.there = between(second, along);
      const auto segment = static_cast<std::size_t>(along);
      const auto &a = crossings.direction(segment), &b = crossings.direction(segment + 1);
      match.crossing_deg =
          std::asin(std::min(1.0, std::abs(normal.normalized().dot((*b - *a).normalized())))) /
          sim::kRadiansPerDegree;
      if (match.crossing_deg < kLeastCrossing_deg) {
        ++found.along_epipolar;
        continue;
      }
      Sight near, far;
      near.camera = first.camera;
      near.pixel = first.points[v];
      near.pixel_error_px = first.error_px[v];
      near.curve = course(first, v == 0 ? 0 : v - 1, std::min(v + 1, first.points.size() - 1));
      far.camera = second.camera;
      far.pixel = match.there;
      far.pixel_error_px = std::max(second.error_px[segment], second.error_px[segment + 1]);
      far.curve = course(second, segment, segment + 1);
      far.is_anywhere_on_curve = true;
      match.point = triangulated(cameras, {near, far}, drift_km_s);
      if (!match.point.is_given() || match.point.place.height_km < range.lowest_km ||
          match.point.place.height_km > range.highest_km)
        ++found.outside_range;
      else
        found.matches.push_back(match);
    }
  }
  const std::size_t count = set_branches(found.matches);
  weigh_branches(found, cameras, count, first.points.size(), drift_km_s);
  return found;
}

}  // namespace vegard::fit
