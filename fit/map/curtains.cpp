#include "fit/map/curtains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/light/height_profile.h"
#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {
namespace {

constexpr double kSmooth_px = 2.0;
constexpr int kReach_px = 4;                 // to the next point of a ridge, over a gap
constexpr double kHigh = 0.15, kLow = 0.06;  // of the brightest ridge (its upper hundredth): begin and go on
constexpr double kMinMean = 0.12;            // of a curtain's own, likewise
constexpr double kFaintHigh = 0.05, kFaintLow = 0.03, kMinFaintMean = 0.04;  // of those below
constexpr double kMinLength_km = 30.0;
constexpr double kStep_km = 5.0;
constexpr double kAcross_km = 14.0, kAcrossStep_km = 0.5;
constexpr double kLookAside_km = 12.0;
constexpr double kSides_km = 6.0;  // of a ridge that must be in view, or as much as its cell is deep

struct RidgeField {
  RasterGrid raster;
  std::vector<double> smooth;
  std::vector<std::uint8_t> is_ridge;
  std::vector<double> along_x, along_y, at_x, at_y;  ///< direction along the ridge; its place in pixels

  explicit RidgeField(const RasterGrid& r, std::vector<double> s)
      : raster(r),
        smooth(std::move(s)),
        is_ridge(r.size(), 0),
        along_x(r.size(), 0.0),
        along_y(r.size(), 0.0),
        at_x(r.size(), 0.0),
        at_y(r.size(), 0.0) {
    for (int y = 1; y + 1 < raster.rows; ++y)
      for (int x = 1; x + 1 < raster.columns; ++x) test(x, y);
  }

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * raster.columns + x; }

  void test(int x, int y) {
    const auto v = [&](int dx, int dy) { return smooth[index(x + dx, y + dy)]; };
    if (!(v(0, 0) > 0.0)) return;
    const double gx = 0.5 * (v(1, 0) - v(-1, 0)), gy = 0.5 * (v(0, 1) - v(0, -1));
    const double xx = v(1, 0) - 2.0 * v(0, 0) + v(-1, 0), yy = v(0, 1) - 2.0 * v(0, 0) + v(0, -1);
    const double xy = 0.25 * (v(1, 1) - v(1, -1) - v(-1, 1) + v(-1, -1));
    // The eigenvector of the most negative second derivative.
    const double half = 0.5 * (xx - yy), root = std::hypot(half, xy), least = 0.5 * (xx + yy) - root;
    if (!(least < 0.0)) return;
    double nx = xy, ny = least - xx;
    if (std::hypot(nx, ny) < 1e-12 * std::abs(least)) {
      nx = least - yy;
      ny = xy;
    }
    const double length = std::hypot(nx, ny);
    if (!(length > 0.0)) {
      nx = xx <= yy ? 1.0 : 0.0;
      ny = 1.0 - nx;
    } else {
      nx /= length;
      ny /= length;
    }
    const double t = -(gx * nx + gy * ny) / least;
    if (std::abs(t * nx) > 0.6 || std::abs(t * ny) > 0.6) return;
    const std::size_t i = index(x, y);
    is_ridge[i] = 1;
    along_x[i] = -ny;
    along_y[i] = nx;
    at_x[i] = x + t * nx;
    at_y[i] = y + t * ny;
  }
};

/// Where a raster's values are between its pixels.
double value_at(const RasterGrid& raster, const std::vector<double>& values, sim::EastNorth km) {
  const double x = (km.east - raster.west_km) / raster.step_km,
               y = (km.north - raster.south_km) / raster.step_km;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  if (i < 0 || j < 0 || i + 1 >= raster.columns || j + 1 >= raster.rows) return 0.0;
  const double u = x - i, w = y - j;
  const auto v = [&](int dx, int dy) {
    return values[static_cast<std::size_t>(j + dy) * raster.columns + i + dx];
  };
  return (1.0 - w) * ((1.0 - u) * v(0, 0) + u * v(1, 0)) + w * ((1.0 - u) * v(0, 1) + u * v(1, 1));
}

/// A ridge point and the direction in which the ridge is followed from it.
struct RidgeStep {
  int x = -1, y = -1;
  double dx = 0.0, dy = 0.0;
};

