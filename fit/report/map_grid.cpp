#include "fit/report/map_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::fit {
namespace {

constexpr Colour kMapGridInk{29, 36, 48}, kGridInk{188, 196, 205};
constexpr double kKmPerDegree = sim::kEarthRadiusKm * sim::kRadiansPerDegree;
constexpr int kPointsOfLine = 121;

/// The largest of 1, 2, 5 times a power of ten that is not above it.
double round_number_below(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= value) return factor * power;
  return power;
}

/// "68\u00b0 N", "17.5\u00b0 W".
std::string degrees_text(double degrees, double step, const char* positive, const char* negative) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  std::string number = fmt::format("{:.{}f}\u00b0", std::abs(degrees), decimals);
  if (std::abs(degrees) < 0.5 * std::pow(10.0, -decimals)) return number;
  return number + " " + (degrees > 0.0 ? positive : negative);
}

struct Extent {
  double south = 90.0, north = -90.0, west = 180.0, east = -180.0;  ///< longitudes from the site
};

/// Of the frame, by a net of its points.
Extent extent_of(const MapFrame& frame, double latitude_deg) {
  constexpr int kNet = 24;
  Extent extent;
  const double here = latitude_deg * sim::kRadiansPerDegree;
  for (int i = 0; i <= kNet; ++i)
    for (int j = 0; j <= kNet; ++j) {
      const double x = frame.center_km.x + (i - 0.5 * kNet) / kNet * frame.area_px.width * frame.km_per_px;
      const double y = frame.center_km.y + (j - 0.5 * kNet) / kNet * frame.area_px.height * frame.km_per_px;
      const double angle = std::hypot(x, y) / sim::kEarthRadiusKm, azimuth = std::atan2(x, y);
      const double east = std::sin(angle) * std::sin(azimuth), north = std::sin(angle) * std::cos(azimuth),
                   up = std::cos(angle);
      const double out = std::cos(here) * up - std::sin(here) * north;
      const double latitude =
          std::atan2(std::cos(here) * north + std::sin(here) * up, std::hypot(east, out)) /
          sim::kRadiansPerDegree;
      const double longitude = std::atan2(east, out) / sim::kRadiansPerDegree;
      extent.south = std::min(extent.south, latitude);
      extent.north = std::max(extent.north, latitude);
      extent.west = std::min(extent.west, longitude);
      extent.east = std::max(extent.east, longitude);
    }
  return extent;
}

double part(int i) { return static_cast<double>(i) / (kPointsOfLine - 1); }

void add_graticule(const MapFrame& frame, const sim::Scene& scene, MapGrid& grid) {
  const double latitude = scene.site.latitude_deg;
  const Extent e = extent_of(frame, latitude);
  const double across_deg = frame.area_px.width * frame.km_per_px / kKmPerDegree;
  const double step = std::min(10.0, round_number_below(across_deg / 4.0));
  for (double at = step * std::ceil(e.south / step); at <= e.north; at += step) {
    GridLine line{{}, degrees_text(at, step, "N", "S"), false};
    for (int i = 0; i < kPointsOfLine; ++i)
      line.points.push_back(frame.pixel(ground_of_place(latitude, at, e.west + part(i) * (e.east - e.west))));
    grid.lines.push_back(std::move(line));
  }
  const bool given = sim::is_longitude_given(scene);
  const double origin = given ? scene.site.longitude_deg : 0.0;
  const double wide = std::min(30.0, round_number_below((e.east - e.west) / 4.0));
  const double top = std::min(e.north, 90.0 - 0.01);
  for (double at = wide * std::ceil((origin + e.west) / wide); at <= origin + e.east; at += wide) {
    GridLine line{{}, degrees_text(given ? sim::wrapped_longitude_deg(at) : at, wide, "E", "W"), true};
    for (int i = 0; i < kPointsOfLine; ++i)
      line.points.push_back(
          frame.pixel(ground_of_place(latitude, e.south + part(i) * (top - e.south), at - origin)));
    grid.lines.push_back(std::move(line));
  }
  grid.note = given ? "Geographic latitude and longitude; feet at 110 km altitude"
                    : "Geographic latitude, longitude from the site (its own is not given); feet at 110 km";
}

void add_rings(const MapFrame& frame, MapGrid& grid) {
  const double step = round_number_below(frame.area_px.width * frame.km_per_px / 4.0);
  const double farthest =
      std::hypot(frame.center_km.x, frame.center_km.y) + 0.71 * frame.area_px.width * frame.km_per_px;
  for (double at = step; at <= farthest; at += step) {
    GridLine line{{}, fmt::format("{:g} km", at), false};
    for (int i = 0; i < kPointsOfLine; ++i)
      line.points.push_back(
          frame.pixel({at * std::sin(sim::kTwoPi * part(i)), at * std::cos(sim::kTwoPi * part(i))}));
    grid.lines.push_back(std::move(line));
  }
  grid.note =
      "Distance from the site on the ground; where the site is, is not given; feet at 110 km altitude";
}

