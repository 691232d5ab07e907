#include "sim/view/sky/star_place.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/vec3.h"
#include "sim/base/utc_time.h"

namespace vegard::sim {
namespace {

constexpr double kSecond = kRadiansPerDegree / 3600.0;  // of arc
constexpr double kDaysPerYear = 365.25;

Vec3<double> vector_of(const Equatorial& place) {
  const double a = place.right_ascension_deg * kRadiansPerDegree,
               d = place.declination_deg * kRadiansPerDegree;
  return {std::cos(d) * std::cos(a), std::cos(d) * std::sin(a), std::sin(d)};
}

Equatorial place_of(const Vec3<double>& v) {
  double a = std::atan2(v[1], v[0]) / kRadiansPerDegree;
  if (a < 0.0) a += 360.0;
  return {a, std::atan2(v[2], std::hypot(v[0], v[1])) / kRadiansPerDegree};
}

/// Returns the vector in axes that are turned about the old ones' axis 0, 1 or 2 by an angle, anticlockwise.
Vec3<double> turned(const Vec3<double>& v, int axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  if (axis == 0) return {v[0], c * v[1] + s * v[2], -s * v[1] + c * v[2]};
  if (axis == 1) return {c * v[0] - s * v[2], v[1], s * v[0] + c * v[2]};
  return {c * v[0] + s * v[1], -s * v[0] + c * v[1], v[2]};
}

Vec3<double> moved(const CataloguePlace& star, double julian_date) {
  const double a = star.j2000.right_ascension_deg * kRadiansPerDegree;
  const double d = star.j2000.declination_deg * kRadiansPerDegree;
  const double years = (julian_date - kJ2000) / kDaysPerYear;
  const double east = star.motion_ra_mas_per_year * 1e-3 * kSecond * years;
  const double north = star.motion_dec_mas_per_year * 1e-3 * kSecond * years;
  Vec3<double> v = vector_of(star.j2000);
  // Proper motion goes in a straight line, as the stars do: near the poles an angle a year would not do.
  v[0] += -std::sin(a) * east - std::sin(d) * std::cos(a) * north;
  v[1] += std::cos(a) * east - std::sin(d) * std::sin(a) * north;
  v[2] += std::cos(d) * north;
  return v;
}

Vec3<double> precessed(const Vec3<double>& v, double julian_date) {
  const double t = (julian_date - kJ2000) / kDaysPerCentury;
  const double zeta = t * (2306.2181 + t * (0.30188 + t * 0.017998)) * kSecond;
  const double z = t * (2306.2181 + t * (1.09468 + t * 0.018203)) * kSecond;
  const double theta = t * (2004.3109 - t * (0.42665 + t * 0.041833)) * kSecond;
  return turned(turned(turned(v, 2, -zeta), 1, theta), 2, -z);
}

/// What the sky of an instant depends on, in radians (Meeus, chapters 22 and 25).
struct SkyOfInstant {
  double obliquity, nutation_in_longitude, nutation_in_obliquity, sun_longitude;
};

SkyOfInstant sky_of(double julian_date) {
  const double t = (julian_date - kJ2000) / kDaysPerCentury;
  const double node = (125.04452 - 1934.136261 * t) * kRadiansPerDegree;
  const double sun = (280.46646 + 36000.76983 * t) * kRadiansPerDegree;  // mean longitudes
  const double moon = (218.3165 + 481267.8813 * t) * kRadiansPerDegree;
  const double anomaly = (357.52911 + 35999.05029 * t) * kRadiansPerDegree;
  SkyOfInstant sky;
  sky.nutation_in_longitude = (-17.20 * std::sin(node) - 1.32 * std::sin(2.0 * sun) -
                               0.23 * std::sin(2.0 * moon) + 0.21 * std::sin(2.0 * node)) *
                              kSecond;
  sky.nutation_in_obliquity = (9.20 * std::cos(node) + 0.57 * std::cos(2.0 * sun) +
                               0.10 * std::cos(2.0 * moon) - 0.09 * std::cos(2.0 * node)) *
                              kSecond;
  sky.obliquity = (84381.448 - 46.8150 * t) * kSecond;
  sky.sun_longitude = sun + (1.9146 * std::sin(anomaly) + 0.02 * std::sin(2.0 * anomaly)) * kRadiansPerDegree;
  return sky;
}

Vec3<double> aberrated(const Vec3<double>& v, const SkyOfInstant& sky) {
  constexpr double kAberration = 20.49552 * kSecond;
  const double s = std::sin(sky.sun_longitude), c = std::cos(sky.sun_longitude);
  // The Earth moves at a right angle to the Sun's place.
  return {v[0] + kAberration * s, v[1] - kAberration * c * std::cos(sky.obliquity),
          v[2] - kAberration * c * std::sin(sky.obliquity)};
}

Vec3<double> nutated(const Vec3<double>& v, const SkyOfInstant& sky) {
  const Vec3<double> ecliptic = turned(turned(v, 0, sky.obliquity), 2, -sky.nutation_in_longitude);
  return turned(ecliptic, 0, -(sky.obliquity + sky.nutation_in_obliquity));
}

Vec3<double> apparent(const CataloguePlace& star, double julian_date) {
  const SkyOfInstant sky = sky_of(julian_date);
  return nutated(aberrated(precessed(moved(star, julian_date), julian_date), sky), sky);
}

/// Returns the refraction in the standard atmosphere at this height.
double refraction_at(double true_elevation_deg, double height_m) {
  constexpr double kTropopause_m = 11000.0, kLapse_c_per_m = 0.0065;
  const double low_m = std::clamp(height_m, -500.0, kTropopause_m);
  const double temperature_c = 15.0 - kLapse_c_per_m * low_m;
  double pressure_hpa = 1013.25 * std::pow(1.0 - 2.25577e-5 * low_m, 5.25588);
  if (height_m > kTropopause_m) pressure_hpa *= std::exp(-(height_m - kTropopause_m) / 6341.6);
  return refraction_deg(true_elevation_deg, pressure_hpa, temperature_c);
}

constexpr double kJulianDateOf1970 = 2440587.5;
constexpr double kInstantSecondsPerDay = 86400.0;

}  // namespace

Equatorial mean_place(const CataloguePlace& star, double julian_date) {
  return place_of(precessed(moved(star, julian_date), julian_date));
}

Equatorial apparent_place(const CataloguePlace& star, double julian_date) {
  return place_of(apparent(star, julian_date));
}

double horizon_elevation_deg(const Observer& observer) {
  constexpr double kMountains_m = 9000.0, kMetresPerKm = 1000.0;
  if (!(observer.height_m > kMountains_m)) return 0.0;
  return -std::acos(kEarthRadiusKm / (kEarthRadiusKm + observer.height_m / kMetresPerKm)) / kRadiansPerDegree;
}

std::array<double, 3> direction_of_star(const CataloguePlace& star, const Observer& observer,
                                        double julian_date) {
  const SkyOfInstant sky = sky_of(julian_date);
  const Equatorial place = apparent_place(star, julian_date);
  const double equinoxes_deg = sky.nutation_in_longitude * std::cos(sky.obliquity) / kRadiansPerDegree;
  const double hour_angle = (mean_sidereal_time_deg(julian_date) + equinoxes_deg + observer.longitude_deg -
                             place.right_ascension_deg) *
                            kRadiansPerDegree;
  const double d = place.declination_deg * kRadiansPerDegree, f = observer.latitude_deg * kRadiansPerDegree;
  return seen_through_air({-std::cos(d) * std::sin(hour_angle),
                           std::sin(d) * std::cos(f) - std::cos(d) * std::cos(hour_angle) * std::sin(f),
                           std::sin(d) * std::sin(f) + std::cos(d) * std::cos(hour_angle) * std::cos(f)},
                          observer);
}

std::array<double, 3> seen_through_air(const std::array<double, 3>& enu, const Observer& observer) {
  if (!observer.refracting_air) return enu;
  const double level = std::hypot(enu[0], enu[1]), elevation = std::atan2(enu[2], level);
  const double seen =
      elevation + refraction_at(elevation / kRadiansPerDegree, observer.height_m) * kRadiansPerDegree;
  const double scale = level > 0.0 ? std::cos(seen) / level : 0.0;
  return {enu[0] * scale, enu[1] * scale, std::sin(seen)};
}

double refraction_deg(double true_elevation_deg, double pressure_hpa, double temperature_c) {
  if (true_elevation_deg < -1.0) return 0.0;
  const double angle_deg = true_elevation_deg + 10.3 / (true_elevation_deg + 5.11);
  const double minutes = 1.02 / std::tan(angle_deg * kRadiansPerDegree);
  return std::max(0.0, minutes * pressure_hpa / 1010.0 * 283.0 / (273.0 + temperature_c)) / 60.0;
}

std::optional<double> julian_date(const std::string& utc) {
  const std::optional<double> seconds = utc_seconds(utc);
  if (!seconds) return std::nullopt;
  return kJulianDateOf1970 + *seconds / kInstantSecondsPerDay;
}

std::string text_of_julian_date(double julian_date) {
  return utc_text(std::round((julian_date - kJulianDateOf1970) * kInstantSecondsPerDay));
}

double mean_sidereal_time_deg(double julian_date) {
  const double days = julian_date - kJ2000, t = days / kDaysPerCentury;
  // The whole turns of the days are taken out first: they would cost digits.
  const double turned = 280.46061837 + 360.0 * std::fmod(days, 1.0) + 0.98564736629 * days +
                        t * t * (0.000387933 - t / 38710000.0);
  const double rest = std::fmod(turned, 360.0);
  return rest < 0.0 ? rest + 360.0 : rest;
}

}  // namespace vegard::sim
