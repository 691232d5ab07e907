#include "fit/map/geographic_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::fit {
namespace {

using Vector = std::array<double, 3>;

// The defaults of GEMINI (gemini3d/pygemini, coord.py).
constexpr double kGeminiPoleColatitude_deg = 11.0, kGeminiPoleLongitude_deg = 289.0;
constexpr double kMaxGridCells = 4194304.0;
constexpr double kHalfTurn_deg = 180.0, kTurn_deg = 360.0;

Vector unit_vector(LongitudeLatitude place) {
  const double lat = place.latitude_deg * sim::kRadiansPerDegree,
               lon = place.longitude_deg * sim::kRadiansPerDegree;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

LongitudeLatitude place_of(const Vector& v) {
  return {std::atan2(v[1], v[0]) / sim::kRadiansPerDegree,
          std::atan2(v[2], std::hypot(v[0], v[1])) / sim::kRadiansPerDegree};
}

double scalar_product(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Unit vectors of the dipole's frame: z to its pole, y at right angles to both poles.
std::array<Vector, 3> dipole_axes() {
  const Vector z = unit_vector({kGeminiPoleLongitude_deg, 90.0 - kGeminiPoleColatitude_deg});
  const double sine = std::hypot(z[0], z[1]);
  const Vector y = {-z[1] / sine, z[0] / sine, 0.0};
  return {Vector{y[1] * z[2] - y[2] * z[1], y[2] * z[0] - y[0] * z[2], y[0] * z[1] - y[1] * z[0]}, y, z};
}

double from_zero(double longitude_deg) {
  return longitude_deg < 0.0 ? longitude_deg + kTurn_deg : longitude_deg;
}

/// East and north in a site's tangent plane; none for what is behind the Earth.
class TangentPlane {
 public:
  TangentPlane(const sim::Site& site, double height_km)
      : axes_(sim::axes_at(site)), radius_km_(sim::kEarthRadiusKm + height_km) {}

  std::optional<sim::EastNorth> foot(LongitudeLatitude geographic) const {
    const Vector r = unit_vector(geographic);
    const auto along = [&](int axis) {
      return r[0] * axes_.axis[axis][0] + r[1] * axes_.axis[axis][1] + r[2] * axes_.axis[axis][2];
    };
    if (along(2) <= 0.0) return std::nullopt;
    return sim::EastNorth{radius_km_ * along(0), radius_km_ * along(1)};
  }

 private:
  sim::SiteAxes axes_;
  double radius_km_;
};

std::vector<double> steps_between(double least, double most, double step) {
  std::vector<double> values;
  const double first = std::floor(least / step), last = std::ceil(most / step);
  for (double i = first; i <= last; ++i) values.push_back(i * step);
  return values;
}

/// The mean of errors by their weights. An error that was not computed is unknown, and so is the mean where
/// that is so of more than half of the weight.
class KnownMean {
 public:
  void add(double weight, double error) {
    all_ += weight;
    if (!std::isfinite(error)) return;
    known_ += weight;
    sum_ += weight * error;
  }
  double mean() const { return known_ > 0.0 && 2.0 * known_ >= all_ ? sum_ / known_ : sim::kNaN; }

 private:
  double all_ = 0.0, known_ = 0.0, sum_ = 0.0;
};

/// A cell's own mean over points in it.
class CellMean {
 public:
  void add(const PrecipitationPlanes& map, std::size_t at) {
    const double q = map.energy_flux_mw_m2[at];
    if (!std::isfinite(q)) return;
    ++constrained_;
    flux_ += q;
    const double energy = map.energy_kev[at];
    if (!(q > 0.0) || !std::isfinite(energy)) return;
    weight_ += q;
    ln_energy_ += q * std::log(energy);
    flux_error_.add(q, map.relative_flux_error[at]);
    energy_error_.add(q, map.ln_energy_error[at]);
  }

  void put(int points, GeographicMap& map) const {
    const bool is_constrained = 2 * constrained_ >= points, has_energy = is_constrained && weight_ > 0.0;
    map.energy_flux_mw_m2.push_back(is_constrained ? flux_ / constrained_ : sim::kNaN);
    map.energy_kev.push_back(has_energy ? std::exp(ln_energy_ / weight_) : sim::kNaN);
    map.relative_flux_error.push_back(has_energy ? flux_error_.mean() : sim::kNaN);
    map.ln_energy_error.push_back(has_energy ? energy_error_.mean() : sim::kNaN);
  }

 private:
  int constrained_ = 0;
  double flux_ = 0.0, weight_ = 0.0, ln_energy_ = 0.0;
  KnownMean flux_error_, energy_error_;
};

}  // namespace

LongitudeLatitude in_frame(EarthFrame frame, LongitudeLatitude geographic) {
  if (frame == EarthFrame::geographic)
    return {sim::wrapped_longitude_deg(geographic.longitude_deg), geographic.latitude_deg};
  const Vector r = unit_vector(geographic);
  const std::array<Vector, 3> axes = dipole_axes();
  const LongitudeLatitude place =
      place_of({scalar_product(r, axes[0]), scalar_product(r, axes[1]), scalar_product(r, axes[2])});
  return {from_zero(place.longitude_deg), place.latitude_deg};
}

LongitudeLatitude geographic_of(EarthFrame frame, LongitudeLatitude place) {
  if (frame == EarthFrame::geographic)
    return {sim::wrapped_longitude_deg(place.longitude_deg), place.latitude_deg};
  const Vector m = unit_vector(place);
  const std::array<Vector, 3> axes = dipole_axes();
  Vector r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) r[i] += m[k] * axes[k][i];
  return place_of(r);
}

GeographicGrid grid_over(const std::vector<PrecipitationPlanes>& maps, EarthFrame frame, double step_deg) {
  double west = std::numeric_limits<double>::infinity(), east = -west, south = west, north = -west;
  double about_deg = sim::kNaN;  // longitudes are those nearest to the first map's site
  for (const PrecipitationPlanes& map : maps) {
    sim::Scene scene;
    scene.site = map.site;
    for (int row = 0; row < map.rows; ++row)
      for (int column = 0; column < map.columns; ++column) {
        if (!std::isfinite(map.energy_flux_mw_m2[static_cast<std::size_t>(row) * map.columns + column]))
          continue;
        const sim::PlaceOnEarth foot =
            sim::place_of_foot(scene, {map.west_km + column * map.step_km, map.south_km + row * map.step_km});
        if (!std::isfinite(foot.latitude_deg)) continue;
        LongitudeLatitude place = in_frame(frame, {foot.longitude_deg, foot.latitude_deg});
        if (std::isnan(about_deg)) about_deg = place.longitude_deg;
        place.longitude_deg += kTurn_deg * std::round((about_deg - place.longitude_deg) / kTurn_deg);
        west = std::min(west, place.longitude_deg);
        east = std::max(east, place.longitude_deg);
        south = std::min(south, place.latitude_deg);
        north = std::max(north, place.latitude_deg);
      }
  }
  if (!(west <= east))
    throw sim::Error(sim::ErrorKind::usage, "the maps have no valid cell")
        .key("MAP")
        .expected("a map with light in it");
  // Cells about square in the middle, and no pole inside of one.
  const double middle = std::min(std::abs(0.5 * (south + north)), 85.0) * sim::kRadiansPerDegree;
  const double longitude_step = step_deg / std::cos(middle);
  const double cells = ((north - south) / step_deg + 2.0) * ((east - west) / longitude_step + 2.0);
  if (!(cells <= kMaxGridCells))
    throw sim::Error(sim::ErrorKind::usage, "the grid would have more than 4194304 cells")
        .key("--step-deg")
        .expected("a larger step");
  if (!(north - south >= step_deg && east - west >= longitude_step))
    throw sim::Error(sim::ErrorKind::usage, "the map is smaller than a step")
        .key("--step-deg")
        .expected("a smaller step");
  GeographicGrid grid{frame, steps_between(west, east, longitude_step),
                      steps_between(south, north, step_deg)};
  // A map over a pole: each longitude once, and no centre of a cell beyond the pole.
  if (grid.longitude_deg.size() * longitude_step > kTurn_deg) {
    const double columns = std::floor(kTurn_deg / longitude_step), step = kTurn_deg / columns,
                 first = frame == EarthFrame::geographic ? -kHalfTurn_deg : 0.0;
    grid.longitude_deg.clear();
    for (double i = 0; i < columns; ++i) grid.longitude_deg.push_back(first + i * step);
  }
  auto& latitudes = grid.latitude_deg;
  latitudes.erase(std::remove_if(latitudes.begin(), latitudes.end(),
                                 [](double latitude) { return std::abs(latitude) > 90.0; }),
                  latitudes.end());
  return grid;
}

GeographicMap on_grid(const PrecipitationPlanes& map, const GeographicGrid& grid) {
  const double latitude_step = grid.latitude_deg[1] - grid.latitude_deg[0],
               longitude_step = grid.longitude_deg[1] - grid.longitude_deg[0];
  // Points half a step of the map apart.
  const double cell_km = (sim::kEarthRadiusKm + map.height_km) * latitude_step * sim::kRadiansPerDegree;
  const int points = std::clamp(static_cast<int>(std::ceil(2.0 * cell_km / map.step_km)), 1, 64);
  const TangentPlane plane(map.site, map.height_km);
  GeographicMap made;
  for (const double latitude : grid.latitude_deg)
    for (const double longitude : grid.longitude_deg) {
      CellMean mean;
      for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j) {
          const auto foot = plane.foot(geographic_of(
              grid.frame, {longitude + ((i + 0.5) / points - 0.5) * longitude_step,
                           std::clamp(latitude + ((j + 0.5) / points - 0.5) * latitude_step, -90.0, 90.0)}));
          if (!foot) continue;
          const double column = std::round((foot->east - map.west_km) / map.step_km),
                       row = std::round((foot->north - map.south_km) / map.step_km);
          if (column < 0.0 || row < 0.0 || column >= map.columns || row >= map.rows) continue;
          mean.add(map, static_cast<std::size_t>(row) * map.columns + static_cast<std::size_t>(column));
        }
      mean.put(points * points, made);
    }
  return made;
}

}  // namespace vegard::fit