/// The ridge point within reach that goes on from `from` most nearly straight; none: x is -1.
RidgeStep next_on_ridge(const RidgeField& field, const std::vector<std::uint8_t>& used, const RidgeStep& from,
                        double low) {
  const auto [x, y, dx, dy] = from;
  RidgeStep best;
  double least = 1e9;
  for (int j = -kReach_px; j <= kReach_px; ++j)
    for (int i = -kReach_px; i <= kReach_px; ++i) {
      const int nx = x + i, ny = y + j;
      if ((i == 0 && j == 0) || nx < 1 || ny < 1 || nx + 1 >= field.raster.columns ||
          ny + 1 >= field.raster.rows)
        continue;
      const std::size_t n = field.index(nx, ny);
      if (!field.is_ridge[n] || used[n] || field.smooth[n] < low) continue;
      const double mx = field.at_x[n] - field.at_x[field.index(x, y)];
      const double my = field.at_y[n] - field.at_y[field.index(x, y)];
      const double step = std::hypot(mx, my);
      if (!(step > 0.0) || mx * dx + my * dy < 0.3 * step) continue;
      double ax = field.along_x[n], ay = field.along_y[n];
      if (ax * dx + ay * dy < 0.0) {
        ax = -ax;
        ay = -ay;
      }
      const double cost = step + 2.0 * std::acos(std::clamp(ax * dx + ay * dy, -1.0, 1.0)) +
                          1.0 * std::acos(std::clamp((mx * dx + my * dy) / step, -1.0, 1.0));
      if (cost < least) {
        least = cost;
        best = {nx, ny, ax, ay};
      }
    }
  return best;
}

/// Joins ridge points to both sides of a first one.
std::vector<sim::EastNorth> follow(const RidgeField& field, std::vector<std::uint8_t>& used, int x0, int y0,
                                   double low) {
  const std::size_t first = field.index(x0, y0);
  used[first] = 1;
  const auto half = [&](double sign) {
    std::vector<sim::EastNorth> points;
    RidgeStep at{x0, y0, sign * field.along_x[first], sign * field.along_y[first]};
    for (;;) {
      const RidgeStep next = next_on_ridge(field, used, at, low);
      if (next.x < 0) return points;
      // What lies beside the step belongs to this ridge too.
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) used[field.index(at.x + i, at.y + j)] = 1;
      at = next;
      const std::size_t n = field.index(at.x, at.y);
      used[n] = 1;
      points.push_back(field.raster.place(field.at_x[n], field.at_y[n]));
    }
  };
  const std::vector<sim::EastNorth> ahead = half(1.0), behind = half(-1.0);
  std::vector<sim::EastNorth> line(behind.rbegin(), behind.rend());
  line.push_back(field.raster.place(field.at_x[first], field.at_y[first]));
  line.insert(line.end(), ahead.begin(), ahead.end());
  return line;
}

/// Points of a line, smoothed a little, at equal distances along it.
std::vector<sim::EastNorth> evenly(const std::vector<sim::EastNorth>& line, double& length_km) {
  std::vector<sim::EastNorth> smooth = line;
  for (std::size_t i = 1; i + 1 < line.size(); ++i)
    smooth[i] = {0.25 * line[i - 1].east + 0.5 * line[i].east + 0.25 * line[i + 1].east,
                 0.25 * line[i - 1].north + 0.5 * line[i].north + 0.25 * line[i + 1].north};
  std::vector<double> at = {0.0};
  for (std::size_t i = 1; i < smooth.size(); ++i)
    at.push_back(at.back() +
                 std::hypot(smooth[i].east - smooth[i - 1].east, smooth[i].north - smooth[i - 1].north));
  length_km = at.back();
  const int steps = std::max(1, static_cast<int>(std::lround(length_km / kStep_km)));
  std::vector<sim::EastNorth> points;
  std::size_t i = 0;
  for (int k = 0; k <= steps; ++k) {
    const double wanted = length_km * k / steps;
    while (i + 2 < at.size() && at[i + 1] < wanted) ++i;
    const double t = at[i + 1] > at[i] ? std::clamp((wanted - at[i]) / (at[i + 1] - at[i]), 0.0, 1.0) : 0.0;
    points.push_back({smooth[i].east + t * (smooth[i + 1].east - smooth[i].east),
                      smooth[i].north + t * (smooth[i + 1].north - smooth[i].north)});
  }
  return points;
}

/// What a map says across a curtain at one of its points.
struct Section {
  double aside_km = 0.0;  ///< of the ridge
  double flux = 0.0, ln_energy = 0.0, width_km = 0.0;
};

