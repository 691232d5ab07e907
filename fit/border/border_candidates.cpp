#include "fit/border/border_candidates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kFarthestFootDeg = 40.0;  // below the peak
constexpr double kEdge_rows = 3.0;         // what smoothing makes of a sharp edge, from 75 to 25 %

/// Returns the row, with its fraction, where the light falls through a level below a peak; a row below `end`
/// if it does not.
double border_crossing(const BorderLight& light, int column, int peak, int end, double level) {
  for (int r = peak; r > end; --r) {
    const double above = light.at(column, r), below = light.at(column, r - 1);
    if (below <= level && above > level) return r - 1 + (level - below) / (above - below);
  }
  return end - 1.0;
}

double border_mean(const BorderLight& light, int column, int from, int to) {
  double sum = 0.0;
  for (int r = from; r <= to; ++r) sum += light.at(column, r);
  return sum / (to - from + 1);
}

/// The light above `base` below a peak, as it would be if all of it were dimmed by the air as much as the
/// peak is: what of a fall is the air's is taken off.
class UndimmedFall {
 public:
  UndimmedFall(const BorderLight& light, const std::vector<double>& depth, int column, int peak, int low,
               double base)
      : light_(light), depth_(depth), column_(column), peak_(peak), low_(low), base_(base) {}

  /// Returns the row, with its fraction, where the light has fallen to half of the highest place above it; a
  /// row below `low` if it does not.
  double half_row() const {
    double top = at(peak_);
    for (int r = peak_; r > low_; --r) {
      const double above = at(r), below = at(r - 1);
      top = std::max(top, above);
      if (below <= 0.5 * top && above > 0.5 * top) return r - 1 + (0.5 * top - below) / (above - below);
    }
    return low_ - 1.0;
  }

 private:
  double at(int row) const {
    return (light_.at(column_, row) - base_) *
           std::exp(depth_[static_cast<std::size_t>(row)] - depth_[static_cast<std::size_t>(peak_)]);
  }

  const BorderLight& light_;
  const std::vector<double>& depth_;
  int column_, peak_, low_;
  double base_;
};

/// Finds the border below a peak, in the usable rows from `low` on. Returns false if the peak is a glow
/// without a border.
bool find_border_below(const BorderLight& light, const BorderSettings& settings, int column, int peak,
                       int low, int foot, double sigma, BorderCandidate& found) {
  const SkyCells& cells = light.cells;
  const double top = light.at(column, peak);
  double base = border_mean(light, column, std::max(low, foot - 1), std::min(foot + 1, peak - 1));
  BorderPoint& p = found.point;
  const auto refuse = [&] {
    hide_border(p, low == 0 ? BorderLimit::horizon : cells.limit[cells.index(column, low - 1)]);
    found.linked_deg = cells.elevation_deg(low);
    return true;
  };
  if (foot - low <= 2) {
    // The light falls as far as the picture goes. The border is in it only if it has fallen to the sky.
    const double floor = std::min(light.floor[static_cast<std::size_t>(column)], base);
    if (base - floor > 0.3 * (top - floor)) return refuse();
  } else {
    // The sky just beneath counts, not that far below: where the fall has ended.
    for (int round = 0; round < 2; ++round) {
      const double half = border_crossing(light, column, peak, foot, base + 0.5 * (top - base));
      const double quarter = border_crossing(light, column, peak, foot, base + 0.25 * (top - base));
      const double fall = std::max({2.0 * (half - quarter), 2.0, 0.5 / cells.elevation_step_deg});
      const int to = static_cast<int>(std::floor(half - 2.0 * fall));
      const int from = std::max(low, static_cast<int>(to - std::max(fall, 2.0 / cells.elevation_step_deg)));
      if (to - from < 1 || to < foot) break;
      base = std::min(border_mean(light, column, from, to), base + 0.5 * (top - base));
    }
  }
  const auto crossing = [&](double share) {
    return border_crossing(light, column, peak, low, base + share * (top - base));
  };
  const double half = crossing(0.5), upper = crossing(0.6), lower = crossing(0.4);
  if (half < low + 1.0 || lower < low) return refuse();
  const double fall = crossing(0.75) - std::max(crossing(0.25), static_cast<double>(low));
  p.fall_deg = fall * cells.elevation_step_deg;
  if (p.fall_deg > settings.widest_fall_deg) return false;
  const double slope = 0.2 * (top - base) / std::max(upper - lower, 0.2);  // per row
  const double by_noise =
      std::sqrt(1.5) * sigma / slope;  // of the light there, the peak's and the foot's half
  const double by_level = 0.5 * (upper - lower);
  const auto undimmed = [&](const std::vector<double>& depth) {
    return UndimmedFall(light, depth, column, peak, low, base).half_row();
  };
  // Where the light ends by the air alone, there is no border.
  const double border = undimmed(light.air.usual);
  if (border < low) {
    hide_border(p, BorderLimit::horizon);
    found.linked_deg = cells.elevation_deg(half);
    return true;
  }
  const double by_air =
      std::max(undimmed(light.air.clear) - border, border - std::max<double>(low, undimmed(light.air.hazy)));
  p.elevation_deg = found.linked_deg = cells.elevation_deg(border);
  if (p.elevation_deg < settings.lowest_measured_deg) {
    hide_border(p, BorderLimit::horizon);
    return true;
  }
  // A roof or a tree that no mask leaves out: black, and the light ends at it within a pixel or two.
  const int beneath = std::max(low, static_cast<int>(half - 2.0 * std::max(fall, 1.0)));
  if (fall < kEdge_rows && light.whole[cells.index(column, beneath)] < light.dark_sky) {
    hide_border(p, BorderLimit::ground);
    return true;
  }
  // A peak beyond what is seen may be half as bright again.
  const double by_peak = found.is_cut ? 0.5 * (crossing(0.75) - half) : 0.0;
  p.elevation_error_deg =
      std::hypot(std::hypot(by_noise, by_level), by_air, by_peak) * cells.elevation_step_deg;
  p.brightness = top - base;
  p.signal = p.brightness / sigma;
  return true;
}

