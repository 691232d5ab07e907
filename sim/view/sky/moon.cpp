#include "sim/view/sky/moon.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/vec3.h"
#include "sim/base/parallel.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/planets.h"
#include "sim/view/sky/sky_of_scene.h"
#include "sim/view/sky/star_photometry.h"
#include "sim/view/sky/star_place.h"

namespace vegard::sim {
namespace {

/// Returns the sine of an angle in degrees that has turned many times.
double sin_deg(double degrees) { return std::sin(std::remainder(degrees, 360.0) * kRadiansPerDegree); }
double cos_deg(double degrees) { return std::cos(std::remainder(degrees, 360.0) * kRadiansPerDegree); }

/// A term of the Moon's series: a multiple of each argument, and millionths of a degree, or metres.
struct MoonTerm {
  int elongation, sun, moon, node;
  double size;
};

constexpr MoonTerm kMoonLongitude[] = {
    {0, 0, 1, 0, 6288774.0}, {2, 0, -1, 0, 1274027.0}, {2, 0, 0, 0, 658314.0},  {0, 0, 2, 0, 213618.0},
    {0, 1, 0, 0, -185116.0}, {0, 0, 0, 2, -114332.0},  {2, 0, -2, 0, 58793.0},  {2, -1, -1, 0, 57066.0},
    {2, 0, 1, 0, 53322.0},   {2, -1, 0, 0, 45758.0},   {0, 1, -1, 0, -40923.0}, {1, 0, 0, 0, -34720.0},
    {0, 1, 1, 0, -30383.0},  {2, 0, 0, -2, 15327.0},   {0, 0, 1, 2, -12528.0},  {0, 0, 1, -2, 10980.0},
    {4, 0, -1, 0, 10675.0},  {0, 0, 3, 0, 10034.0},    {4, 0, -2, 0, 8548.0},   {2, 1, -1, 0, -7888.0},
    {2, 1, 0, 0, -6766.0},   {1, 0, -1, 0, -5163.0},   {1, 1, 0, 0, 4987.0},    {2, -1, 1, 0, 4036.0},
    {2, 0, 2, 0, 3994.0},    {4, 0, 0, 0, 3861.0},     {2, 0, -3, 0, 3665.0}};

constexpr MoonTerm kMoonLatitude[] = {
    {0, 0, 0, 1, 5128122.0}, {0, 0, 1, 1, 280602.0},  {0, 0, 1, -1, 277693.0}, {2, 0, 0, -1, 173237.0},
    {2, 0, -1, 1, 55413.0},  {2, 0, -1, -1, 46271.0}, {2, 0, 0, 1, 32573.0},   {0, 0, 2, 1, 17198.0},
    {2, 0, 1, -1, 9266.0},   {0, 0, 2, -1, 8822.0},   {2, -1, 0, -1, 8216.0},  {2, 0, -2, -1, 4324.0},
    {2, 0, 1, 1, 4200.0},    {2, 1, 0, -1, -3359.0},  {2, -1, -1, 1, 2463.0},  {2, -1, 0, 1, 2211.0},
    {2, -1, -1, -1, 2065.0}};

constexpr MoonTerm kMoonDistance[] = {
    {0, 0, 1, 0, -20905355.0}, {2, 0, -1, 0, -3699111.0}, {2, 0, 0, 0, -2955968.0}, {0, 0, 2, 0, -569925.0},
    {2, 0, -2, 0, 246158.0},   {2, -1, 0, 0, -204586.0},  {2, 0, 1, 0, -170733.0},  {2, -1, -1, 0, -152138.0},
    {0, 1, -1, 0, -129620.0},  {1, 0, 0, 0, 108743.0},    {0, 1, 1, 0, 104755.0},   {0, 0, 1, -2, 79661.0},
    {0, 1, 0, 0, 48888.0}};

/// Returns the Sun's place, equinox of date.
Equatorial sun_of_date(double julian_date) {
  return apparent_place({place_of_sun(julian_date), 0.0, 0.0}, julian_date);
}

constexpr double kMoonOverEarth = 0.272481;   // radii
constexpr double kMeanParallax_deg = 0.9507;  // at which magnitude_of_moon() holds
constexpr double kMoonColourIndex = 0.92;

/// Returns the sum of moon_spot() over the disc, in units of the radius squared.
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

MoonPlace place_of_moon(double julian_date) {
  const double t = (julian_date - kJ2000) / kDaysPerCentury;
  const double mean_longitude = 218.3164477 + t * (481267.88123421 - 0.0015786 * t);
  const double elongation = 297.8501921 + t * (445267.1114034 - 0.0018819 * t);
  const double sun_anomaly = 357.5291092 + t * (35999.0502909 - 0.0001536 * t);
  const double anomaly = 134.9633964 + t * (477198.8675055 + 0.0087414 * t);
  const double from_node = 93.2720950 + t * (483202.0175233 - 0.0036539 * t);
  const double orbit = 1.0 - t * (0.002516 + 0.0000074 * t);  // the Earth's eccentricity over that of J2000
  const double venus = 119.75 + 131.849 * t, jupiter = 53.09 + 479264.290 * t;
  const auto sum_of = [&](const auto& terms, const auto& function) {
    double sum = 0.0;
    for (const MoonTerm& term : terms) {
      const double angle =
          term.elongation * elongation + term.sun * sun_anomaly + term.moon * anomaly + term.node * from_node;
      sum += term.size * std::pow(orbit, std::abs(term.sun)) * function(angle);
    }
    return sum;
  };
  MoonPlace moon;
  const double longitude =
      mean_longitude + 1e-6 * (sum_of(kMoonLongitude, sin_deg) + 3958.0 * sin_deg(venus) +
                               1962.0 * sin_deg(mean_longitude - from_node) + 318.0 * sin_deg(jupiter));
  moon.longitude_deg = longitude - 360.0 * std::floor(longitude / 360.0);
  moon.latitude_deg = 1e-6 * (sum_of(kMoonLatitude, sin_deg) - 2235.0 * sin_deg(mean_longitude));
  constexpr double kMeanDistance_km = 385000.56, kEquator_km = 6378.14;
  moon.parallax_deg =
      std::asin(kEquator_km / (kMeanDistance_km + 1e-3 * sum_of(kMoonDistance, cos_deg))) / kRadiansPerDegree;
  return moon;
}

double magnitude_of_moon(double phase_angle_deg) {
  const double a = std::abs(phase_angle_deg);
  return -12.73 + 0.026 * a + 4e-9 * a * a * a * a;
}

double phase_angle_of_moon_deg(double julian_date) {
  const double separation_from_sun_deg =
      separation_deg(equatorial_place_of_moon(julian_date), sun_of_date(julian_date));
  // The triangle of Sun, Earth and Moon, whose sides are in the Earth's distance from the Sun.
  constexpr double kEquator_au = 6378.14 / 149597870.7;
  const double moon = kEquator_au / sin_deg(place_of_moon(julian_date).parallax_deg);
  return std::atan2(sin_deg(separation_from_sun_deg), moon - cos_deg(separation_from_sun_deg)) /
         kRadiansPerDegree;
}

Equatorial equatorial_place_of_moon(double julian_date) {
  const MoonPlace moon = place_of_moon(julian_date);
  const double t = (julian_date - kJ2000) / kDaysPerCentury;
  const double obliquity_deg = 23.4393 - 0.0130 * t;  // Lieske 1979, its first two terms
  const double x = cos_deg(moon.latitude_deg) * cos_deg(moon.longitude_deg);
  const double y = cos_deg(moon.latitude_deg) * sin_deg(moon.longitude_deg);
  const double z = sin_deg(moon.latitude_deg);
  const double c = cos_deg(obliquity_deg), s = sin_deg(obliquity_deg);
  const double across = c * y - s * z, up = s * y + c * z;
  double right_ascension_deg = std::atan2(across, x) / kRadiansPerDegree;
  if (right_ascension_deg < 0.0) right_ascension_deg += 360.0;
  return {right_ascension_deg, std::atan2(up, std::hypot(x, across)) / kRadiansPerDegree};
}

std::array<double, 3> direction_of_moon(const Observer& observer, double julian_date) {
  const Equatorial place = equatorial_place_of_moon(julian_date);
  const double hour_angle_deg =
      mean_sidereal_time_deg(julian_date) + observer.longitude_deg - place.right_ascension_deg;
  const double declination_deg = place.declination_deg, latitude_deg = observer.latitude_deg;
  const double south_up = cos_deg(declination_deg) * cos_deg(hour_angle_deg);
  std::array<double, 3> enu = {
      -cos_deg(declination_deg) * sin_deg(hour_angle_deg),
      sin_deg(declination_deg) * cos_deg(latitude_deg) - south_up * sin_deg(latitude_deg),
      sin_deg(declination_deg) * sin_deg(latitude_deg) + south_up * cos_deg(latitude_deg)};
  // In units of the Moon's distance the observer stands this far above the Earth's centre.
  enu[2] -= sin_deg(place_of_moon(julian_date).parallax_deg);
  const double length = std::sqrt(enu[0] * enu[0] + enu[1] * enu[1] + enu[2] * enu[2]);
  for (double& component : enu) component /= length;
  return enu;
}

double lit_share_of_moon(double julian_date) {
  const double apart_deg = separation_deg(equatorial_place_of_moon(julian_date), place_of_sun(julian_date));
  return 0.5 * (1.0 - cos_deg(apart_deg));
}

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
  const double instant_share = 1.0 / static_cast<double>(instants_s.size());
  // The Moon is drawn in spots of a pixel, some thirty of them across the disc, and one at least for every
  // pixel of a large one.
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
          light.at(x, y, c) += static_cast<float>(instant_share * sum / (fine * fine) * moon.radiance[c]);
      }
    }
  });
}

}  // namespace vegard::sim