/// Mean of three sections, over the way from one of the curtain's points to the next.
Section section(const RasterGrid& raster, const std::vector<double>& smooth, const RasterFlux& flux,
                sim::EastNorth at, sim::EastNorth across) {
  const auto moved = [&](double t, double along = 0.0) {
    return sim::EastNorth{at.east + t * across.east + along * across.north,
                          at.north + t * across.north - along * across.east};
  };
  const auto mean = [&](const std::vector<double>& values, double t) {
    constexpr double kThird = kStep_km / 3.0;
    return (value_at(raster, values, moved(t, -kThird)) + value_at(raster, values, moved(t)) +
            value_at(raster, values, moved(t, kThird))) /
           3.0;
  };
  Section s;
  double most = -1.0;
  for (double t = -kLookAside_km; t <= kLookAside_km; t += kAcrossStep_km) {
    // The nearer of two like ridges.
    const double v = value_at(raster, smooth, moved(t)) * std::exp(-0.5 * t * t / (8.0 * 8.0));
    if (v > most) {
      most = v;
      s.aside_km = t;
    }
  }
  // Out to where the flux has its valley to the next curtain, on either side.
  double bounds[2];
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? -1.0 : 1.0;
    double reach = kAcrossStep_km, before = value_at(raster, smooth, moved(s.aside_km));
    const double top = before;
    for (; reach < kAcross_km; reach += kAcrossStep_km) {
      const double v = value_at(raster, smooth, moved(s.aside_km + sign * reach));
      if (v > before || v < 0.02 * top) break;
      before = v;
    }
    bounds[side] = s.aside_km + sign * reach;
  }
  double sum = 0.0, first = 0.0, second = 0.0, ln = 0.0;
  for (double t = bounds[0]; t <= bounds[1]; t += kAcrossStep_km) {
    const double q = mean(flux.flux, t);
    sum += q;
    first += q * t;
    second += q * t * t;
    ln += mean(flux.flux_ln_energy, t);
  }
  if (sum > 0.0) {
    s.ln_energy = ln / sum;
    s.width_km = std::sqrt(std::max(0.0, second / sum - std::pow(first / sum, 2)));
    // Of a Gaussian of this width that carries the section's flux.
    constexpr double kRootTwoPi = 2.5066282746310002;
    s.flux = sum * kAcrossStep_km / (kRootTwoPi * std::max(s.width_km, 0.5 * raster.step_km));
  }
  return s;
}

/// Whether the perturbed solutions have the curtain as well: its flux, summed over its length and width, is
/// above its standard error. True without any.
bool is_in_all(double best, const std::vector<double>& others) {
  double squares = 0.0;
  for (const double other : others) squares += std::pow(other - best, 2);
  return others.empty() || std::sqrt(squares / static_cast<double>(others.size())) <= best;
}

}  // namespace

LowerBorder lower_border(const sim::Scene& scene, double energy_kev) {
  std::size_t line = 0;
  for (std::size_t l = 0; l < scene.emission.lines.size(); ++l)
    if (std::abs(scene.emission.lines[l] - 557.7) < 0.5) line = l;
  const auto border = [&](double energy) {
    const sim::HeightProfile profile =
        sim::maxwellian_profile(sim::emission_source(scene), {scene.emission.lines[line]}, energy);
    int peak = 0;
    const auto rate = [&](int row) { return profile.rate[static_cast<std::size_t>(row) * profile.stride]; };
    for (int row = 1; row < sim::HeightProfile::kAltitudes; ++row)
      if (rate(row) > rate(peak)) peak = row;
    int row = peak;
    while (row > 0 && rate(row) > 0.5f * rate(peak)) --row;
    const double t = row < peak ? (0.5 * rate(peak) - rate(row)) / (rate(row + 1) - rate(row)) : 0.0;
    return sim::HeightProfile::altitude_km(row + t);
  };
  constexpr double kStep = 0.05;
  const double low = std::max(energy_kev * std::exp(-kStep), 0.11),
               high = std::min(energy_kev * std::exp(kStep), 19.0);
  return {border(std::clamp(energy_kev, 0.11, 19.0)), (border(high) - border(low)) / std::log(high / low)};
}

namespace {

enum class Brightness { curtain, faint };

/// A map's flux on a raster, smoothed to look for ridges.
struct SmoothedFlux {
  RasterFlux flux;
  std::vector<double> smooth;
};

/// Squares of the replicates' differences from the best map at one point of a curtain.
struct SectionSquares {
  double aside = 0.0, flux = 0.0, ln_energy = 0.0, width = 0.0;

