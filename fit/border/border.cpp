#include "fit/border/border.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "fit/border/border_distance.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/scene/table/value_check.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr double kMadToSigma = 1.4826;        // of a Gaussian
constexpr double kBorderSmoothingDeg = 0.25;  // along elevation, at least a cell
constexpr double kWidestHoleDeg = 1.0;        // a star's mask, a hot pixel: bridged
constexpr double kFarthestFootDeg = 40.0;     // below the peak
constexpr std::size_t kMaxTraces = 20;
constexpr double kEdge_rows = 3.0;    // what smoothing makes of a sharp edge, from 75 to 25 %
constexpr double kGroundLight = 0.5;  // of the dark part of the sky

/// Sums of the light around one place of the picture.
struct BorderSample {
  double light = 0.0, weight = 0.0;
  int asked = 0, outside = 0;
};

void take_border_sample(const Photo& photo, int channel, const sim::CameraView<double>& view,
                        const sim::Direction& direction, BorderSample& sample) {
  double enu[3], x = 0.0, y = 0.0;
  sim::enu_of_direction(direction, enu);
  ++sample.asked;
  if (!sim::pixel_of_enu(view, enu, x, y) || !(x >= 0.0 && y >= 0.0) || x >= photo.linear.width ||
      y >= photo.linear.height) {
    ++sample.outside;
    return;
  }
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  for (int i = 0; i < 4; ++i) {
    const int column = std::clamp(static_cast<int>(left) + i % 2, 0, photo.linear.width - 1);
    const int row = std::clamp(static_cast<int>(top) + i / 2, 0, photo.linear.height - 1);
    const std::size_t at = photo.linear.index(column, row, channel);
    const double in_x = x - 0.5 - left, in_y = y - 0.5 - top;
    const double weight = (i % 2 == 1 ? in_x : 1.0 - in_x) * (i / 2 == 1 ? in_y : 1.0 - in_y);
    if (photo.usable[at] == 0) continue;
    sample.light += weight * photo.linear.data[at];
    sample.weight += weight;
  }
}

/// Fills small holes of each column by straight lines.
void bridge_border_holes(SkyCells& cells) {
  const int widest = static_cast<int>(kWidestHoleDeg / cells.elevation_step_deg);
  for (int c = 0; c < cells.columns; ++c) {
    int last = -1;
    for (int r = 0; r < cells.rows; ++r) {
      if (!std::isfinite(cells.light[cells.index(c, r)])) continue;
      if (last >= 0 && r - last > 1 && r - last - 1 <= widest) {
        const double from = cells.light[cells.index(c, last)], to = cells.light[cells.index(c, r)];
        for (int k = last + 1; k < r; ++k) {
          cells.light[cells.index(c, k)] = from + (to - from) * (k - last) / (r - last);
          cells.limit[cells.index(c, k)] = BorderLimit::none;
        }
      }
      last = r;
    }
  }
}

/// Returns the light less its smooth lower envelope: a cubic in elevation, each power with the first harmonic
/// of azimuth, fitted by asymmetric least squares (Newey and Powell 1987, Econometrica 55, 819), which light
/// above hardly lifts.
std::vector<double> without_border_sky(const SkyCells& cells) {
  constexpr int kTerms = 12;
  constexpr double kAbove = 0.03;  // weight of what stands above, what stands below having 1
  std::vector<double> out = cells.light;
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (std::isfinite(out[i])) used.push_back(i);
  const double area = static_cast<double>(used.size());
  if (area < 4 * kTerms) return out;
  const auto basis = [&](std::size_t i) {
    const int column = static_cast<int>(i / cells.rows), row = static_cast<int>(i % cells.rows);
    const double t = 2.0 * (row + 0.5) / cells.rows - 1.0;
    const double azimuth = cells.azimuth_deg(column) * sim::kRadiansPerDegree;
    Eigen::Matrix<double, kTerms, 1> v;
    const double power[4] = {1.0, t, t * t, t * t * t};
    for (int k = 0; k < 4; ++k) {
      v[3 * k] = power[k];
      v[3 * k + 1] = power[k] * std::cos(azimuth);
      v[3 * k + 2] = power[k] * std::sin(azimuth);
    }
    return v;
  };
  Eigen::Matrix<double, kTerms, 1> best = Eigen::Matrix<double, kTerms, 1>::Zero();
  for (int round = 0; round < 12; ++round) {
    Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Zero();
    Eigen::Matrix<double, kTerms, 1> right = Eigen::Matrix<double, kTerms, 1>::Zero();
    for (const std::size_t i : used) {
      const auto v = basis(i);
      const double weight = round == 0 || cells.light[i] <= v.dot(best) ? 1.0 : kAbove;
      normal.noalias() += weight * v * v.transpose();
      right += weight * cells.light[i] * v;
    }
    // Narrow pictures do not distinguish the harmonics: a small ridge term holds them.
    normal.diagonal().array() += 1e-6 * area;
    best = normal.ldlt().solve(right);
  }
  for (const std::size_t i : used) out[i] -= basis(i).dot(best);
  return out;
}

