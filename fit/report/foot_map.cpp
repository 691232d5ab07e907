#include "fit/report/foot_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/report/map_grid.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr double kSide_px = 460.0, kLeft_px = 62.0, kTop_px = 58.0, kRight_px = 216.0, kBottom_px = 30.0;
constexpr double kMargin = 0.12;  // of the map's width, on each side
constexpr double kMinHalf_km = 60.0, kFarthestShown_km = 1500.0;
constexpr double kSineShows_px = 1.0;  // amplitude
constexpr int kMapCoarse = 65, kFine = 1201;
constexpr Colour kMapInk{29, 36, 48}, kSoft{102, 112, 128}, kField{140, 150, 160};

using GroundPoints = std::vector<GroundPoint>;

GroundPoints on_ground(const std::vector<sim::EastNorth>& feet) {
  GroundPoints points;
  for (const sim::EastNorth& foot : feet) points.push_back(ground_of_foot(foot));
  return points;
}

/// A photograph's site and field of view, on the map about the home site.
struct MappedStation {
  std::string name;
  GroundPoint site;
  GroundPoints field_of_view;
};

/// A point of the ground about one site, about another.
GroundPoint carried(const sim::Site& from, const sim::Site& home, GroundPoint p) {
  const double angle = std::hypot(p.x, p.y) / sim::kEarthRadiusKm, azimuth = std::atan2(p.x, p.y);
  const double here = from.latitude_deg * sim::kRadiansPerDegree;
  const double east = std::sin(angle) * std::sin(azimuth), north = std::sin(angle) * std::cos(azimuth),
               up = std::cos(angle);
  const double pole = std::cos(here) * north + std::sin(here) * up,
               out = std::cos(here) * up - std::sin(here) * north;
  return ground_of_place(
      home.latitude_deg, std::atan2(pole, std::hypot(east, out)) / sim::kRadiansPerDegree,
      from.longitude_deg - home.longitude_deg + std::atan2(east, out) / sim::kRadiansPerDegree);
}

std::vector<MappedStation> stations_of(const FitResult& result) {
  const sim::Site& home = result.best.site;
  std::vector<MappedStation> stations;
  for (const FittedPhoto& photo : result.photos) {
    const sim::Site& site = photo.best.site;
    MappedStation station{photo.name, carried(site, home, {0.0, 0.0}), camera_footprint(photo.best)};
    for (GroundPoint& p : station.field_of_view) p = carried(site, home, p);
    stations.push_back(std::move(station));
  }
  return stations;
}

/// The line of an arc's feet, moved so many sigmas to the left.
GroundPoints moved_line(const sim::Sheet& sheet, const sim::FootBand& band, double instant_s, int arc,
                        double sigmas) {
  const double bearing = sheet.bearing_deg * sim::kRadiansPerDegree;
  std::vector<sim::EastNorth> feet =
      sim::straight_feet(sheet, instant_s, arc, static_cast<int>(band.sigma_km.size()));
  for (std::size_t i = 0; i < feet.size(); ++i) {
    feet[i].east -= sigmas * band.sigma_km[i] * std::cos(bearing);
    feet[i].north += sigmas * band.sigma_km[i] * std::sin(bearing);
  }
  return on_ground(feet);
}

/// All sites, and the feet that are not absurdly far.
MapFrame frame_of(const FitResult& result, const std::vector<MappedStation>& stations) {
  double west = 0.0, east = 0.0, south = 0.0, north = 0.0;
  const auto take = [&](const GroundPoint& p) {
    if (!(std::hypot(p.x, p.y) < kFarthestShown_km)) return;
    west = std::min(west, p.x);
    east = std::max(east, p.x);
    south = std::min(south, p.y);
    north = std::max(north, p.y);
  };
  for (const MappedStation& station : stations) take(station.site);
  for (const sim::Sheet& sheet : result.best.sheets)
    for (int arc = 0; arc < sheet.arcs; ++arc)
      for (const GroundPoint& p :
           on_ground(sim::straight_feet(sheet, result.best.time.start_s, arc, kMapCoarse)))
        take(p);
  MapFrame frame;
  frame.area_px = {kLeft_px, kTop_px, kSide_px, kSide_px};
  frame.center_km = {0.5 * (west + east), 0.5 * (south + north)};
  const double half = std::max(kMinHalf_km, 0.5 * std::max(east - west, north - south));
  frame.km_per_px = 2.0 * half * (1.0 + 2.0 * kMargin) / kSide_px;
  return frame;
}