  void add(const Section& replicate, const Section& best) {
    aside += std::pow(replicate.aside_km - best.aside_km, 2);
    flux += std::pow(replicate.flux - best.flux, 2);
    ln_energy += std::pow(replicate.ln_energy - best.ln_energy, 2);
    width += std::pow(replicate.width_km - best.width_km, 2);
  }
};

double energy_of_curtain(const Curtain& curtain) {
  double sum = 0.0;
  for (const CurtainPoint& p : curtain.points) sum += p.flux_mw_m2.value * p.width_km.value;
  return sum;
}

/// Takes the ends that are out of view away: they are guesses.
void trim_to_view(std::vector<CurtainPoint>& points) {
  while (!points.empty() && !points.back().border_in_view) points.pop_back();
  points.erase(points.begin(), std::find_if(points.begin(), points.end(),
                                            [](const CurtainPoint& p) { return p.border_in_view; }));
}

class CurtainFinder {
 public:
  explicit CurtainFinder(const MapResult& result)
      : result_(result),
        raster_(raster_over(result)),
        best_(smoothed_flux(result.cells)),
        in_view_(rasterised(result, raster_, {result.border_in_view.begin(), result.border_in_view.end()})),
        field_(raster_, best_.smooth) {
    for (const std::vector<CellFlux>& replicate : result.replicates)
      replicates_.push_back(smoothed_flux(replicate));
  }

  /// Faint ridges are looked for where the bright ones have left something.
  std::vector<Curtain> find(Brightness wanted) {
    std::vector<Curtain> curtains;
    std::vector<std::uint8_t> used(raster_.size(), 0);
    for (const std::size_t seed : seeds()) {
      const bool is_bright_seed = field_.smooth[seed] >= kHigh * brightest_;
      if (used[seed] ||
          (!is_bright_seed && (wanted != Brightness::faint || field_.smooth[seed] < kFaintHigh * brightest_)))
        continue;
      const std::vector<sim::EastNorth> ridge =
          follow(field_, used, static_cast<int>(seed % raster_.columns),
                 static_cast<int>(seed / raster_.columns), (is_bright_seed ? kLow : kFaintLow) * brightest_);
      if (ridge.size() < 3) continue;
      if (std::optional<Curtain> curtain = curtain_along(ridge, is_bright_seed, wanted))
        curtains.push_back(std::move(*curtain));
    }
    std::stable_sort(curtains.begin(), curtains.end(), [](const Curtain& a, const Curtain& b) {
      return energy_of_curtain(a) > energy_of_curtain(b);
    });
    return curtains;
  }

 private:
  SmoothedFlux smoothed_flux(const std::vector<CellFlux>& cells) const {
    RasterFlux flux = raster_flux(result_, raster_, cells);
    std::vector<double> smooth = smoothed_raster(raster_, flux.flux, kSmooth_px);
    return {std::move(flux), std::move(smooth)};
  }

  /// A ridge has two sides. Light that ends where the view ends, or at the end of the ground, has been put
  /// there for want of a better place.
  bool has_both_sides(std::size_t i) const {
    const sim::EastNorth at = raster_.place(field_.at_x[i], field_.at_y[i]);
    const int cell = result_.grid.cell_at(at.east, at.north);
    const double reach = std::max(kSides_km, cell < 0 ? 0.0 : result_.grid.depth_km(cell));
    for (const double side : {-reach, reach}) {
      const sim::EastNorth beside{at.east + side * field_.along_y[i], at.north - side * field_.along_x[i]};
      if (!is_border_in_view(result_, beside) || !result_.grid.reaches(beside.east, beside.north))
        return false;
    }
    return true;
  }

