#include "fit/border/border_links.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace vegard::fit {
namespace {

using BorderPlaceInColumn = std::pair<int, std::size_t>;

/// Follows the border from a candidate to one side, column by column, along a straight line through the last
/// few places.
std::vector<BorderPlaceInColumn> follow_border(const std::vector<std::vector<BorderCandidate>>& all,
                                               const BorderSettings& settings, BorderPlaceInColumn from,
                                               int side, int most) {
  const int columns = static_cast<int>(all.size());
  const int widest = std::max(1, static_cast<int>(settings.longest_gap_deg / settings.azimuth_step_deg));
  std::vector<BorderPlaceInColumn> linked;
  const BorderCandidate* last = &all[static_cast<std::size_t>(from.first)][from.second];
  double slope = 0.0, brightness = last->point.brightness;
  int gap = 1;
  for (int step = 1; step <= most && gap <= widest; ++step) {
    const int column = ((from.first + side * step) % columns + columns) % columns;
    const auto& here = all[static_cast<std::size_t>(column)];
    double nearest = settings.max_jump_deg * std::sqrt(static_cast<double>(gap));
    int chosen = -1;
    for (std::size_t i = 0; i < here.size(); ++i) {
      const double ratio = here[i].point.brightness / brightness;
      const double off = std::abs(here[i].linked_deg - last->linked_deg - slope * gap);
      if (here[i].used || ratio > 4.0 || ratio < 0.25 || off > nearest) continue;
      nearest = off;
      chosen = static_cast<int>(i);
    }
    if (chosen < 0) {
      ++gap;
      continue;
    }
    const BorderCandidate& next = here[static_cast<std::size_t>(chosen)];
    slope = 0.7 * slope + 0.3 * (next.linked_deg - last->linked_deg) / gap;
    brightness = 0.7 * brightness + 0.3 * next.point.brightness;
    last = &next;
    gap = 1;
    linked.emplace_back(column, static_cast<std::size_t>(chosen));
  }
  return linked;
}

/// Widens error bars by the neighbours' scatter about a straight line.
void add_border_scatter(BorderTrace& trace, double step_deg) {
  constexpr int kNeighbours = 3;
  const std::vector<BorderPoint> points = trace.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].measured()) continue;
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, syy = 0.0;
    for (std::size_t k = i >= kNeighbours ? i - kNeighbours : 0;
         k <= std::min(points.size() - 1, i + kNeighbours); ++k) {
      if (!points[k].measured()) continue;
      const double x = std::remainder(points[k].azimuth_deg - points[i].azimuth_deg, 360.0) / step_deg;
      const double y = points[k].elevation_deg - points[i].elevation_deg;
      n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
    }
    if (n < 4.0) continue;
    const double xx = sxx - sx * sx / n, xy = sxy - sx * sy / n, yy = syy - sy * sy / n;
    const double scatter = std::sqrt(std::max(0.0, (yy - xy * xy / xx) / (n - 2.0)));
    trace.points[i].elevation_error_deg = std::hypot(points[i].elevation_error_deg, scatter);
  }
}

/// Hides all of a border that is the edge of a roof in many places, also where a lamp or a star brightens it.
void hide_edge_of_ground(BorderTrace& trace) {
  std::size_t edges = 0;
  for (const BorderPoint& p : trace.points) edges += p.limit == BorderLimit::ground ? 1 : 0;
  if (3 * edges < trace.points.size()) return;
  for (BorderPoint& p : trace.points)
    if (p.measured()) hide_border(p, BorderLimit::ground);
}

}  // namespace

std::vector<BorderTrace> linked_borders(std::vector<std::vector<BorderCandidate>>& all,
                                        const BorderSettings& settings) {
  const int columns = static_cast<int>(all.size());
  std::vector<BorderPlaceInColumn> seeds;
  for (int c = 0; c < columns; ++c)
    for (std::size_t i = 0; i < all[static_cast<std::size_t>(c)].size(); ++i) seeds.emplace_back(c, i);
  const auto candidate = [&](const BorderPlaceInColumn& at) -> BorderCandidate& {
    return all[static_cast<std::size_t>(at.first)][at.second];
  };
  std::stable_sort(seeds.begin(), seeds.end(),
                   [&](const BorderPlaceInColumn& a, const BorderPlaceInColumn& b) {
                     return candidate(a).point.signal > candidate(b).point.signal;
                   });
  std::vector<BorderTrace> traces;
  const double least = settings.min_length_deg / settings.azimuth_step_deg;
  for (const BorderPlaceInColumn& seed : seeds) {
    if (candidate(seed).used) continue;
    candidate(seed).used = true;
    const std::vector<BorderPlaceInColumn> right = follow_border(all, settings, seed, 1, columns - 1);
    const int turned = right.empty() ? 0 : ((right.back().first - seed.first) % columns + columns) % columns;
    const std::vector<BorderPlaceInColumn> left =
        follow_border(all, settings, seed, -1, columns - 1 - turned);
    std::vector<BorderPlaceInColumn> linked(left.rbegin(), left.rend());
    linked.push_back(seed);
    linked.insert(linked.end(), right.begin(), right.end());
    const int span = ((linked.back().first - linked.front().first) % columns + columns) % columns + 1;
    if (span < least || linked.size() < 0.6 * span) continue;
    BorderTrace trace;
    for (const BorderPlaceInColumn& at : linked) {
      candidate(at).used = true;
      trace.points.push_back(candidate(at).point);
    }
    hide_edge_of_ground(trace);
    for (const BorderPoint& p : trace.points) trace.measured += p.measured() ? 1 : 0;
    add_border_scatter(trace, settings.azimuth_step_deg);
    traces.push_back(std::move(trace));
  }
  return traces;
}

}  // namespace vegard::fit
