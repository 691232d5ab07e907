// A sheet seen from two sites against plain geometry in the Earth's own coordinates, which shares nothing
// with the code but the radius.
#include "sim/scene/structs/station.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace vegard::sim::station_test {
namespace {

constexpr double kDegree = 0.017453292519943295;
using Point = std::array<double, 3>;

/// A foot's place from the Earth's centre, by rotating the site's own frame about the Earth's axes.
Point foot_in_space(const Site& site, double east, double north) {
  const double up = std::sqrt(6481.0 * 6481.0 - east * east - north * north);
  const double lat = site.latitude_deg * kDegree, lon = site.longitude_deg * kDegree;
  // Up and north span the meridian's plane; x there points away from the axis.
  const double x = up * std::cos(lat) - north * std::sin(lat), z = up * std::sin(lat) + north * std::cos(lat);
  return {x * std::cos(lon) - east * std::sin(lon), x * std::sin(lon) + east * std::cos(lon), z};
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// Of a sheet's straight line, `share` of its length from its centre.
Point point_of_line(const Site& site, const Sheet& sheet, double share) {
  const double t = share * sheet.length_km, bearing = sheet.bearing_deg * kDegree;
  return foot_in_space(site, sheet.center_km.east + t * std::sin(bearing),
                       sheet.center_km.north + t * std::cos(bearing));
}

Sheet some_sheet() {
  Sheet sheet;
  sheet.center_km = {25.0, 180.0};
  sheet.bearing_deg = 97.0;
  sheet.length_km = 400.0;
  sheet.wavelength_km = 60.0;
  sheet.drift_km_s = {0.3, -0.8};
  return sheet;
}

Site site(double latitude_deg, double longitude_deg) {
  Site s;
  s.latitude_deg = latitude_deg;
  s.longitude_deg = longitude_deg;
  return s;
}

TEST(Station, TheSheetIsAtTheSamePlaceInSpace) {
  const Site home = site(69.0, 19.0);
  const double north_100_km = 100.0 / 6371.0 / kDegree;
  for (const Site& there : {site(69.0 - north_100_km, 19.0), site(69.0, 21.5), site(70.0, 18.0)}) {
    const Sheet sheet = some_sheet();
    Sheet carried = sheet;
    Station(home, there).carry(carried);
    EXPECT_LT(distance(point_of_line(home, sheet, 0.0), point_of_line(there, carried, 0.0)), 1e-6);
    for (const double share : {-0.25, 0.25})  // 100 km to either side
      EXPECT_LT(distance(point_of_line(home, sheet, share), point_of_line(there, carried, share)), 0.02);
    for (const double share : {-0.5, 0.5})
      EXPECT_LT(distance(point_of_line(home, sheet, share), point_of_line(there, carried, share)), 0.08);
  }
}

TEST(Station, TheStraightLineIsBentByWhatTheHeaderSays) {
  const Site home = site(69.0, 19.0), there = site(69.0 - 100.0 / 6371.0 / kDegree, 19.0);
  Sheet sheet = some_sheet();
  sheet.center_km = {0.0, 180.0};
  sheet.bearing_deg = 90.0;
  Sheet carried = sheet;
  Station(home, there).carry(carried);
  const double bent = distance(point_of_line(home, sheet, 0.5), point_of_line(there, carried, 0.5));
  EXPECT_NEAR(bent, 100.0 * 200.0 * 200.0 / (2.0 * 6371.0 * 6481.0), 0.003);
}

TEST(Station, ThereAndBackIsTheSameSheet) {
  const Site home = site(69.0, 179.6), there = site(68.2, -179.7);  // across the date line
  const Sheet sheet = some_sheet();
  Sheet carried = sheet;
  Station(home, there).carry(carried);
  EXPECT_GT(std::abs(carried.center_km.east - sheet.center_km.east), 10.0);
  Station(there, home).carry(carried);
  const auto before = Station::numbers(const_cast<Sheet&>(sheet)), after = Station::numbers(carried);
  for (int i = 0; i < Station::kNumbers; ++i) EXPECT_NEAR(*after[i], *before[i], 1e-9) << i;
}

TEST(Station, DriftIsTheCentresVelocity) {
  const Site home = site(65.0, 0.0), there = site(66.0, 1.0);
  Sheet now = some_sheet(), later = now;
  later.center_km.east += 1e-3 * now.drift_km_s.east;
  later.center_km.north += 1e-3 * now.drift_km_s.north;
  const Station station(home, there);
  station.carry(now);
  station.carry(later);
  EXPECT_NEAR((later.center_km.east - now.center_km.east) / 1e-3, now.drift_km_s.east, 1e-5);
  EXPECT_NEAR((later.center_km.north - now.center_km.north) / 1e-3, now.drift_km_s.north, 1e-5);
}

TEST(Station, SlopesAgreeWithDifferences) {
  const Station station(site(69.0, 19.0), site(68.3, 20.5));
  for (const double turns : {0.0, 360.0}) {
    Sheet sheet = some_sheet();
    sheet.bearing_deg += turns;
    const auto slopes = station.slopes(sheet);
    for (int j = 0; j < Station::kNumbers; ++j) {
      constexpr double kStep = 1e-3;
      Sheet more = sheet, less = sheet;
      *Station::numbers(more)[j] += kStep;
      *Station::numbers(less)[j] -= kStep;
      station.carry(more);
      station.carry(less);
      for (int i = 0; i < Station::kNumbers; ++i)
        EXPECT_NEAR(slopes[i * Station::kNumbers + j],
                    (*Station::numbers(more)[i] - *Station::numbers(less)[i]) / (2 * kStep), 1e-8)
            << i << " by " << j;
    }
  }
}

Sheet some_curve() {
  Sheet sheet;
  sheet.course = SheetCourse::curve;
  sheet.east_km = {-150.0, -20.0, 60.0, 300.0};
  sheet.north_km = {180.0, 220.0, 160.0, 250.0};
  sheet.drift_km_s = {0.3, -0.8};
  return sheet;
}

TEST(Station, ThePointsOfACurveAreAtTheSamePlacesInSpace) {
  const Site home = site(69.0, 19.0), there = site(68.3, 21.5);
  const Sheet curve = some_curve();
  Sheet carried = curve;
  Station(home, there).carry(carried);
  for (std::size_t i = 0; i < curve.east_km.size(); ++i) {
    Sheet here = some_sheet(), seen = here;
    here.center_km = {curve.east_km[i], curve.north_km[i]};
    seen.center_km = {carried.east_km[i], carried.north_km[i]};
    EXPECT_LT(distance(point_of_line(home, here, 0.0), point_of_line(there, seen, 0.0)), 1e-9) << i;
  }
}

TEST(Station, SlopesOfACurveAgreeWithDifferences) {
  const Station station(site(69.0, 19.0), site(68.3, 20.5));
  const Sheet curve = some_curve();
  constexpr double kStep = 1e-3;
  for (std::size_t i = 0; i < curve.east_km.size(); ++i) {
    const auto slopes = station.slopes(EastNorth{curve.east_km[i], curve.north_km[i]});
    const auto of_drift = station.drift_slopes(curve);
    for (int axis = 0; axis < 2; ++axis) {
      Sheet more = curve, less = curve;
      (axis == 0 ? more.east_km : more.north_km)[i] += kStep;
      (axis == 0 ? less.east_km : less.north_km)[i] -= kStep;
      station.carry(more);
      station.carry(less);
      EXPECT_NEAR(slopes[axis], (more.east_km[i] - less.east_km[i]) / (2 * kStep), 1e-8);
      EXPECT_NEAR(slopes[2 + axis], (more.north_km[i] - less.north_km[i]) / (2 * kStep), 1e-8);
      const double points = static_cast<double>(curve.east_km.size());
      EXPECT_NEAR(of_drift[axis] / points, (more.drift_km_s.east - less.drift_km_s.east) / (2 * kStep),
                  1e-11);
      EXPECT_NEAR(of_drift[2 + axis] / points, (more.drift_km_s.north - less.drift_km_s.north) / (2 * kStep),
                  1e-11);
    }
  }
}

TEST(Station, TheSamePlaceChangesNothing) {
  const Station station(site(69.0, 19.0), site(69.0, 19.0));
  EXPECT_FALSE(station.is_elsewhere());
  Sheet sheet = some_sheet();
  station.carry(sheet);
  EXPECT_EQ(sheet.center_km.north, some_sheet().center_km.north);
  EXPECT_EQ(sheet.bearing_deg, some_sheet().bearing_deg);
}

}  // namespace
}  // namespace vegard::sim::station_test
