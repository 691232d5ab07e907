#include "sim/view/sky/milky_way.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/sky_of_scene.h"
#include "sim/view/sky/star_photometry.h"
#include "sim/view/sky/star_place.h"

namespace vegard::sim {
namespace {

// Lengths in kpc.
constexpr double kSun = 8.2, kDiscLength = 2.6, kDiscHeight = 0.30;
constexpr double kDiscBegins = 3.0;  // within, its stars are no denser
constexpr double kDustLength = 3.2, kDustHeight = 0.10, kDustMagPerKpc = 0.7;
constexpr double kBulgeLength = 0.7, kBulgeOverDisc = 7.0;  // of stars at the centre over those near the Sun
constexpr double kPoles_s10 = 30.0;
constexpr double kMilkyWayColourIndex = 0.75;

/// The sum along a line of sight, in units of the stars' density near the Sun.
double light_along(double longitude_deg, double latitude_deg) {
  const double l = longitude_deg * kRadiansPerDegree, b = latitude_deg * kRadiansPerDegree;
  constexpr int kSteps = 240;
  constexpr double kFirst = 0.01, kLast = 30.0;
  const double ratio = std::pow(kLast / kFirst, 1.0 / kSteps);
  double sum = 0.0, depth = 0.0, near = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double far = kFirst * std::pow(ratio, i), step = far - near, middle = 0.5 * (near + far);
    const double level = middle * std::cos(b), height = std::abs(middle * std::sin(b));
    const double from_centre = std::sqrt(kSun * kSun + level * level - 2.0 * kSun * level * std::cos(l));
    const double disc =
        std::exp(-(std::max(from_centre, kDiscBegins) - kSun) / kDiscLength - height / kDiscHeight);
    const double bulge = kBulgeOverDisc * std::exp(-std::hypot(from_centre, height / 0.6) / kBulgeLength);
    const double dust = std::exp(-(from_centre - kSun) / kDustLength - height / kDustHeight);
    const double of_step = dust * kDustMagPerKpc / 1.0857362 * step;
    sum += (disc + bulge) * std::exp(-depth - 0.5 * of_step) * step;
    depth += of_step;
    near = far;
  }
  return sum;
}

/// At even steps of |longitude| and |latitude|.
class MilkyWayTable {
 public:
  MilkyWayTable() : values_(static_cast<std::size_t>(kLongitudes + 1) * (kLatitudes + 1)) {
    const double scale = kPoles_s10 / light_along(0.0, 90.0);
    for (int i = 0; i <= kLongitudes; ++i)
      for (int j = 0; j <= kLatitudes; ++j)
        values_[at(i, j)] = scale * light_along(180.0 * i / kLongitudes, 90.0 * j / kLatitudes);
  }

  double s10(double longitude_deg, double latitude_deg) const {
    const double x = std::abs(std::remainder(longitude_deg, 360.0)) / 180.0 * kLongitudes,
                 y = std::min(std::abs(latitude_deg), 90.0) / 90.0 * kLatitudes;
    const int i = std::min(static_cast<int>(x), kLongitudes - 1),
              j = std::min(static_cast<int>(y), kLatitudes - 1);
    const double u = x - i, v = y - j;
    return (1.0 - v) * ((1.0 - u) * values_[at(i, j)] + u * values_[at(i + 1, j)]) +
           v * ((1.0 - u) * values_[at(i, j + 1)] + u * values_[at(i + 1, j + 1)]);
  }

 private:
  static constexpr int kLongitudes = 90, kLatitudes = 180;
  static std::size_t at(int i, int j) { return static_cast<std::size_t>(i) * (kLatitudes + 1) + j; }
  std::vector<double> values_;
};

const MilkyWayTable& milky_way_table() {
  static const MilkyWayTable table;
  return table;
}

/// The galactic axes at J2000 (the IAU's of 1958, precessed): to the centre, to l = 90 degrees, to the pole.
constexpr std::array<Equatorial, 3> kGalacticAxes = {
    {{266.40499, -28.93617}, {318.00438, 48.32964}, {192.85948, 27.12825}}};

}  // namespace

double milky_way_s10(double longitude_deg, double latitude_deg) {
  return milky_way_table().s10(longitude_deg, latitude_deg);
}

void add_milky_way(const Scene& scene, const std::vector<double>& instants_s, int threads, Image& light) {
  const double date = julian_date_at(scene, 0.5 * (instants_s.front() + instants_s.back()));
  Observer observer = observer_of(scene);
  observer.refracting_air = false;  // half a degree at most, at the horizon
  std::array<std::array<double, 3>, 3> axes{};
  for (int a = 0; a < 3; ++a) axes[a] = direction_of_star({kGalacticAxes[a], 0.0, 0.0}, observer, date);
  constexpr double kSquareDegree = kRadiansPerDegree * kRadiansPerDegree;
  const double of_s10 = luminance_per_photon(scene) * star_photons_cm2_s(10.0) / kSquareDegree;
  const std::array<double, 3> tint = star_tint(kMilkyWayColourIndex, SensorResponse(scene));
  const StarExtinction air(scene);
  const CameraView<double> view = camera_view(scene.camera);
  const double lowest = sine_of_horizon(std::max(0.0, scene.site.altitude_m) * 1e-3);
  const MilkyWayTable& table = milky_way_table();
  parallel_for(static_cast<std::size_t>(light.height), threads, [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < light.width; ++x) {
      double enu[3];
      if (!enu_of_pixel(view, x + 0.5, y + 0.5, enu) || enu[2] < lowest) continue;
      double along[3];
      for (int a = 0; a < 3; ++a) along[a] = enu[0] * axes[a][0] + enu[1] * axes[a][1] + enu[2] * axes[a][2];
      const double s10 = table.s10(std::atan2(along[1], along[0]) / kRadiansPerDegree,
                                   std::atan2(along[2], std::hypot(along[0], along[1])) / kRadiansPerDegree);
      const std::array<double, 3> let_through = air.towards(enu[2]);
      for (int c = 0; c < 3; ++c)
        light.at(x, y, c) += static_cast<float>(of_s10 * s10 * tint[c] * let_through[c]);
    }
  });
}

}  // namespace vegard::sim
