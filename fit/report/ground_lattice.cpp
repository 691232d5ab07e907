#include "fit/report/ground_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::fit {
namespace ground_lattice {

using Vector = std::array<double, 3>;

constexpr Colour kGeographicInk{150, 158, 168}, kMagneticInk{170, 110, 180};
constexpr int kPieces = 60;  ///< of a line

/// A frame of latitudes and longitudes on the sphere, by its axes in the site's east, north and up.
struct Frame {
  Vector towards_zero, towards_ninety, pole;  ///< of longitude 0 and 90 degrees on the equator, and the pole
};

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The site is at longitude 0.
Frame geographic_frame(const sim::Scene& scene) {
  const double latitude = scene.site.latitude_deg * sim::kRadiansPerDegree;
  const double sine = std::sin(latitude), cosine = std::cos(latitude);
  return {{0.0, -sine, cosine}, {1.0, 0.0, 0.0}, {0.0, cosine, sine}};
}

Frame magnetic_frame(const sim::Scene& scene) {
  const sim::DipoleAxis axis = sim::dipole_axis(scene.field, scene.site);
  const Vector pole = {axis.in_enu[0], axis.in_enu[1], axis.in_enu[2]};
  const Vector north = geographic_frame(scene).pole;
  Vector away;  // from the geographic north pole
  for (int i = 0; i < 3; ++i) away[i] = dot(north, pole) * pole[i] - north[i];
  const double length = std::sqrt(dot(away, away));
  // A dipole along the Earth's axis has no such meridian; then it is that of the site.
  if (length < 1e-9) return geographic_frame(scene);
  for (double& x : away) x /= length;
  return {away, cross(pole, away), pole};
}

/// Returns the foot at a latitude and longitude of the frame, in the site's tangent plane; NaN behind the
/// Earth.
sim::EastNorth foot_at(const Frame& frame, double latitude_deg, double longitude_deg) {
  const double latitude = latitude_deg * sim::kRadiansPerDegree,
               longitude = longitude_deg * sim::kRadiansPerDegree;
  const double radius = sim::kEarthRadiusKm + sim::kFootAltitudeKm;
  Vector foot;
  for (int i = 0; i < 3; ++i)
    foot[i] = radius * (std::cos(latitude) * (std::cos(longitude) * frame.towards_zero[i] +
                                              std::sin(longitude) * frame.towards_ninety[i]) +
                        std::sin(latitude) * frame.pole[i]);
  return foot[2] > 0.0 ? sim::EastNorth{foot[0], foot[1]} : sim::EastNorth{sim::kNaN, sim::kNaN};
}

/// The limits of what the raster covers. The longitudes do not jump.
struct Limits {
  double south_deg = 90.0, north_deg = -90.0, west_deg = 1e9, east_deg = -1e9;
};

Limits limits_of(const Frame& frame, const RasterGrid& raster) {
  const double radius = sim::kEarthRadiusKm + sim::kFootAltitudeKm;
  const double middle_deg =
      std::atan2(frame.towards_ninety[2], frame.towards_zero[2]) / sim::kRadiansPerDegree;  // of the site
  Limits limits;
  for (const double x : {0.0, 0.5, 1.0})
    for (const double y : {0.0, 0.5, 1.0}) {
      const sim::EastNorth km = raster.place(x * raster.columns, y * raster.rows);
      const double east = km.east / radius, north = km.north / radius;
      const double up = std::sqrt(1.0 - east * east - north * north);
      if (std::isnan(up)) continue;
      const Vector place = {east, north, up};
      const double along = dot(place, frame.towards_zero), aside = dot(place, frame.towards_ninety);
      const double latitude =
          std::atan2(dot(place, frame.pole), std::hypot(along, aside)) / sim::kRadiansPerDegree;
      const double longitude =
          middle_deg +
          sim::wrapped_longitude_deg(std::atan2(aside, along) / sim::kRadiansPerDegree - middle_deg);
      limits.south_deg = std::min(limits.south_deg, latitude);
      limits.north_deg = std::max(limits.north_deg, latitude);
      limits.west_deg = std::min(limits.west_deg, longitude);
      limits.east_deg = std::max(limits.east_deg, longitude);
    }
  return limits;
}

double round_grid_step(double range) {
  for (const double step : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0})
    if (range / step <= 6.0) return step;
  return 20.0;
}

/// Adds the lines of a frame. `zero_deg` is the longitude that the frame's zero is at.
void add_lines(const Frame& frame, const RasterGrid& raster, Colour ink, const std::string& word,
               double zero_deg, Panel& panel) {
  const Limits limits = limits_of(frame, raster);
  const auto add = [&](const std::string& label, const auto& point) {
    Series line;
    line.label = label;
    line.colour = ink;
    line.mark = Mark::dashed_line;
    line.width_px = 0.8;
    for (int i = 0; i <= kPieces; ++i) {
      const sim::EastNorth p = point(static_cast<double>(i) / kPieces);
      const bool inside = p.east > raster.west_km && p.north > raster.south_km &&
                          p.east < raster.west_km + raster.columns * raster.step_km &&
                          p.north < raster.south_km + raster.rows * raster.step_km;
      line.x.push_back(inside ? p.east : sim::kNaN);
      line.y.push_back(inside ? p.north : sim::kNaN);
    }
    panel.series.push_back(std::move(line));
  };
  const double tall = limits.north_deg - limits.south_deg, wide = limits.east_deg - limits.west_deg;
  const double lat_step = round_grid_step(tall), lon_step = round_grid_step(wide);
  std::string label = fmt::format("every {} ° of {}latitude, {} ° of longitude", sim::short_number(lat_step),
                                  word, sim::short_number(lon_step));
  for (double lat = std::ceil(limits.south_deg / lat_step) * lat_step; lat <= limits.north_deg;
       lat += lat_step) {
    add(label, [&](double t) { return foot_at(frame, lat, limits.west_deg + t * wide); });
    label.clear();
  }
  const double west = zero_deg + limits.west_deg, east = zero_deg + limits.east_deg;
  for (double lon = std::ceil(west / lon_step) * lon_step; lon <= east; lon += lon_step)
    add("", [&](double t) { return foot_at(frame, limits.south_deg + t * tall, lon - zero_deg); });
}

}  // namespace ground_lattice

void add_geographic_grid(const sim::Scene& scene, const RasterGrid& raster, Panel& panel) {
  ground_lattice::add_lines(ground_lattice::geographic_frame(scene), raster, ground_lattice::kGeographicInk,
                            "", scene.site.longitude_deg, panel);
}

void add_magnetic_grid(const sim::Scene& scene, const RasterGrid& raster, Panel& panel) {
  ground_lattice::add_lines(ground_lattice::magnetic_frame(scene), raster, ground_lattice::kMagneticInk,
                            "dipole ", 0.0, panel);
}

}  // namespace vegard::fit