/// Where a line crosses the left edge, or the lower one; none if it does not.
std::optional<double> crossing(const MapFrame& frame, const GridLine& line) {
  const PlotRectangle& r = frame.area_px;
  const double edge = line.is_meridian ? r.y + r.height : r.x;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const PlotPoint a = line.points[i - 1], b = line.points[i];
    const double from = line.is_meridian ? a.y : a.x, to = line.is_meridian ? b.y : b.x;
    if ((from - edge) * (to - edge) > 0.0 || from == to) continue;
    const double share = (edge - from) / (to - from);
    const double at = line.is_meridian ? a.x + share * (b.x - a.x) : a.y + share * (b.y - a.y);
    const double low = line.is_meridian ? r.x : r.y, size = line.is_meridian ? r.width : r.height;
    if (at >= low && at <= low + size) return at;
  }
  return {};
}

}  // namespace

std::vector<PlotPoint> MapFrame::pixels(const std::vector<GroundPoint>& points) const {
  std::vector<PlotPoint> pixels;
  for (const GroundPoint& p : points)
    if (std::isfinite(p.x) && std::isfinite(p.y)) pixels.push_back(pixel(p));
  return pixels;
}

bool MapFrame::contains(PlotPoint p) const {
  return p.x >= area_px.x && p.x <= area_px.x + area_px.width && p.y >= area_px.y &&
         p.y <= area_px.y + area_px.height;
}

MapGrid map_grid(const MapFrame& frame, const sim::Scene& scene) {
  MapGrid grid;
  if (sim::is_latitude_given(scene))
    add_graticule(frame, scene, grid);
  else
    add_rings(frame, grid);
  return grid;
}

void draw_grid_lines(const MapFrame& frame, const MapGrid& grid, PlotCanvas& canvas) {
  for (const GridLine& line : grid.lines) {
    const bool is_seen = std::any_of(line.points.begin(), line.points.end(),
                                     [&](const PlotPoint& p) { return frame.contains(p); });
    if (is_seen) canvas.line(line.points, kGridInk, 0.8, false);
  }
}

void draw_grid_labels(const MapFrame& frame, const MapGrid& grid, PlotCanvas& canvas) {
  constexpr double kSize_px = 11.0, kGap_px = 6.0;
  const PlotRectangle& r = frame.area_px;
  canvas.line(
      {{r.x, r.y}, {r.x + r.width, r.y}, {r.x + r.width, r.y + r.height}, {r.x, r.y + r.height}, {r.x, r.y}},
      kMapGridInk, 1.0, false);
  double last_meridian = -std::numeric_limits<double>::infinity();
  std::vector<double> parallels;
  for (const GridLine& line : grid.lines) {
    const std::optional<double> at = crossing(frame, line);
    if (!at) continue;
    if (line.is_meridian) {
      const double half = 0.5 * text_width_px(line.label, kSize_px);
      if (*at - half < last_meridian + kGap_px) continue;
      last_meridian = *at + half;
      canvas.text({*at, r.y + r.height + 16.0}, line.label, {kSize_px, TextAnchor::middle, kMapGridInk});
    } else {
      if (std::any_of(parallels.begin(), parallels.end(),
                      [&](double other) { return std::abs(other - *at) < kSize_px + 2.0; }))
        continue;
      parallels.push_back(*at);
      canvas.text({r.x - kGap_px, *at + 4.0}, line.label, {kSize_px, TextAnchor::end, kMapGridInk});
    }
  }
}

void draw_scale(const MapFrame& frame, PlotCanvas& canvas) {
  const PlotRectangle& r = frame.area_px;
  const double length_km = round_number_below(0.3 * r.width * frame.km_per_px);
  const double length = length_km / frame.km_per_px, x = r.x + 14.0, y = r.y + r.height - 16.0;
  canvas.area({{x - 6, y - 22}, {x + length + 6, y - 22}, {x + length + 6, y + 9}, {x - 6, y + 9}},
              {255, 255, 255}, 0.85);
  canvas.line({{x, y - 4}, {x, y + 4}, {x, y}, {x + length, y}, {x + length, y - 4}, {x + length, y + 4}},
              kMapGridInk, 1.4, false);
  canvas.text({x + 0.5 * length, y - 8.0}, fmt::format("{:g} km", length_km),
              {11.0, TextAnchor::middle, kMapGridInk});
  const double nx = r.x + r.width - 18.0, ny = r.y + 40.0;
  canvas.area({{nx, ny - 22}, {nx - 6, ny}, {nx, ny - 5}, {nx + 6, ny}}, kMapGridInk, 1.0);
  canvas.text({nx, ny - 25.0}, "N", {11.0, TextAnchor::middle, kMapGridInk, true});
}

}  // namespace vegard::fit
