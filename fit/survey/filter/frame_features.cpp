#include "fit/survey/filter/frame_features.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/base/utc_time.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/moon.h"
#include "sim/view/sky/planets.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace {

constexpr double kLowestSky_deg = 5.0;
constexpr int kMeridianBins = 40;

using SkyDirection = std::array<double, 3>;

double cosine_between(const SkyDirection& a, const SkyDirection& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns each cell's angle along the magnetic meridian, in degrees from the magnetic northern horizon.
std::vector<double> meridian_angles(const FilterCells& cells, double declination_deg) {
  const double east = std::sin(declination_deg * sim::kRadiansPerDegree),
               north = std::cos(declination_deg * sim::kRadiansPerDegree);
  std::vector<double> angles(cells.sky.size(), 0.0);
  for (std::size_t i = 0; i < angles.size(); ++i)
    angles[i] = std::atan2(cells.enu[i][2], cells.enu[i][0] * east + cells.enu[i][1] * north) /
                sim::kRadiansPerDegree;
  return angles;
}

double banded_share(const CellLight& light, const std::vector<double>& angles) {
  double low = 180.0, high = 0.0, all = 0.0;
  for (const std::size_t i : light.sky) {
    low = std::min(low, angles[i]);
    high = std::max(high, angles[i]);
    all += light.residual[i] * light.residual[i];
  }
  if (!(all > 0.0) || !(high > low)) return 0.0;
  std::array<double, kMeridianBins> sum{}, count{};
  for (const std::size_t i : light.sky) {
    const auto bin = std::min<std::size_t>(
        kMeridianBins - 1, static_cast<std::size_t>((angles[i] - low) / (high - low) * kMeridianBins));
    sum[bin] += light.residual[i];
    count[bin] += 1.0;
  }
  double explained = 0.0;
  for (std::size_t bin = 0; bin < sum.size(); ++bin)
    if (count[bin] > 0.0) explained += sum[bin] * sum[bin] / count[bin];
  return explained / all;
}

/// How much more of the residual's gradients lies across arcs than along them.
double crosswise_share(const FilterCells& cells, const CellLight& light, const std::vector<double>& angles) {
  const auto w = static_cast<std::size_t>(cells.columns);
  const std::vector<CellGradient> gradients = residual_gradients(cells, light);
  double across = 0.0, along = 0.0;
  for (const CellGradient& g : gradients) {
    const double nx = angles[g.cell + 1] - angles[g.cell - 1], ny = angles[g.cell + w] - angles[g.cell - w];
    const double length = std::hypot(nx, ny);
    if (!(length > 0.0)) continue;
    const double one = (g.x * nx + g.y * ny) / length, other = (g.y * nx - g.x * ny) / length;
    across += one * one;
    along += other * other;
  }
  return across + along > 0.0 ? (across - along) / (across + along) : 0.0;
}

/// Adds the features of blobs, that at the Moon's place and the others.
void add_blobs(const FilterCells& cells, const CellLight& light, const SkyDirection& moon,
               SkyFeatures& features) {
  constexpr double kOfMoon_deg = 6.0;  // its halo's, and the error of its place
  const double moon_cosine = std::cos(kOfMoon_deg * sim::kRadiansPerDegree);
  double at_moon = 0.0, elsewhere = 0.0;
  for (const std::size_t i : light.sky) {
    const std::optional<double> peak = peak_above_ring(cells, light, i);
    if (!peak) continue;
    const bool is_moon = moon[2] > 0.0 && cosine_between(cells.enu[i], moon) > moon_cosine;
    double& brightest = is_moon ? at_moon : elsewhere;
    brightest = std::max(brightest, *peak);
  }
  feature(features, SkyFeature::moon_peak) = at_moon;
  feature(features, SkyFeature::lamp_peak) = elsewhere;
}

/// Returns the slope of log10 brightness against the cosine of the angle to the horizon under the Sun.
double sunward_slope(const FilterCells& cells, const CellLight& light, const SkyDirection& sun) {
  const double level = std::max(std::hypot(sun[0], sun[1]), 1e-9);
  double n = 0.0, s = 0.0, ss = 0.0, v = 0.0, sv = 0.0;
  for (const std::size_t i : light.sky) {
    const double q = (cells.enu[i][0] * sun[0] + cells.enu[i][1] * sun[1]) / level;
    n += 1.0;
    s += q;
    ss += q * q;
    v += light.log_grey[i];
    sv += q * light.log_grey[i];
  }
  const double spread = ss - s * s / n;
  return spread > 0.0 ? (sv - s * v / n) / spread : 0.0;
}

}  // namespace