/// Returns the light smoothed over the usable cells: by a Gaussian along elevation, by (1 2 1) / 4 across
/// azimuth.
std::vector<double> smoothed_border_light(const SkyCells& cells, const std::vector<double>& light) {
  const double sigma = std::max(1.0, kBorderSmoothingDeg / cells.elevation_step_deg);
  const int reach = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<double> out(light.size(), sim::kNaN);
  for (int c = 0; c < cells.columns; ++c)
    for (int r = 0; r < cells.rows; ++r) {
      if (!std::isfinite(light[cells.index(c, r)])) continue;
      double sum = 0.0, weights = 0.0;
      for (int dc = -1; dc <= 1; ++dc)
        for (int dr = -reach; dr <= reach; ++dr) {
          if (r + dr < 0 || r + dr >= cells.rows) continue;
          const double v = light[cells.index((c + dc + cells.columns) % cells.columns, r + dr)];
          if (!std::isfinite(v)) continue;
          const double w = (dc == 0 ? 2.0 : 1.0) * std::exp(-0.5 * dr * dr / (sigma * sigma));
          sum += w * v;
          weights += w;
        }
      out[cells.index(c, r)] = sum / weights;
    }
  return out;
}

/// The noise of the smoothed cells as a function of the picture's brightness there, measured in the picture.
struct BorderNoise {
  std::vector<double> brightness, sigma;

  double at(double value) const {
    const auto above = std::upper_bound(brightness.begin(), brightness.end(), value);
    if (above == brightness.begin()) return sigma.front();
    return sigma[static_cast<std::size_t>(above - brightness.begin()) - 1];
  }
};

/// Measures the noise by second differences of single cells at each brightness, scaled by what smoothing
/// leaves of them over its own reach in the darker half of the picture: there, structure does not pass for
/// noise, and the correlation of neighbouring pixels (interpolation, compression) counts in full.
BorderNoise border_noise(const SkyCells& cells, const std::vector<double>& smooth) {
  constexpr std::size_t kBins = 12, kMin = 40;
  std::vector<std::pair<double, double>> rough;  // brightness, |second difference|
  const int lag =
      static_cast<int>(std::ceil(3.0 * std::max(1.0, kBorderSmoothingDeg / cells.elevation_step_deg)));
  for (int c = 0; c < cells.columns; ++c)
    for (int r = 1; r + 1 < cells.rows; ++r) {
      const double below = cells.light[cells.index(c, r - 1)], v = cells.light[cells.index(c, r)],
                   above = cells.light[cells.index(c, r + 1)];
      if (std::isfinite(below + v + above)) rough.emplace_back(v, std::abs(v - 0.5 * (below + above)));
    }
  BorderNoise noise;
  if (rough.size() < kMin) return noise;
  std::sort(rough.begin(), rough.end());
  const std::size_t bins = std::clamp<std::size_t>(rough.size() / kMin, 1, kBins);
  const auto brightness = [&](double share) {
    return rough[static_cast<std::size_t>(share * static_cast<double>(rough.size() - 1))].first;
  };
  // A made picture may have no noise at all, but eight bits have rounded it.
  const double rounding = 1e-4 * (brightness(0.995) - brightness(0.2));
  double least = rounding;
  for (std::size_t b = 0; b < bins; ++b) {
    std::vector<double> d;
    for (std::size_t i = b * rough.size() / bins; i < (b + 1) * rough.size() / bins; ++i)
      d.push_back(rough[i].second);
    noise.brightness.push_back(rough[b * rough.size() / bins].first);
    // Brighter pixels are no less noisy: a bin of equal codes is one that the file has rounded.
    least = std::max(least, kMadToSigma * sim::quantile(d, 0.5) / std::sqrt(1.5));
    noise.sigma.push_back(least);
  }
  const double dark = rough[rough.size() / 2].first;
  std::vector<double> ratio;
  for (int c = 0; c < cells.columns; ++c)
    for (int r = lag; r + lag < cells.rows; ++r) {
      const std::size_t i = cells.index(c, r);
      const double d = smooth[i] - 0.5 * (smooth[i - lag] + smooth[i + lag]);
      if (!std::isfinite(d) || cells.light[i] > dark) continue;
      if (const double sigma = noise.at(cells.light[i]); sigma > rounding)
        ratio.push_back(std::abs(d) / sigma);
    }
  // Smoothing reduces no noise by more than it reduces white noise.
  const double rows = std::max(1.0, kBorderSmoothingDeg / cells.elevation_step_deg);
  double scale = std::sqrt(6.0 / 16.0 / (2.0 * std::sqrt(sim::kPi) * rows));
  if (!ratio.empty()) scale = std::max(scale, kMadToSigma * sim::quantile(ratio, 0.5) / std::sqrt(1.5));
  for (double& s : noise.sigma) s = std::max(s * scale, 1e-9);
  return noise;
}

