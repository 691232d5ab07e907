#include "sim/view/sky/moon_disc.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/vec3.h"
#include "sim/base/parallel.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/moon.h"
#include "sim/view/sky/planets.h"
#include "sim/view/sky/sky_of_scene.h"
#include "sim/view/sky/star_photometry.h"

namespace vegard::sim {
namespace {

constexpr double kMoonOverEarth = 0.272481;   // radii
constexpr double kMeanParallax_deg = 0.9507;  // at which magnitude_of_moon() holds
constexpr double kMoonColourIndex = 0.92;

/// The sum of moon_spot() over the disc, in units of the radius squared.
double sum_over_disc(double phase_angle_deg) {
  constexpr int kSteps = 400;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      sum += moon_spot((2.0 * i + 1.0) / kSteps - 1.0, (2.0 * j + 1.0) / kSteps - 1.0, phase_angle_deg);
  return sum * 4.0 / (kSteps * kSteps);
}

/// The Moon at one instant.
struct MoonInSky {
  Vec3<double> towards, to_sun, across;  ///< the last two span the disc
  double radius = 0.0;                   ///< of the disc, radians
  double phase_angle_deg = 0.0;
  std::array<double, 3> radiance{};  ///< linear RGB of moon_spot() = 1
};

MoonInSky moon_in_sky(const Scene& scene, double instant_s) {
  const double date = julian_date_at(scene, instant_s);
  const Observer observer = observer_of(scene);
  Observer without_air = observer;
  without_air.refracting_air = false;
  MoonInSky moon;
  const std::array<double, 3> seen = seen_through_air(direction_of_moon(observer, date), observer),
                              sun = direction_of_star({place_of_sun(date), 0.0, 0.0}, without_air, date);
  moon.towards = {seen[0], seen[1], seen[2]};
  const double along = dot3(moon.towards, {sun[0], sun[1], sun[2]});
  for (int i = 0; i < 3; ++i) moon.to_sun[i] = sun[i] - along * moon.towards[i];
  const double length = std::sqrt(dot3(moon.to_sun, moon.to_sun));
  for (double& component : moon.to_sun) component /= length;
  moon.across = cross3(moon.towards, moon.to_sun);
  const double parallax_deg = place_of_moon(date).parallax_deg;
  moon.radius = kMoonOverEarth * parallax_deg * kRadiansPerDegree;
  moon.phase_angle_deg = phase_angle_of_moon_deg(date);
  const double nearer = parallax_deg / kMeanParallax_deg;
  const double photons = star_photons_cm2_s(magnitude_of_moon(moon.phase_angle_deg)) * nearer * nearer;
  const double scale = luminance_per_photon(scene) * photons /
                       (moon.radius * moon.radius * std::max(1e-9, sum_over_disc(moon.phase_angle_deg)));
  const std::array<double, 3> tint = star_tint(kMoonColourIndex, SensorResponse(scene)),
                              let_through = StarExtinction(scene).towards(seen[2]);
  for (int c = 0; c < 3; ++c) moon.radiance[c] = scale * tint[c] * let_through[c];
  return moon;
}

}  // namespace

double moon_spot(double u, double v, double phase_angle_deg) {
  const double rest = 1.0 - u * u - v * v;
  if (!(rest > 0.0)) return 0.0;
  const double towards_us = std::sqrt(rest), phase = phase_angle_deg * kRadiansPerDegree;
  const double towards_sun = u * std::sin(phase) + towards_us * std::cos(phase);
  return towards_sun > 0.0 ? towards_sun / (towards_sun + towards_us) : 0.0;
}

void add_moon_disc(const Scene& scene, const std::vector<double>& instants_s, int threads, Image& light) {
  const CameraView<double> view = camera_view(scene.camera);
  const double lowest = sine_of_horizon(std::max(0.0, scene.site.altitude_m) * 1e-3);
  std::vector<MoonInSky> moons;
  for (const double instant : instants_s) {
    moons.push_back(moon_in_sky(scene, instant));
    if (moons.back().towards[2] < lowest) moons.pop_back();
  }
  if (moons.empty()) return;
  const double of_each = 1.0 / static_cast<double>(instants_s.size());
  // As many spots of a pixel as there are some thirty across the disc, and one at least for every pixel of a
  // large one.
  const double disc_px = 2.0 * moons.front().radius / kRadiansPerDegree * pixels_per_degree(scene.camera);
  const int fine = std::clamp(static_cast<int>(std::ceil(32.0 / disc_px)), 3, 32);
  parallel_for(static_cast<std::size_t>(light.height), threads, [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < light.width; ++x) {
      double enu[3], corner[3];
      if (!enu_of_pixel(view, x + 0.5, y + 0.5, enu)) continue;
      for (const MoonInSky& moon : moons) {
        const auto from = [&](const double* to) {
          return std::hypot(to[0] - moon.towards[0], to[1] - moon.towards[1], to[2] - moon.towards[2]);
        };
        if (from(enu) > 0.5) continue;
        const double size = enu_of_pixel(view, x, y, corner)
                                ? std::hypot(corner[0] - enu[0], corner[1] - enu[1], corner[2] - enu[2])
                                : moon.radius;
        if (from(enu) > moon.radius + 2.0 * size) continue;
        double sum = 0.0;
        for (int i = 0; i < fine * fine; ++i) {
          double spot[3];
          if (!enu_of_pixel(view, x + (i % fine + 0.5) / fine, y + (i / fine + 0.5) / fine, spot)) continue;
          const Vec3<double> direction = {spot[0], spot[1], spot[2]};
          if (direction[2] < lowest || dot3(direction, moon.towards) <= 0.0) continue;
          sum += moon_spot(dot3(direction, moon.to_sun) / moon.radius,
                           dot3(direction, moon.across) / moon.radius, moon.phase_angle_deg);
        }
        for (int c = 0; c < 3; ++c)
          light.at(x, y, c) += static_cast<float>(of_each * sum / (fine * fine) * moon.radiance[c]);
      }
    }
  });
}

}  // namespace vegard::sim
