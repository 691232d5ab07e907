#include "fit/triangulation/matched_curves.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kLongestStep = 3.0;  ///< of a branch along the second curve, in its points
constexpr double kLeastCrossing_deg = 2.0;
constexpr double kLeastBranch = 0.01;  ///< weight of a branch that is told

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
  // A point beyond chance costs as much as one without a match and a little: it may be a fault of the trace.
  for (const TriangulatedPoint* point : points)
    sum += std::min(5.0, std::pow(point->place.height_km - mean_km, 2) /
                             (std::pow(point->height_error_km, 2) + std::pow(kHeightsAlongBorder_km, 2)));
  return sum;
}

/// ChainNumbers of one border: the numbers of chains that share no vertex.
using ChainNumbers = std::vector<std::size_t>;

/// Neighbouring points err together: a curve has as many independent pieces as it has tens of points.
double sharpness_of(std::size_t vertices) {
  return std::max(1.0, static_cast<double>(vertices) / 10.0) / static_cast<double>(vertices);
}

double median_error_km(const std::vector<const TriangulatedPoint*>& points) {
  std::vector<double> errors;
  for (const TriangulatedPoint* point : points) errors.push_back(point->height_error_km);
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

/// Joins chains that share no vertex while that makes all of them together more probable, from each chain on.
/// Returns sorted pieces without repetition.
std::vector<ChainNumbers> joined_chains(const std::vector<std::vector<const CurveMatch*>>& chains,
                                        const std::vector<ViewPoint>& cameras, std::size_t vertices,
                                        double drift_km_s) {
  const auto points_of = [&](const ChainNumbers& pieces) {
    std::vector<const TriangulatedPoint*> points;
    for (const std::size_t chain : pieces)
      for (const CurveMatch* match : chains[chain]) points.push_back(&match->point);
    return points;
  };
  const auto badness_of = [&](const ChainNumbers& pieces) {
    const auto points = points_of(pieces);
    return badness(points, mean_height(cameras, points, drift_km_s).km, vertices);
  };
  const auto is_apart = [&](std::size_t chain, const ChainNumbers& pieces) {
    for (const std::size_t other : pieces)
      for (const CurveMatch* a : chains[chain])
        for (const CurveMatch* b : chains[other])
          if (a->vertex == b->vertex) return false;
    return true;
  };
  std::vector<ChainNumbers> all;
  for (std::size_t seed = 0; seed < chains.size(); ++seed) {
    ChainNumbers pieces = {seed};
    double bad = badness_of(pieces);
    for (;;) {
      std::size_t best = chains.size();
      for (std::size_t chain = 0; chain < chains.size(); ++chain) {
        if (!is_apart(chain, pieces)) continue;
        ChainNumbers more = pieces;
        more.push_back(chain);
        const double with = badness_of(more);
        if (with >= bad) continue;
        bad = with;
        best = chain;
      }
      if (best == chains.size()) break;
      pieces.push_back(best);
    }
    std::sort(pieces.begin(), pieces.end());
    if (std::find(all.begin(), all.end(), pieces) == all.end()) all.push_back(pieces);
  }
  return all;
}

/// Makes branches of the chains, sorts them, and numbers the matches anew. A chain of several branches is
/// repeated.
void weigh_branches(MatchedCurves& found, const std::vector<ViewPoint>& cameras, std::size_t count,
                    std::size_t vertices, double drift_km_s) {
  const std::vector<CurveMatch> matches = std::move(found.matches);
  found.matches.clear();
  std::vector<std::vector<const CurveMatch*>> chains(count);
  for (const CurveMatch& match : matches) chains[match.branch].push_back(&match);
  const std::vector<ChainNumbers> all = joined_chains(chains, cameras, vertices, drift_km_s);
  std::vector<CurveBranch> branches(all.size());
  const double sharpness = sharpness_of(vertices);
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t b = 0; b < all.size(); ++b) {
    std::vector<const TriangulatedPoint*> points;
    for (const std::size_t chain : all[b])
      for (const CurveMatch* match : chains[chain]) points.push_back(&match->point);
    branches[b].mean = mean_height(cameras, points, drift_km_s);
    branches[b].share = static_cast<double>(points.size()) / static_cast<double>(vertices);
    branches[b].median_error_km = median_error_km(points);
    branches[b].badness = sharpness * badness(points, branches[b].mean.km, vertices);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return branches[a].badness < branches[b].badness; });
  const double least = std::min(found.no_match_badness, branches[order.front()].badness);
  double sum = std::exp(-0.5 * (found.no_match_badness - least));
  for (const CurveBranch& branch : branches) sum += std::exp(-0.5 * (branch.badness - least));
  for (std::size_t i = 0; i < order.size(); ++i) {
    CurveBranch branch = branches[order[i]];
    branch.weight = std::exp(-0.5 * (branch.badness - least)) / sum;
    // Ways along the curve that give the same height are one match.
    const auto same =
        std::find_if(found.branches.begin(), found.branches.end(), [&](const CurveBranch& other) {
          return std::abs(other.mean.km - branch.mean.km) <
                 std::min(other.mean.error_km, branch.mean.error_km);
        });
    if (same != found.branches.end()) {
      same->weight += branch.weight;
      continue;
    }
    if (i > 0 && branch.weight < kLeastBranch) continue;
    for (const std::size_t chain : all[order[i]])
      for (const CurveMatch* match : chains[chain]) {
        found.matches.push_back(*match);
        found.matches.back().branch = found.branches.size();
      }
    found.branches.push_back(branch);
  }
  std::stable_sort(found.matches.begin(), found.matches.end(), [](const CurveMatch& a, const CurveMatch& b) {
    return a.vertex != b.vertex ? a.vertex < b.vertex : a.branch < b.branch;
  });
}

}  // namespace

std::vector<std::string> doubts_about(const CurveBranch& branch, double weight) {
  constexpr int kFewestMatched = 3;
  constexpr double kLeastShare = 0.3, kMostScatter = 2.0;
  std::vector<std::string> doubts;
  if (!(weight >= kClearMatch))
    doubts.push_back(
        fmt::format("another match, or none, is possible: this one has a weight of {:.2f}", weight));
  if (branch.mean.points < kFewestMatched)
    doubts.push_back(fmt::format("the match has fewer than {} points", kFewestMatched));
  if (!(branch.share >= kLeastShare))
    doubts.push_back(fmt::format("only {:.0f} % of the curve have a match", 100.0 * branch.share));
  if (!(branch.mean.scatter_km <= kMostScatter * std::hypot(branch.median_error_km, kHeightsAlongBorder_km)))
    doubts.push_back(
        fmt::format("the heights scatter by {:.0f} km, beyond their errors", branch.mean.scatter_km));
  return doubts;
}

MatchedCurves matched_curves(const std::vector<ViewPoint>& cameras, const PictureCurve& first,
                             const PictureCurve& second, const HeightRange& range, double drift_km_s) {
  MatchedCurves found;
  found.no_match_badness = sharpness_of(first.points.size()) * badness({}, 0.0, first.points.size());
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
  if (found.matches.empty()) return found;
  const std::size_t count = set_branches(found.matches);
  weigh_branches(found, cameras, count, first.points.size(), drift_km_s);
  return found;
}

}  // namespace vegard::fit
