#include "fit/triangulation/shell_correlation.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "fit/triangulation/light_ranks.h"
#include "fit/triangulation/smooth_light.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kFewestPlaces = 150;
constexpr int kBlocks = 4;              ///< along each side of the shared sky, for errors by leaving out
constexpr double kLeastEvidence = 2.0;  ///< of the logarithm of the likelihood over that of no correlation
constexpr double kLeastWeight = 0.02;   ///< of a height that is told
constexpr double kLeastCorrelation = 0.5;
constexpr double kContrastReach_km = 30.0, kLeastContrast = 0.15;
constexpr double kPerturbedReach_km = 24.0;

/// A place of the shell that both pictures show.
struct Shown {
  int column, row;
  double light[2];
};

/// What counts in a pattern: all ranks alike, or the brightest more (ranks from 0 to 1, squared).
enum class Weighting { even, bright };

/// Ranks from -1 to 1 with a surface of second order taken off; of equal values the mean rank.
Eigen::VectorXd rank_pattern(const std::vector<Shown>& shown, int picture, const Eigen::MatrixXd& surface,
                             Weighting weighting) {
  std::vector<double> light;
  for (const Shown& one : shown) light.push_back(one.light[picture]);
  Eigen::VectorXd rank = ranks_of(light);
  if (weighting == Weighting::bright) rank = (0.5 * (rank.array() + 1.0)).square().matrix().eval();
  const Eigen::VectorXd fitted =
      surface * (surface.transpose() * surface).ldlt().solve(surface.transpose() * rank);
  return rank - fitted;
}

class Shells {
 public:
  Shells(const std::vector<const Photo*>& photos, const std::vector<ViewPoint>& cameras,
         const ShellSettings& settings)
      : settings_(settings) {
    const Eigen::Vector3d middle = 0.5 * (cameras[0].place_km() + cameras[1].place_km());
    axes_ = east_north_up(geodetic_place(cameras[0].shape(), middle));
    for (int i = 0; i < 2; ++i) {
      // A box as wide as the grid at 110 km above the camera.
      const double px = sim::pixels_per_degree(cameras[i].camera().camera) / sim::kRadiansPerDegree *
                        settings.grid_km / 110.0;
      light_.emplace_back(*photos[i], settings.channel, std::max(0, static_cast<int>(0.5 * px)));
    }
    reach_ = static_cast<int>(settings.farthest_km / settings.grid_km);
    for (int row = -reach_; row <= reach_; ++row)
      for (int column = -reach_; column <= reach_; ++column) {
        GeodeticPlace below = geodetic_place(
            cameras[0].shape(), middle + axes_.transpose() * Eigen::Vector3d(column * settings.grid_km,
                                                                             row * settings.grid_km, 0.0));
        below.height_km = 0.0;
        ground_.push_back({column, row, earth_place_km(cameras[0].shape(), below),
                           east_north_up(below).row(2).transpose()});
      }
  }

  /// What both pictures show at a height, with the light of the second one moved on the shell.
  std::vector<Shown> at(const std::vector<ViewPoint>& cameras, double height_km, double east_km,
                        double north_km) const {
    std::vector<Shown> shown;
    const double least_sine = std::sin(settings_.lowest_elevation_deg * sim::kRadiansPerDegree);
    const Eigen::Vector3d moved = axes_.transpose() * Eigen::Vector3d(east_km, north_km, 0.0);
    for (const Ground& ground : ground_) {
      Shown one{ground.column, ground.row, {}};
      bool is_shown = true;
      for (int i = 0; i < 2 && is_shown; ++i) {
        const ViewPoint& view = cameras[i];
        Eigen::Vector3d there = ground.place_km + height_km * ground.up;
        if (i == 1) there += moved;
        const Eigen::Vector3d sight = there - view.place_km();
        is_shown = sight.dot(view.place_km()) > least_sine * sight.norm() * view.place_km().norm();
        if (!is_shown) break;
        const std::optional<PixelPoint> pixel = view.pixel(there);
        const std::optional<double> light = pixel ? light_[i].value(*pixel) : std::nullopt;
        is_shown = light.has_value();
        if (is_shown) one.light[i] = *light;
      }
      if (is_shown) shown.push_back(one);
    }
    return shown;
  }