  /// The ridge points in view, brightest first. Those without two sides are no ridge points any more.
  std::vector<std::size_t> seeds() {
    std::vector<std::size_t> order;
    std::vector<double> heights;
    for (std::size_t i = 0; i < raster_.size(); ++i) {
      if (!field_.is_ridge[i] || in_view_[i] <= 0.5) continue;
      if (!has_both_sides(i)) {
        field_.is_ridge[i] = 0;
        continue;
      }
      order.push_back(i);
      heights.push_back(field_.smooth[i]);
    }
    if (order.empty()) return order;
    brightest_ = sim::nth_value(heights, heights.size() - 1 - heights.size() / 100);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return field_.smooth[a] > field_.smooth[b]; });
    return order;
  }

  std::optional<Curtain> curtain_along(const std::vector<sim::EastNorth>& ridge, bool is_bright_seed,
                                       Brightness wanted) const {
    Curtain curtain;
    const std::vector<sim::EastNorth> feet = evenly(ridge, curtain.length_km);
    if (curtain.length_km < kMinLength_km) return {};
    double mean = 0.0;
    for (const sim::EastNorth& foot : feet) mean += value_at(raster_, field_.smooth, foot) / feet.size();
    const bool is_curtain = is_bright_seed && mean >= kMinMean * brightest_;
    if (is_curtain != (wanted == Brightness::curtain) || mean < kMinFaintMean * brightest_) return {};
    double whole = 0.0;  // flux, over length and width
    std::vector<double> whole_of_replicates(replicates_.size(), 0.0);
    for (std::size_t i = 0; i < feet.size(); ++i) {
      const sim::EastNorth before = feet[i > 0 ? i - 1 : 0], after = feet[std::min(i + 1, feet.size() - 1)];
      const double length = std::hypot(after.east - before.east, after.north - before.north);
      const sim::EastNorth across{-(after.north - before.north) / length,
                                  (after.east - before.east) / length};
      const Section best = section(raster_, best_.smooth, best_.flux, feet[i], across);
      whole += best.flux * best.width_km;
      SectionSquares squares;
      for (std::size_t r = 0; r < replicates_.size(); ++r) {
        const Section other = section(raster_, replicates_[r].smooth, replicates_[r].flux, feet[i], across);
        whole_of_replicates[r] += other.flux * other.width_km;
        squares.add(other, best);
      }
      curtain.points.push_back(point_at(feet[i], across, best, squares));
    }
    if (!is_in_all(whole, whole_of_replicates)) return {};
    trim_to_view(curtain.points);
    if (curtain.points.size() < 3) return {};
    curtain.length_km *= (curtain.points.size() - 1.0) / (feet.size() - 1.0);
    return curtain;
  }

  CurtainPoint point_at(sim::EastNorth foot, sim::EastNorth across, const Section& best,
                        const SectionSquares& squares) const {
    const auto count = static_cast<double>(replicates_.size());
    const auto spread = [&](double sum) { return count > 0.0 ? std::sqrt(sum / count) : sim::kNaN; };
    CurtainPoint p;
    p.foot_km = foot;
    p.distance_km = std::hypot(foot.east, foot.north);
    p.azimuth_deg = std::atan2(foot.east, foot.north) / sim::kRadiansPerDegree;
    if (p.azimuth_deg < 0.0) p.azimuth_deg += 360.0;
    p.border_in_view = value_at(raster_, in_view_, foot) > 0.5;
    // A ridge's place is not known better than a part of the cells it is made of.
    const int cell = result_.grid.cell_at(foot.east, foot.north);
    const double cell_km = cell < 0 ? raster_.step_km : result_.grid.depth_km(cell);
    p.lateral_error_km = std::hypot(spread(squares.aside), cell_km / std::sqrt(12.0));
    const double towards =
        p.distance_km > 0.0 ? (across.east * foot.east + across.north * foot.north) / p.distance_km : 1.0;
    p.distance_error_km = p.lateral_error_km * std::max(0.3, std::abs(towards));
    p.flux_mw_m2 = {best.flux, spread(squares.flux)};
    const double ln_error = kEnergyInflation * spread(squares.ln_energy);
    p.energy_kev = {std::exp(best.ln_energy), std::exp(best.ln_energy) * ln_error};
    // What is narrower than a part of a pixel has no width of its own.
    p.width_km = {std::max(best.width_km, 0.25 * raster_.step_km), spread(squares.width)};
    LowerBorder border = lower_border(result_.scene, p.energy_kev.value);
    border.altitude_km *= result_.altitude_scale;
    border.by_ln_energy *= result_.altitude_scale;
    p.lower_border_km = {border.altitude_km, std::abs(border.by_ln_energy) * ln_error};
    // A border that is higher is farther away at the same elevation.
    p.distance_error_km =
        std::hypot(p.distance_error_km, p.lower_border_km.error * p.distance_km / p.lower_border_km.value);
    return p;
  }

  const MapResult& result_;
  const RasterGrid raster_;
  const SmoothedFlux best_;
  const std::vector<double> in_view_;
  std::vector<SmoothedFlux> replicates_;
  RidgeField field_;
  double brightest_ = 0.0;  // ridge, its upper hundredth
};

std::vector<Curtain> ridges_of_map(const MapResult& result, Brightness wanted) {
  if (result.grid.cells() == 0) return {};
  return CurtainFinder(result).find(wanted);
}

}  // namespace

std::vector<Curtain> find_curtains(const MapResult& result) {
  return ridges_of_map(result, Brightness::curtain);
}

std::vector<Curtain> find_faint_curtains(const MapResult& result) {
  return ridges_of_map(result, Brightness::faint);
}

}  // namespace vegard::fit