FilterCells filter_cells(const sim::Scene& scene, const std::vector<std::uint8_t>& is_kept) {
  const sim::Camera& camera = scene.camera;
  FilterCells cells{cells_of(camera.width, camera.height), {}};
  const std::size_t count = cells.sky.size();
  cells.enu.assign(count, {0.0, 0.0, 1.0});
  const sim::CameraView<double> view = sim::camera_view(camera);
  const double lowest = std::sin(kLowestSky_deg * sim::kRadiansPerDegree);
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const int x0 = static_cast<int>(i % cells.columns) * cells.size_px,
              y0 = static_cast<int>(i / cells.columns) * cells.size_px;
    double enu[3];
    if (!sim::enu_of_pixel(view, x0 + 0.5 * cells.size_px, y0 + 0.5 * cells.size_px, enu) || enu[2] < lowest)
      continue;
    cells.enu[i] = {enu[0], enu[1], enu[2]};
    if (!is_cell_kept(cells, i, camera.width, is_kept)) continue;
    cells.sky[i] = 1;
    any = true;
  }
  if (!any) throw sim::unreadable(scene.file, "the camera sees no sky above 5 degrees that its mask leaves");
  return cells;
}

SkyFeatures frame_features(const Photo& photo, const sim::Scene& scene, const FilterCells& cells,
                           double utc_s) {
  if (photo.linear.width != scene.camera.width || photo.linear.height != scene.camera.height)
    throw sim::unreadable(photo.file_name,
                          "is of " + sim::size_text(photo.linear.width, photo.linear.height) + " pixels")
        .expected(sim::size_text(scene.camera.width, scene.camera.height) + ", the camera's");
  SkyFeatures features = sky_features(photo, cells);
  constexpr double kUnixEpoch = 2440587.5, kSecondsPerDay = 86400.0;
  const double date = kUnixEpoch + utc_s / kSecondsPerDay;
  sim::Observer observer;
  observer.latitude_deg = scene.site.latitude_deg;
  observer.longitude_deg = scene.site.longitude_deg;
  observer.refracting_air = false;
  const SkyDirection sun = sim::direction_of_star({sim::place_of_sun(date), 0.0, 0.0}, observer, date);
  const SkyDirection moon = sim::direction_of_moon(observer, date);
  const auto elevation = [](const SkyDirection& enu) {
    return std::asin(std::clamp(enu[2], -1.0, 1.0)) / sim::kRadiansPerDegree;
  };
  feature(features, SkyFeature::sun_elevation) = elevation(sun);
  feature(features, SkyFeature::moon_elevation) = elevation(moon);
  feature(features, SkyFeature::moon_light) = moon[2] > 0.0 ? sim::lit_share_of_moon(date) : 0.0;

  const CellLight light = sky_light(photo, cells);
  const std::vector<double> angles = meridian_angles(cells, scene.field.declination_deg);
  feature(features, SkyFeature::banded) = banded_share(light, angles);
  feature(features, SkyFeature::crosswise) = crosswise_share(cells, light, angles);
  add_blobs(cells, light, moon, features);
  feature(features, SkyFeature::sunward) = sunward_slope(cells, light, sun);
  return features;
}

}  // namespace vegard::fit