/// A peak of a column with its border, or why there is none.
struct BorderCandidate {
  BorderPoint point;
  double linked_deg = 0.0;  ///< what is linked: the border, or the end of the picture above it
  bool used = false;
};

/// What the search in a column needs.
struct BorderLight {
  const SkyCells& cells;
  std::vector<double> whole;   ///< smoothed
  std::vector<double> smooth;  ///< the same without the sky
  BorderNoise noise;
  std::vector<double> floor;  ///< of each column: what is dark there
  double least = 0.0;         ///< of a peak above its foot, anywhere
  double dark_sky = 0.0;      ///< less light than this is no sky's

  double at(int column, int row) const { return smooth[cells.index(column, row)]; }
};

/// Marks a point as one without a border, for this reason.
void hide_border(BorderPoint& point, BorderLimit limit) {
  point.limit = limit;
  point.elevation_deg = point.elevation_error_deg = point.fall_deg = sim::kNaN;
}

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
  p.elevation_deg = found.linked_deg = cells.elevation_deg(half);
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
  p.elevation_error_deg = std::hypot(by_noise, by_level) * cells.elevation_step_deg;
  p.brightness = top - base;
  p.signal = p.brightness / sigma;
  return true;
}

/// Finds the candidates in the usable rows low to high of a column.
void search_border_rows(const BorderLight& light, const BorderSettings& settings, int column, int low,
                        int high, std::vector<BorderCandidate>& found) {
  const SkyCells& cells = light.cells;
  const int farthest = static_cast<int>(kFarthestFootDeg / cells.elevation_step_deg);
  for (int peak = low + 1; peak < high; ++peak) {
    const double top = light.at(column, peak);
    if (!(top >= light.at(column, peak - 1) && top > light.at(column, peak + 1))) continue;
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
    if (top - valley < std::max(4.0 * sigma, 0.15 * amplitude)) continue;
    // A peak that exists only because the envelope was subtracted is none.
    const auto whole = [&](int row) { return light.whole[cells.index(column, row)]; };
    double dark = whole(peak);
    for (int r = peak + 1; r <= high; ++r) dark = std::min(dark, whole(r));
    if (whole(peak) - dark < 0.3 * (top - valley)) continue;
    BorderCandidate candidate;
    const double before = light.at(column, peak - 1), after = light.at(column, peak + 1);
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

std::vector<BorderTrace> link_border(std::vector<std::vector<BorderCandidate>>& all,
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

std::string no_border_note(const BorderTrace& trace) {
  int count[5] = {};
  for (const BorderPoint& p : trace.points) ++count[static_cast<int>(p.limit)];
  const int most = static_cast<int>(std::max_element(count + 1, count + 5) - count);
  return fmt::format(
      "Light at azimuths {:.0f} to {:.0f}° has its lower border beyond {}: not measured there.",
      trace.points.front().azimuth_deg, trace.points.back().azimuth_deg,
      border_limit_name(static_cast<BorderLimit>(most)));
}

}  // namespace

const char* border_limit_name(BorderLimit limit) {
  static constexpr std::array names = {"", "the horizon", "the frame", "the mask or clipped light",
                                       "something dark before the sky"};
  return names[static_cast<std::size_t>(limit)];
}

double BorderTrace::mean_brightness() const {
  double sum = 0.0;
  for (const BorderPoint& p : points) sum += p.brightness;
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

SkyCells sky_cells(const Photo& photo, const sim::Camera& camera, const BorderSettings& settings) {
  SkyCells cells;
  const double scale = sim::pixels_per_degree(camera);
  cells.columns = static_cast<int>(std::lround(360.0 / settings.azimuth_step_deg));
  cells.azimuth_step_deg = 360.0 / cells.columns;
  cells.lowest_deg = settings.lowest_elevation_deg;
  const double span = settings.highest_elevation_deg - settings.lowest_elevation_deg;
  cells.rows = static_cast<int>(std::ceil(span / std::clamp(1.0 / scale, 0.08, 1.0)));
  cells.elevation_step_deg = span / cells.rows;
  const std::size_t size = static_cast<std::size_t>(cells.columns) * cells.rows;
  cells.light.assign(size, sim::kNaN);
  cells.limit.assign(size, BorderLimit::none);
  const sim::CameraView<double> view = sim::camera_view(camera);
  const int up = std::clamp(static_cast<int>(std::lround(cells.elevation_step_deg * scale)), 1, 6);
  for (int r = 0; r < cells.rows; ++r) {
    const double level = std::cos(cells.elevation_deg(r) * sim::kRadiansPerDegree);
    const int across = std::clamp(static_cast<int>(std::ceil(cells.azimuth_step_deg * level * scale)), 1, 16);
    for (int c = 0; c < cells.columns; ++c) {
      BorderSample sample;
      for (int i = 0; i < across * up; ++i) {
        const double aside = (i % across + 0.5) / across - 0.5, above = (i / across + 0.5) / up - 0.5;
        take_border_sample(
            photo, settings.channel, view,
            {cells.azimuth_deg(c) + aside * cells.azimuth_step_deg, cells.elevation_deg(r + above)}, sample);
      }
      const std::size_t at = cells.index(c, r);
      if (sample.weight >= 0.5 * sample.asked)
        cells.light[at] = sample.light / sample.weight;
      else
        cells.limit[at] = 2 * sample.outside >= sample.asked ? BorderLimit::frame : BorderLimit::mask;
    }
  }
  return cells;
}

Border trace_border(const Photo& photo, const sim::Scene& scene, const BorderSettings& settings) {
  sim::require_earth(scene, "the distance of a border");
  if (photo.linear.width != scene.camera.width || photo.linear.height != scene.camera.height)
    throw sim::Error(sim::ErrorKind::scene,
                     "the camera is " + sim::size_text(scene.camera.width, scene.camera.height) +
                         " and the photograph " + sim::size_text(photo.linear.width, photo.linear.height))
        .key("camera.width")
        .expected("the same size")
        .hint("give the camera of this photograph, with --camera");
  if (1e-3 * scene.site.altitude_m >= kBorderAltitudesKm.front())
    throw sim::Error(sim::ErrorKind::scene, "the observer is as high as the aurora")
        .key("site.altitude_m")
        .expected("a site below 95 km")
        .hint("vegard profile measures pictures from orbit");
  Border border;
  border.cells = sky_cells(photo, scene.camera, settings);
  bridge_border_holes(border.cells);
  const SkyCells& cells = border.cells;
  const std::vector<double> light = without_border_sky(cells);
  BorderLight work{
      cells, smoothed_border_light(cells, cells.light), smoothed_border_light(cells, light), {}, {}, 0.0};
  work.noise = border_noise(cells, work.smooth);
  std::vector<double> all;
  for (const double v : work.smooth)
    if (std::isfinite(v)) all.push_back(v);
  if (work.noise.sigma.empty() || all.empty()) {
    border.notes.push_back(
        fmt::format("No usable part of the picture looks at elevations of {:.0f} to {:.0f}°.",
                    settings.lowest_elevation_deg, settings.highest_elevation_deg));
    return border;
  }
  work.least = 0.05 * (sim::quantile(all, 0.995) - sim::quantile(all, 0.2));
  std::vector<double> whole;
  for (const double v : work.whole)
    if (std::isfinite(v)) whole.push_back(v);
  work.dark_sky = kGroundLight * sim::quantile(whole, 0.25);
  const int aside = static_cast<int>(15.0 / cells.azimuth_step_deg);
  for (int c = 0; c < cells.columns; ++c) {
    std::vector<double> near;
    for (int k = c - aside; k <= c + aside; ++k)
      for (int r = 0; r < cells.rows; ++r) {
        const double v = work.at((k + cells.columns) % cells.columns, r);
        if (std::isfinite(v)) near.push_back(v);
      }
    work.floor.push_back(sim::quantile(near, 0.1));
  }
  std::vector<std::vector<BorderCandidate>> candidates = border_candidates(work, settings);
  border.traces = link_border(candidates, settings);
  const auto is_measured = [&](const BorderTrace& trace) {
    return trace.measured * cells.azimuth_step_deg >= settings.min_length_deg;
  };
  std::stable_sort(border.traces.begin(), border.traces.end(),
                   [&](const BorderTrace& a, const BorderTrace& b) {
                     if (is_measured(a) != is_measured(b)) return is_measured(a);
                     return a.mean_brightness() * static_cast<double>(a.points.size()) >
                            b.mean_brightness() * static_cast<double>(b.points.size());
                   });
  if (border.traces.size() > kMaxTraces) border.traces.resize(kMaxTraces);
  for (const BorderTrace& trace : border.traces)
    if (is_measured(trace))
      ++border.measured;
    else
      border.notes.push_back(no_border_note(trace));
  if (border.traces.empty())
    border.notes.push_back(
        fmt::format("No light with an edge is brighter than sky and noise over {:.0f}° of azimuth.",
                    settings.min_length_deg));
  border.notes.push_back(fmt::format(
      "Searched were elevations of {:.0f} to {:.0f}°: higher up an arc is seen from below, and has no "
      "lower edge.",
      settings.lowest_elevation_deg, settings.highest_elevation_deg));
  return border;
}

}  // namespace vegard::fit