  int reach() const { return reach_; }

 private:
  ShellSettings settings_;
  Eigen::Matrix3d axes_;
  /// A place of the grid on the ground.
  struct Ground {
    int column, row;
    Eigen::Vector3d place_km, up;
  };
  std::vector<Ground> ground_;
  std::vector<SmoothLight> light_;
  int reach_ = 0;
};

struct Patterns {
  std::vector<Shown> shown;
  Eigen::VectorXd first, second;
};

Patterns patterns_of(std::vector<Shown> shown, int reach, Weighting weighting = Weighting::even) {
  Patterns patterns;
  Eigen::MatrixXd surface(static_cast<Eigen::Index>(shown.size()), 6);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double x = static_cast<double>(shown[i].column) / reach,
                 y = static_cast<double>(shown[i].row) / reach;
    surface.row(static_cast<Eigen::Index>(i)) << 1.0, x, y, x * x, x * y, y * y;
  }
  patterns.first = rank_pattern(shown, 0, surface, weighting);
  patterns.second = rank_pattern(shown, 1, surface, weighting);
  patterns.shown = std::move(shown);
  return patterns;
}

double correlation_of(const Patterns& p) {
  if (p.shown.size() < kFewestPlaces) return sim::kNaN;
  return p.first.dot(p.second) / std::sqrt(p.first.squaredNorm() * p.second.squaredNorm());
}

/// Number of independent places, by what the pictures do not share.
double independent_places(const Patterns& p, double correlation, int reach) {
  const std::size_t width = 2 * static_cast<std::size_t>(reach) + 1;
  const Eigen::VectorXd differ = p.second / p.second.norm() - correlation * p.first / p.first.norm();
  std::vector<double> grid(width * width, sim::kNaN);
  for (std::size_t i = 0; i < p.shown.size(); ++i)
    grid[static_cast<std::size_t>(p.shown[i].row + reach) * width +
         static_cast<std::size_t>(p.shown[i].column + reach)] = differ[static_cast<Eigen::Index>(i)];
  return std::max(4.0, independent_values(grid, width, width));
}

/// The height of the best correlation near `around_km`; NaN if there is none inside of the reach.
double best_near(const Shells& shells, const std::vector<ViewPoint>& cameras, double around_km,
                 double east_km, double north_km, double step_km, Weighting weighting = Weighting::even) {
  std::vector<double> height_km, value;
  for (double h = around_km - kPerturbedReach_km; h <= around_km + kPerturbedReach_km + 1e-9;
       h += 2.0 * step_km) {
    height_km.push_back(h);
    value.push_back(
        correlation_of(patterns_of(shells.at(cameras, h, east_km, north_km), shells.reach(), weighting)));
  }
  std::size_t best = value.size();
  for (std::size_t i = 0; i < value.size(); ++i)
    if (std::isfinite(value[i]) && (best == value.size() || value[i] > value[best])) best = i;
  return best == value.size() ? sim::kNaN : refined_maximum(height_km, value, best);
}

/// The standard error by pointing, clocks and what counts in a pattern: by doing it again with each of them
/// off.
double common_error_km(const Shells& shells, const std::vector<ViewPoint>& cameras, double km,
                       const ShellSettings& settings) {
  double squares = 0.0;
  const double base = best_near(shells, cameras, km, 0.0, 0.0, settings.step_km);
  const auto add = [&](double changed_km) {
    // What leaves the heights that are looked at is at least as far off as their end.
    const double off = std::isfinite(changed_km) ? changed_km - base : kPerturbedReach_km;
    squares += off * off;
  };
  for (std::size_t i = 0; i < 2; ++i)
    for (int axis = 0; axis < 3 && cameras[i].camera().pointing_error_deg > 0.0; ++axis) {
      std::vector<ViewPoint> off = cameras;
      off[i] = turned(cameras[i], axis, cameras[i].camera().pointing_error_deg);
      add(best_near(shells, off, km, 0.0, 0.0, settings.step_km));
    }
  // Which part of the light counts: another one is at another height.
  add(best_near(shells, cameras, km, 0.0, 0.0, settings.step_km, Weighting::bright));
  if (settings.moved_km > 0.0) {
    add(best_near(shells, cameras, km, settings.moved_km, 0.0, settings.step_km));
    add(best_near(shells, cameras, km, 0.0, settings.moved_km, settings.step_km));
  }
  return std::sqrt(squares);
}