Colour sheet_colour(std::size_t index) {
  return index == 0 ? line_ink(557.7) : distinct_colour(static_cast<int>(index) - 1);
}

void draw_field_of_view(const MapFrame& frame, const MappedStation& station, PlotCanvas& canvas) {
  if (station.field_of_view.size() < 3) return;
  std::vector<PlotPoint> outline = frame.pixels(station.field_of_view);
  canvas.area(outline, kField, 0.16);
  outline.push_back(outline.front());
  canvas.line(outline, kField, 1.0, false);
}

void draw_sheet(const MapFrame& frame, const FitResult& result, std::size_t s, PlotCanvas& canvas) {
  const sim::Sheet& sheet = result.best.sheets[s];
  const double instant = result.best.time.start_s;
  const Colour colour = sheet_colour(s);
  const bool sine_shows = sheet.thickness_km / frame.km_per_px >= kSineShows_px;
  for (int arc = 0; arc < sheet.arcs; ++arc) {
    if (s < result.foot_bands.size() && !result.foot_bands[s].sigma_km.empty()) {
      GroundPoints band = moved_line(sheet, result.foot_bands[s], instant, arc, 1.0);
      const GroundPoints right = moved_line(sheet, result.foot_bands[s], instant, arc, -1.0);
      band.insert(band.end(), right.rbegin(), right.rend());
      canvas.area(frame.pixels(band), colour, 0.25);
    }
    canvas.line(frame.pixels(on_ground(sim::straight_feet(sheet, instant, arc, kMapCoarse))), colour,
                sine_shows ? 0.8 : 1.8, sine_shows);
    if (sine_shows)
      canvas.line(frame.pixels(on_ground(sim::sine_feet(result.best, sheet, instant, arc, kFine))), colour,
                  1.8, false);
  }
}

/// "68 %: \u00b10.2 to 0.4 km".
std::string band_words(const sim::FootBand& band) {
  const auto [least, most] = std::minmax_element(band.sigma_km.begin(), band.sigma_km.end());
  const std::string low = sim::short_number(*least, 2), high = sim::short_number(*most, 2);
  return "68 %: \u00b1" + (low == high ? "" : low + " to ") + high + " km";
}

/// What stands beside the map.
void draw_legend(const FitResult& result, PlotCanvas& canvas) {
  const double x = kLeft_px + kSide_px + 18.0;
  double y = kTop_px + 14.0;
  const auto entry = [&](const std::string& text, bool head) {
    canvas.text({x + 30.0, y + 4.0}, text, {12.0, TextAnchor::start, head ? kMapInk : kSoft});
    y += 18.0;
  };
  for (std::size_t s = 0; s < result.best.sheets.size(); ++s) {
    canvas.line({{x, y}, {x + 22.0, y}}, sheet_colour(s), 2.0, false);
    entry("feet of " + result.best.sheets[s].name, true);
    const bool has_band = s < result.foot_bands.size() && !result.foot_bands[s].sigma_km.empty();
    if (has_band)
      canvas.area({{x, y - 5.0}, {x + 22.0, y - 5.0}, {x + 22.0, y + 5.0}, {x, y + 5.0}}, sheet_colour(s),
                  0.25);
    entry(has_band ? band_words(result.foot_bands[s]) : "no error bar", false);
  }
  canvas.area({{x, y - 5.0}, {x + 22.0, y - 5.0}, {x + 22.0, y + 5.0}, {x, y + 5.0}}, kField, 0.3);
  entry("seen at 110 km", true);
  canvas.dot({x + 11.0, y}, 7.0, kMapInk);
  entry(result.photos.size() > 1 ? "cameras" : "camera", true);
}

constexpr int kFootprintDirections = 180, kFootprintSteps = 96, kGrid = 24;

std::optional<GroundPoint> seen_by(const sim::Scene& scene, double x_px, double y_px) {
  const sim::Direction d = sim::direction_of_pixel(scene.camera, x_px, y_px);
  if (!std::isfinite(d.azimuth_deg) || !std::isfinite(d.elevation_deg)) return {};  // outside the lens
  return ground_of_sight({d.azimuth_deg, d.elevation_deg}, 1e-3 * scene.site.altitude_m);
}