/// Finds the candidates in the usable rows low to high of a column.
void search_border_rows(const BorderLight& light, const BorderSettings& settings, int column, int low,
                        int high, std::vector<BorderCandidate>& found) {
  const SkyCells& cells = light.cells;
  const int farthest = static_cast<int>(kFarthestFootDeg / cells.elevation_step_deg);
  for (int peak = low + 1; peak <= high; ++peak) {
    const double top = light.at(column, peak);
    // Light that rises to where the picture ends, or is clipped, has its peak beyond.
    const bool is_cut = peak == high;
    if (is_cut && high + 1 == cells.rows) continue;
    if (!(top >= light.at(column, peak - 1) && (is_cut || top > light.at(column, peak + 1)))) continue;
    int foot = peak;
    for (int r = peak - 1; r >= std::max(low, peak - farthest) && light.at(column, r) <= top; --r)
      if (light.at(column, r) < light.at(column, foot)) foot = r;
    const double amplitude = top - light.at(column, foot);
    const double sigma = light.noise.at(cells.light[cells.index(column, peak)]);
    const double under = std::max(0.0, cells.light[cells.index(column, foot)]);
    if (amplitude < settings.min_signal * sigma || amplitude < settings.min_contrast * under ||
        amplitude < light.least)
      continue;
    double valley = top;
    for (int r = peak + 1; r <= high && light.at(column, r) <= top; ++r)
      valley = std::min(valley, light.at(column, r));
    if (!is_cut && top - valley < std::max(4.0 * sigma, 0.15 * amplitude)) continue;
    // A peak that exists only because the envelope was subtracted is none.
    const auto whole = [&](int row) { return light.whole[cells.index(column, row)]; };
    double dark = whole(peak);
    for (int r = peak + 1; r <= high; ++r) dark = std::min(dark, whole(r));
    if (whole(peak) - dark < 0.3 * (top - valley)) continue;
    BorderCandidate candidate;
    candidate.is_cut = is_cut;
    const double before = light.at(column, peak - 1), after = is_cut ? before : light.at(column, peak + 1);
    const double bend = before - 2.0 * top + after;
    candidate.point.azimuth_deg = cells.azimuth_deg(column);
    candidate.point.peak_elevation_deg =
        cells.elevation_deg(peak + (bend < 0.0 ? 0.5 * (before - after) / bend : 0.0));
    candidate.point.brightness = amplitude;
    candidate.point.signal = amplitude / sigma;
    if (!find_border_below(light, settings, column, peak, low, foot, sigma, candidate)) continue;
    if (candidate.point.measured() && whole(peak) - whole(foot) < 0.5 * amplitude) continue;
    // Two peaks over one border: the lower one's is it.
    if (!found.empty() && std::abs(found.back().linked_deg - candidate.linked_deg) < 0.5 &&
        found.back().point.limit == candidate.point.limit)
      continue;
    found.push_back(candidate);
  }
}

}  // namespace

void hide_border(BorderPoint& point, BorderLimit limit) {
  point.limit = limit;
  point.elevation_deg = point.elevation_error_deg = point.fall_deg = sim::kNaN;
}

std::vector<std::vector<BorderCandidate>> border_candidates(const BorderLight& light,
                                                            const BorderSettings& settings) {
  const SkyCells& cells = light.cells;
  std::vector<std::vector<BorderCandidate>> found(static_cast<std::size_t>(cells.columns));
  for (int c = 0; c < cells.columns; ++c)
    for (int low = 0; low < cells.rows;) {
      if (!std::isfinite(light.at(c, low))) {
        ++low;
        continue;
      }
      int high = low;
      while (high + 1 < cells.rows && std::isfinite(light.at(c, high + 1))) ++high;
      search_border_rows(light, settings, c, low, high, found[static_cast<std::size_t>(c)]);
      low = high + 1;
    }
  return found;
}

}  // namespace vegard::fit