/// Delete-a-block jackknife (B. Efron, "The jackknife, the bootstrap and other resampling plans", 1982): the
/// height again without each of the pieces of the shared sky.
double left_out_error_km(const std::vector<Patterns>& near, const std::vector<double>& height_km) {
  int least[2] = {1 << 20, 1 << 20}, most[2] = {-(1 << 20), -(1 << 20)};
  for (const Shown& one : near[near.size() / 2].shown) {
    least[0] = std::min(least[0], one.column), most[0] = std::max(most[0], one.column);
    least[1] = std::min(least[1], one.row), most[1] = std::max(most[1], one.row);
  }
  const auto block_of = [&](const Shown& one) {
    const auto part = [&](int value, int axis) {
      return std::clamp((value - least[axis]) * kBlocks / std::max(1, most[axis] - least[axis] + 1), 0,
                        kBlocks - 1);
    };
    return part(one.row, 1) * kBlocks + part(one.column, 0);
  };
  std::vector<double> found;
  for (int block = 0; block < kBlocks * kBlocks; ++block) {
    std::vector<double> value;
    bool has_any = false;
    for (const Patterns& p : near) {
      double ab = 0.0, aa = 0.0, bb = 0.0;
      for (std::size_t i = 0; i < p.shown.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        if (block_of(p.shown[i]) == block) {
          has_any = true;
          continue;
        }
        ab += p.first[k] * p.second[k];
        aa += p.first[k] * p.first[k];
        bb += p.second[k] * p.second[k];
      }
      value.push_back(ab / std::sqrt(aa * bb));
    }
    if (!has_any) continue;
    const auto best = static_cast<std::size_t>(std::max_element(value.begin(), value.end()) - value.begin());
    found.push_back(refined_maximum(height_km, value, best));
  }
  const double n = static_cast<double>(found.size());
  const double mean = std::accumulate(found.begin(), found.end(), 0.0) / n;
  double squares = 0.0;
  for (const double one : found) squares += (one - mean) * (one - mean);
  return std::sqrt((n - 1.0) / n * squares);
}

}  // namespace

namespace {

/// Whether a maximum is inside of the heights and the correlation falls to both sides of it: curtains beside
/// the cameras look alike on every shell.
bool depends_on_height(const ShellCorrelation& found, std::size_t peak) {
  const std::vector<double>& r = found.correlation;
  const double step_km = found.height_km[1] - found.height_km[0];
  const auto far = static_cast<std::size_t>(kContrastReach_km / step_km);
  if (peak < 2 || peak + 2 >= r.size() || !(r[peak] >= kLeastCorrelation)) return false;
  const double below = r[peak > far ? peak - far : 0], above = r[std::min(r.size() - 1, peak + far)];
  return below < r[peak] - kLeastContrast && above < r[peak] - kLeastContrast;
}

/// The logarithm of the probability of a correlation where the pictures show the same, over that where they
/// have nothing in common, with all correlations from 0 to 1 alike before.
double evidence_of(double r, double n) {
  constexpr int kSteps = 400;
  std::vector<double> logarithms;
  for (int i = 0; i < kSteps; ++i) {
    const double rho = (i + 0.5) / kSteps;
    logarithms.push_back(0.5 * n * std::log1p(-rho * rho) - n * std::log1p(-rho * r));
  }
  const double most = *std::max_element(logarithms.begin(), logarithms.end());
  double sum = 0.0;
  for (const double logarithm : logarithms) sum += std::exp(logarithm - most);
  return most + std::log(sum / kSteps);
}

/// The number of the maximum that each height belongs to. Two maxima are one unless the evidence between them
/// is less than both by kDip.
std::vector<std::size_t> tops_of(const std::vector<double>& evidence) {
  constexpr double kDip = 1.0;
  const std::size_t count = evidence.size();
  std::vector<std::size_t> ends;  // the lowest place between two maxima
  std::size_t high = 0, low = 0;
  bool is_falling = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_falling) {
      if (evidence[i] >= evidence[high]) high = i;
      if (evidence[i] < evidence[high] - kDip) {
        is_falling = true;
        low = i;
      }
      continue;
    }
    if (evidence[i] < evidence[low]) low = i;
    if (evidence[i] > evidence[low] + kDip) {
      ends.push_back(low);
      is_falling = false;
      high = i;
    }
  }
  ends.push_back(count);
  std::vector<std::size_t> top(count);
  std::size_t from = 0;
  for (const std::size_t end : ends) {
    const auto begin = evidence.begin() + static_cast<std::ptrdiff_t>(from);
    const auto best = std::max_element(begin, evidence.begin() + static_cast<std::ptrdiff_t>(end));
    std::fill(top.begin() + static_cast<std::ptrdiff_t>(from), top.begin() + static_cast<std::ptrdiff_t>(end),
              static_cast<std::size_t>(best - evidence.begin()));
    from = end;
  }
  return top;
}

}  // namespace

