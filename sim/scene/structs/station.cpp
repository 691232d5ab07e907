#include "sim/scene/structs/station.h"

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::sim {
namespace {

using StationDual = Dual<double, Tangents<double, Station::kNumbers>>;

EastNorth mean_of_points(const Sheet& sheet) {
  const double points = static_cast<double>(sheet.east_km.size());
  EastNorth mean{0.0, 0.0};
  for (std::size_t i = 0; i < sheet.east_km.size(); ++i) {
    mean.east += sheet.east_km[i] / points;
    mean.north += sheet.north_km[i] / points;
  }
  return mean;
}

/// atan2(east, north), from north to the east.
double direction_rad(double east, double north) { return std::atan2(east, north); }
StationDual direction_rad(const StationDual& east, const StationDual& north) {
  const double inverse = 1.0 / (east.v * east.v + north.v * north.v);
  return {std::atan2(east.v, north.v), (east.d * north.v - north.d * east.v) * inverse};
}

/// The bearing is the one within half a turn of that at home: a search may have turned it beyond 360.
template <class T>
void carry_numbers(const double (&turn)[3][3], double radius_km, T (&number)[Station::kNumbers]) {
  const T east = number[0], north = number[1], bearing = number[2];
  const T up = square_root(radius_km * radius_km - east * east - north * north);
  const auto turned = [&](const T& e, const T& n, T(&out)[3]) {  // a point of the sphere moves along it
    const T u = -((east * e + north * n) / up);
    for (int i = 0; i < 3; ++i) out[i] = e * turn[i][0] + n * turn[i][1] + u * turn[i][2];
  };
  T along[3], drift[3];
  turned(sine(bearing * kRadiansPerDegree), cosine(bearing * kRadiansPerDegree), along);
  turned(number[5], number[6], drift);
  const T stretch = square_root(along[0] * along[0] + along[1] * along[1]);
  const T there = direction_rad(along[0], along[1]) * (1.0 / kRadiansPerDegree);
  const double turns = 360.0 * std::round((value_of(bearing) - value_of(there)) / 360.0);
  for (int i = 0; i < 2; ++i) number[i] = east * turn[i][0] + north * turn[i][1] + up * turn[i][2];
  number[2] = there + turns;
  number[3] = number[3] * stretch;
  number[4] = number[4] * stretch;
  number[5] = drift[0];
  number[6] = drift[1];
}

}  // namespace

std::array<double*, Station::kNumbers> Station::numbers(Sheet& sheet) {
  return {&sheet.center_km.east, &sheet.center_km.north, &sheet.bearing_deg,     &sheet.length_km,
          &sheet.wavelength_km,  &sheet.drift_km_s.east, &sheet.drift_km_s.north};
}

Station::Station(const Site& home, const Site& there, double sphere_km)
    : elsewhere_(home.latitude_deg != there.latitude_deg || home.longitude_deg != there.longitude_deg),
      foot_radius_km_(sphere_km + kFootAltitudeKm) {
  if (!elsewhere_) return;
  const SiteAxes from = axes_at(home), to = axes_at(there);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      turn_[i][j] = 0.0;
      for (int k = 0; k < 3; ++k) turn_[i][j] += to.axis[i][k] * from.axis[j][k];
    }
}

EastNorth Station::carry(EastNorth foot_km) const {
  const double up = std::sqrt(foot_radius_km_ * foot_radius_km_ - foot_km.east * foot_km.east -
                              foot_km.north * foot_km.north);
  const auto part = [&](int i) {
    return foot_km.east * turn_[i][0] + foot_km.north * turn_[i][1] + up * turn_[i][2];
  };
  return {part(0), part(1)};
}

std::array<double, 4> Station::slopes(EastNorth foot_km) const {
  const double up = std::sqrt(foot_radius_km_ * foot_radius_km_ - foot_km.east * foot_km.east -
                              foot_km.north * foot_km.north);
  std::array<double, 4> slopes;
  for (int i = 0; i < 2; ++i) {
    slopes[2 * i] = turn_[i][0] - turn_[i][2] * foot_km.east / up;
    slopes[2 * i + 1] = turn_[i][1] - turn_[i][2] * foot_km.north / up;
  }
  return slopes;
}

EastNorth Station::drift_of_curve(const Sheet& at_home) const {
  const std::array<double, 4> turned = slopes(mean_of_points(at_home));
  const EastNorth& drift = at_home.drift_km_s;
  return {turned[0] * drift.east + turned[1] * drift.north, turned[2] * drift.east + turned[3] * drift.north};
}

std::array<double, 4> Station::drift_slopes(const Sheet& at_home) const {
  const EastNorth at = mean_of_points(at_home);
  const EastNorth& drift = at_home.drift_km_s;
  const double up = std::sqrt(foot_radius_km_ * foot_radius_km_ - at.east * at.east - at.north * at.north);
  const double out = (at.east * drift.east + at.north * drift.north) / (up * up);
  std::array<double, 4> slopes;
  for (int i = 0; i < 2; ++i) {
    slopes[2 * i] = -turn_[i][2] * (drift.east + out * at.east) / up;
    slopes[2 * i + 1] = -turn_[i][2] * (drift.north + out * at.north) / up;
  }
  return slopes;
}

void Station::carry(Sheet& sheet) const {
  if (!elsewhere_) return;
  if (sheet.course == SheetCourse::curve) {
    sheet.drift_km_s = drift_of_curve(sheet);
    for (std::size_t i = 0; i < sheet.east_km.size(); ++i) {
      const EastNorth there = carry(EastNorth{sheet.east_km[i], sheet.north_km[i]});
      sheet.east_km[i] = there.east;
      sheet.north_km[i] = there.north;
    }
    return;
  }
  const std::array<double*, kNumbers> places = numbers(sheet);
  double number[kNumbers];
  for (int i = 0; i < kNumbers; ++i) number[i] = *places[i];
  carry_numbers(turn_, foot_radius_km_, number);
  for (int i = 0; i < kNumbers; ++i) *places[i] = number[i];
}

std::array<double, Station::kNumbers * Station::kNumbers> Station::slopes(const Sheet& at_home) const {
  Sheet sheet = at_home;
  const std::array<double*, kNumbers> places = numbers(sheet);
  StationDual number[kNumbers];
  for (int i = 0; i < kNumbers; ++i) {
    number[i] = StationDual(*places[i]);
    number[i].d.t[i] = 1.0;
  }
  carry_numbers(turn_, foot_radius_km_, number);
  std::array<double, kNumbers * kNumbers> slopes;
  for (int i = 0; i < kNumbers; ++i)
    for (int j = 0; j < kNumbers; ++j) slopes[i * kNumbers + j] = number[i].d.t[j];
  return slopes;
}

}  // namespace vegard::sim
