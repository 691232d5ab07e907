#include "fit/measure/keogram_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fit/measure/bin_grid.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kKeogramZenithDeg = 90.0;
constexpr int kPooledRows = 7;
constexpr double kTrialHalfWidthDeg = 5.0;  ///< in which the pixels' size is found
constexpr double kMinPixels = 1.5, kKeogramMaxSteps = 200.0;
constexpr double kBothSides = 0.25;  ///< share of the whole beyond the zenith that makes it the other side

/// A direction as seen from a vertical plane.
struct FromPlane {
  double along_deg;   ///< from the horizon at the plane's azimuth, -90 to 270
  double across_deg;  ///< from the plane
};

FromPlane from_plane(double azimuth_deg, double elevation_deg, double plane_azimuth_deg) {
  const double turn = (azimuth_deg - plane_azimuth_deg) * sim::kRadiansPerDegree;
  const double elevation = elevation_deg * sim::kRadiansPerDegree;
  const double forward = std::cos(elevation) * std::cos(turn), up = std::sin(elevation);
  FromPlane seen;
  seen.across_deg =
      std::asin(std::clamp(std::cos(elevation) * std::sin(turn), -1.0, 1.0)) / sim::kRadiansPerDegree;
  seen.along_deg = std::atan2(up, forward) / sim::kRadiansPerDegree;
  if (seen.along_deg < -kKeogramZenithDeg) seen.along_deg += 360.0;
  return seen;
}

/// The least of 1, 2 and 5 times a power of ten that is not below.
double round_up(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= least * (1.0 - 1e-9)) return digit * power;
  return 10.0 * power;
}

struct Span {
  double min = std::numeric_limits<double>::infinity(), max = -std::numeric_limits<double>::infinity();
  double across_min = min, across_max = max;
  double pixels = 0.0;
};

Span span_of(const sim::DirectionMap& map, const Region& region, double azimuth_deg, double half_width_deg) {
  Span span;
  for (int y = region.y; y < region.y + region.height; ++y)
    for (int x = region.x; x < region.x + region.width; ++x) {
      const std::size_t i = map.index(x, y);
      const FromPlane seen = from_plane(map.azimuth_deg[i], map.elevation_deg[i], azimuth_deg);
      if (!(std::abs(seen.across_deg) <= half_width_deg)) continue;  // NaN too
      span.min = std::min(span.min, seen.along_deg);
      span.max = std::max(span.max, seen.along_deg);
      span.across_min = std::min(span.across_min, seen.across_deg);
      span.across_max = std::max(span.across_max, seen.across_deg);
      span.pixels += 1.0;
    }
  return span;
}

double usual_step(const Span& trial) {
  const double length = trial.max - trial.min, across = trial.across_max - trial.across_min;
  const double pixel = std::sqrt(length * across / trial.pixels);
  return round_up(std::max({kMinPixels * pixel, length / kKeogramMaxSteps, 1e-6}));
}

}  // namespace

KeogramLine column_line(const Region& region, int width_px) {
  if (width_px < 0 || width_px > region.width)
    throw sim::Error(sim::ErrorKind::usage,
                     "a strip of " + std::to_string(width_px) + " columns is not in the region")
        .key("--width")
        .expected("1 to " + std::to_string(region.width) + " px");
  const int width = width_px == 0 ? region.width : width_px;
  BinGrid grid;
  grid.region = {region.x + (region.width - width) / 2, region.y, width, region.height};
  grid.groups = 1;
  grid.positions = region.height;
  grid.pooled = kPooledRows;
  grid.narrowest_px = width;
  grid.band.assign(grid.positions, 0);
  gather([&](int, int y) { return y - region.y; }, grid);
  KeogramLine line;
  line.width = width;
  for (int row = 0; row < region.height; ++row) line.position.push_back(region.y + row);
  line.grid = std::make_shared<const BinGrid>(std::move(grid));
  return line;
}

KeogramLine meridian_line(const sim::DirectionMap& map, const Region& region,
                          const MeridianOptions& options) {
  if (!std::isfinite(options.azimuth_deg))
    throw sim::Error(sim::ErrorKind::usage, "the azimuth is no number").key("--azimuth").expected("degrees");
  if (options.width_deg && !(*options.width_deg > 0.0 && *options.width_deg <= 180.0))
    throw sim::Error(sim::ErrorKind::usage, sim::short_number(*options.width_deg) + "\u00b0 is no width")
        .key("--width")
        .expected("more than 0, at most 180");
  if (options.step_deg && !(*options.step_deg >= 1e-4 && *options.step_deg <= kKeogramZenithDeg))
    throw sim::Error(sim::ErrorKind::usage, sim::short_number(*options.step_deg) + "\u00b0 is no step")
        .key("--elevation-step")
        .expected("0.0001 to 90");

  KeogramLine line;
  line.of_directions = true;
  line.azimuth_deg = options.azimuth_deg;
  const double trial_half_width = options.width_deg ? 0.5 * *options.width_deg : kTrialHalfWidthDeg;
  Span trial = span_of(map, region, line.azimuth_deg, trial_half_width);
  if (trial.pixels > 0.0 && trial.min > kKeogramZenithDeg) {
    line.azimuth_deg += 180.0;
    trial = span_of(map, region, line.azimuth_deg, trial_half_width);
  }
  line.azimuth_deg -= 360.0 * std::floor(line.azimuth_deg / 360.0);
  line.step = options.step_deg.value_or(trial.pixels > 0.0 ? usual_step(trial) : 1.0);
  line.width = options.width_deg.value_or(2.0 * line.step);
  const Span span = span_of(map, region, line.azimuth_deg, 0.5 * line.width);
  if (span.pixels == 0.0)
    throw sim::Error(sim::ErrorKind::usage, "the picture shows nothing of the vertical plane at azimuth " +
                                                sim::short_number(options.azimuth_deg) + "\u00b0")
        .key("--azimuth")
        .expected("a direction that it does show");

  const double first = std::floor(span.min / line.step), end = std::floor(span.max / line.step) + 1.0;
  BinGrid grid;
  grid.region = region;
  grid.groups = 1;
  grid.positions = static_cast<int>(end - first);
  grid.pooled = kPooledRows;
  grid.position_px = 0.0;
  grid.band.assign(grid.positions, 0);
  const bool both_sides = span.max - kKeogramZenithDeg > kBothSides * (span.max - span.min);
  const auto place_of = [&](double steps) {
    const int from_horizon = std::clamp(static_cast<int>(steps), 0, grid.positions - 1);
    return both_sides ? from_horizon : grid.positions - 1 - from_horizon;
  };
  gather(
      [&](int x, int y) {
        const std::size_t i = map.index(x, y);
        const FromPlane seen = from_plane(map.azimuth_deg[i], map.elevation_deg[i], line.azimuth_deg);
        if (!(std::abs(seen.across_deg) <= 0.5 * line.width)) return kNoBin;
        return place_of(seen.along_deg / line.step - first);
      },
      grid);
  for (int place = 0; place < grid.positions; ++place) {
    const int from_horizon = both_sides ? place : grid.positions - 1 - place;
    line.position.push_back((first + from_horizon + 0.5) * line.step);
  }
  grid.narrowest_px = region.width;
  for (const BinGrid::Run& run : grid.runs)
    grid.narrowest_px = std::min(grid.narrowest_px, run.end - run.begin);
  line.grid = std::make_shared<const BinGrid>(std::move(grid));
  return line;
}

}  // namespace vegard::fit