ShellCorrelation shell_correlation(const std::vector<ViewPoint>& cameras,
                                   const std::vector<const Photo*>& photos, const ShellSettings& settings) {
  ShellCorrelation found;
  const Shells shells(photos, cameras, settings);
  std::vector<Patterns> all;
  for (double h = settings.range.lowest_km; h <= settings.range.highest_km + 1e-9; h += settings.step_km) {
    found.height_km.push_back(h);
    all.push_back(patterns_of(shells.at(cameras, h, 0.0, 0.0), shells.reach()));
    found.correlation.push_back(correlation_of(all.back()));
  }
  const std::size_t count = found.height_km.size();
  std::size_t best = count;
  for (std::size_t i = 0; i < count; ++i)
    if (std::isfinite(found.correlation[i]) && found.correlation[i] > 0.0 &&
        (best == count || found.correlation[i] > found.correlation[best]))
      best = i;
  if (best == count) return found;
  found.places = all[best].shown.size();
  found.independent_places = independent_places(all[best], found.correlation[best], shells.reach());
  std::vector<double> evidence(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
    evidence[i] = evidence_of(std::isfinite(found.correlation[i]) ? found.correlation[i] : 0.0,
                              found.independent_places);
  if (evidence[best] < kLeastEvidence) return found;

  const std::vector<std::size_t> top = tops_of(evidence);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += std::exp(evidence[i] - evidence[best]);
  for (std::size_t peak = 0; peak < count; ++peak) {
    if (top[peak] != peak) continue;
    double weight = 0.0, mean = 0.0, square = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      if (top[i] != peak) continue;
      const double w = std::exp(evidence[i] - evidence[best]) / sum;
      weight += w;
      mean += w * found.height_km[i];
      square += w * found.height_km[i] * found.height_km[i];
    }
    if (weight < kLeastWeight || !depends_on_height(found, peak)) continue;
    mean /= weight;
    ShellHeight height;
    height.km = refined_maximum(found.height_km, evidence, peak);
    height.correlation = found.correlation[peak];
    height.weight = weight;
    const double width_km = std::sqrt(std::max(0.0, square / weight - mean * mean));
    const std::size_t half = static_cast<std::size_t>(kPerturbedReach_km / settings.step_km);
    const std::size_t from = peak > half ? peak - half : 0, to = std::min(count, peak + half + 1);
    std::vector<Patterns> near;
    std::vector<double> near_km;
    for (std::size_t i = from; i < to; ++i)
      if (all[i].shown.size() >= kFewestPlaces) {
        near.push_back(all[i]);
        near_km.push_back(found.height_km[i]);
      }
    const double own = std::max(width_km, left_out_error_km(near, near_km));
    height.error_km = std::hypot(own, common_error_km(shells, cameras, height.km, settings));
    found.heights.push_back(height);
  }
  std::stable_sort(found.heights.begin(), found.heights.end(),
                   [](const ShellHeight& a, const ShellHeight& b) { return a.weight > b.weight; });
  return found;
}

}  // namespace vegard::fit