/// The mean of the pixels that see the altitude, or of those the nearest to it.
std::optional<PlotPoint> pixel_to_start_from(const sim::Scene& scene) {
  std::vector<PlotPoint> seeing;
  PlotPoint mean;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const PlotPoint pixel{scene.camera.width * (i + 0.5) / kGrid, scene.camera.height * (j + 0.5) / kGrid};
      if (!seen_by(scene, pixel.x, pixel.y)) continue;
      seeing.push_back(pixel);
      mean.x += pixel.x;
      mean.y += pixel.y;
    }
  if (seeing.empty()) return {};
  const double count = static_cast<double>(seeing.size());
  const auto off = [&](const PlotPoint& p) { return std::hypot(p.x - mean.x / count, p.y - mean.y / count); };
  return *std::min_element(seeing.begin(), seeing.end(),
                           [&](const PlotPoint& a, const PlotPoint& b) { return off(a) < off(b); });
}

/// Directions all around, and those of the picture's corners.
std::vector<double> angles_from(const sim::Camera& camera, PlotPoint from) {
  std::vector<double> angles;
  for (int i = 0; i < kFootprintDirections; ++i)
    angles.push_back(sim::kTwoPi * (static_cast<double>(i) / kFootprintDirections - 0.5));
  for (const int x : {0, camera.width})
    for (const int y : {0, camera.height}) angles.push_back(std::atan2(y - from.y, x - from.x));
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// How far from a pixel the picture's edge is.
double reach_px(const sim::Camera& camera, PlotPoint from, double dx, double dy) {
  double reach = std::numeric_limits<double>::infinity();
  if (dx > 0.0) reach = std::min(reach, (camera.width - from.x) / dx);
  if (dx < 0.0) reach = std::min(reach, -from.x / dx);
  if (dy > 0.0) reach = std::min(reach, (camera.height - from.y) / dy);
  if (dy < 0.0) reach = std::min(reach, -from.y / dy);
  return reach;
}

}  // namespace

std::string foot_map_svg(const FitResult& result) {
  if (result.best.sheets.empty()) return {};
  const std::vector<MappedStation> stations = stations_of(result);
  const MapFrame frame = frame_of(result, stations);
  const MapGrid grid = map_grid(frame, result.best);
  const PlotSize size{kLeft_px + kSide_px + kRight_px, kTop_px + kSide_px + kBottom_px};
  return drawn_svg("Where the feet stand", size, [&](PlotCanvas& canvas) {
    canvas.area({{0, 0}, {size.width, 0}, {size.width, size.height}, {0, size.height}}, {255, 255, 255}, 1.0);
    canvas.text({kLeft_px, 22.0}, "Where the feet stand", {15.0, TextAnchor::start, kMapInk, true});
    canvas.text({kLeft_px, 41.0}, grid.note, {12.0, TextAnchor::start, kSoft});
    canvas.begin_clip(frame.area_px);
    for (const MappedStation& station : stations) draw_field_of_view(frame, station, canvas);
    draw_grid_lines(frame, grid, canvas);
    for (std::size_t s = 0; s < result.best.sheets.size(); ++s) draw_sheet(frame, result, s, canvas);
    for (const MappedStation& station : stations) {
      const PlotPoint at = frame.pixel(station.site);
      canvas.dot(at, 8.0, kMapInk);
      canvas.text({at.x + 8.0, at.y + 4.0}, station.name.empty() ? "site" : station.name,
                  {12.0, TextAnchor::start, kMapInk});
    }
    draw_scale(frame, canvas);
    canvas.end_clip();
    draw_grid_labels(frame, grid, canvas);
    draw_legend(result, canvas);
  });
}

std::vector<GroundPoint> camera_footprint(const sim::Scene& scene) {
  std::vector<GroundPoint> outline;
  const std::optional<PlotPoint> from = pixel_to_start_from(scene);
  if (!from) return outline;
  for (const double angle : angles_from(scene.camera, *from)) {
    const double dx = std::cos(angle), dy = std::sin(angle);
    const double reach = reach_px(scene.camera, *from, dx, dy);
    for (int step = kFootprintSteps; step >= 0; --step) {
      const double away = reach * step / kFootprintSteps;
      const auto ground = seen_by(scene, from->x + away * dx, from->y + away * dy);
      if (!ground) continue;
      outline.push_back(*ground);
      break;
    }
  }
  return outline;
}

}  // namespace vegard::fit
