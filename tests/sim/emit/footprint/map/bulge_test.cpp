#include "sim/emit/footprint/map/bulge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/emit/footprint/map/make_footprint.h"

namespace vegard::sim::bulge_test {
namespace {

constexpr double kRadius = kEarthRadiusKm + kFootAltitudeKm;

/// An oval along a parallel, drawn to the east or to the west.
Footprint oval(double latitude_deg, double sense) {
  Footprint f;
  f.shape = FootprintShape::shell;
  f.closed = true;
  f.face_cells = 512;
  f.width_km = 30.0;
  f.energy_flux_mw_m2 = 4.0;
  for (int i = 0; i < 24; ++i) {
    f.latitude_deg.push_back(latitude_deg);
    f.longitude_deg.push_back(sense * 15.0 * i);
  }
  f.bulge_km = 400.0;
  f.bulge_longitude_deg = 20.0;
  f.bulge_length_km = 300.0;
  f.bulge_speed_km_s = 1.5;
  f.bulge_gain = 3.0;
  return f;
}

Substorm substorm() {
  Substorm s;
  s.onset_s = 100.0;
  s.expansion_s = 600.0;
  s.recovery_s = 1800.0;
  return s;
}

double flux_at(const CubeFootprint<double>& cube, double latitude_deg, double longitude_deg) {
  const double lat = latitude_deg * kRadiansPerDegree, lon = longitude_deg * kRadiansPerDegree;
  const double d[3] = {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
  int axis = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(d[a]) > std::abs(d[axis])) axis = a;
  const FootprintGrid<double>& grid = cube.face[2 * axis + (d[axis] < 0.0 ? 1 : 0)];
  const auto cell = [&](int a) {
    return static_cast<int>(0.5 * cube.face_cells * (d[a % 3] / std::abs(d[axis]) + 1.0)) + 1;
  };
  return grid.flux_mw_m2[static_cast<std::size_t>(cell(axis + 2)) * grid.columns + cell(axis + 1)];
}

/// How far light reaches towards the pole at a longitude, in degrees of latitude off the oval.
double height_deg(const CubeFootprint<double>& cube, double latitude_deg, double longitude_deg) {
  const double sign = latitude_deg < 0.0 ? -1.0 : 1.0;
  double brightest = 0.0, at = 0.0;
  for (double off = -1.0; off < 6.0; off += 0.05)
    if (const double flux = flux_at(cube, latitude_deg + sign * off, longitude_deg); flux > brightest) {
      brightest = flux;
      at = off;
    }
  return at;
}

/// Degrees of longitude to the west of the beginning at which the bulge is half as high as it gets.
double front_deg(const CubeFootprint<double>& cube, double latitude_deg, double bulge_deg) {
  double front = 0.0;
  for (double west = 0.0; west < 70.0; west += 0.1)
    if (height_deg(cube, latitude_deg, 20.0 - west) > 0.5 * bulge_deg) front = west;
  return front;
}

TEST(Bulge, TravelsToTheWestAlongTheOvalAtItsSpeed) {
  const double per_degree_km = kRadius * kRadiansPerDegree;
  for (const double latitude : {66.0, -66.0})
    for (const double sense : {1.0, -1.0}) {
      const Footprint f = oval(latitude, sense);
      Substorm s = substorm();
      s.recovery_s = 40000.0;
      const auto at = [&](double instant_s) { return spline_cube(f, kEarthRadiusKm, 2, s, instant_s); };
      // The level has risen and has not yet sunk: all that changes is the place of the front.
      const double level = bulge_level(s, 700.0), later = bulge_level(s, 1500.0);
      ASSERT_GT(std::min(level, later), 0.95);
      const double parallel_km = per_degree_km * std::cos(latitude * kRadiansPerDegree);
      const double first = front_deg(at(700.0), latitude, level * 400.0 / per_degree_km) * parallel_km,
                   last = front_deg(at(1500.0), latitude, later * 400.0 / per_degree_km) * parallel_km;
      EXPECT_NEAR((last - first) / 800.0, 1.5, 0.05) << latitude << " " << sense;
      // The front's middle is half its length behind its tip.
      EXPECT_NEAR(first, 1.5 * 600.0 - 150.0, 40.0) << latitude << " " << sense;
    }
}

TEST(Bulge, ReachesTowardsThePoleAndIsBrighter) {
  for (const double latitude : {66.0, -66.0}) {
    const Footprint f = oval(latitude, 1.0);
    const CubeFootprint<double> cube = spline_cube(f, kEarthRadiusKm, 2, substorm(), 700.0);
    const double top_deg = 400.0 / (kRadius * kRadiansPerDegree), sign = latitude < 0.0 ? -1.0 : 1.0;
    EXPECT_NEAR(height_deg(cube, latitude, 15.0), top_deg, 0.15);
    // A cell's middle is up to 0.4 widths off the curve.
    EXPECT_NEAR(flux_at(cube, latitude + sign * top_deg, 15.0), 12.0, 0.96);
    EXPECT_LT(flux_at(cube, latitude, 15.0), 0.01);
    // To the east of its tail, and beyond its front, the oval is as it was.
    for (const double longitude : {50.0, -40.0, 180.0}) {
      EXPECT_NEAR(height_deg(cube, latitude, longitude), 0.0, 0.15) << longitude;
      EXPECT_NEAR(flux_at(cube, latitude, longitude), 4.0, 0.32) << longitude;
    }
  }
}

TEST(Bulge, IsNotThereBeforeTheOnsetNorAfterTheRecovery) {
  const Footprint f = oval(66.0, 1.0);
  Footprint without = f;
  without.bulge_km = 0.0;
  const CubeFootprint<double> even = spline_cube(without, kEarthRadiusKm, 2);
  for (const double instant : {0.0, 100.0, 2500.0, 1e5}) {
    const CubeFootprint<double> cube = spline_cube(f, kEarthRadiusKm, 1, substorm(), instant);
    for (int face = 0; face < 6; ++face)
      EXPECT_EQ(cube.face[face].flux_mw_m2, even.face[face].flux_mw_m2) << instant;
  }
  EXPECT_EQ(bulge_level(substorm(), 700.0), 1.0);
  EXPECT_GT(bulge_level(substorm(), 1600.0), 0.4);
}

// However long the front goes round: a jump would be 400 km high, and a front 300 km long.
TEST(Bulge, ThatHasGoneRoundMakesNoJump) {
  Footprint f = oval(66.0, 1.0);
  Substorm s = substorm();
  s.recovery_s = 1e6;
  std::vector<CurveNode<double, 3>> points(24);
  for (int i = 0; i < 24; ++i) {
    const double lat = 66.0 * kRadiansPerDegree, lon = 15.0 * i * kRadiansPerDegree;
    points[i].at = {kRadius * std::cos(lat) * std::cos(lon), kRadius * std::cos(lat) * std::sin(lon),
                    kRadius * std::sin(lat)};
    points[i].flux = 1.0;
  }
  for (const double instant_s : {5000.0, 10500.0, 10700.0, 10900.0, 20000.0}) {
    const auto nodes = with_bulge(f, s, instant_s, points, 20.0);
    double steepest = 0.0, highest = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto &a = nodes[i].at, &b = nodes[(i + 1) % nodes.size()].at;
      const auto latitude = [](const auto& at) { return std::asin(at[2] / kRadius); };
      steepest = std::max(steepest, kRadius * std::abs(latitude(b) - latitude(a)));
      highest = std::max(highest, kRadius * latitude(a));
    }
    EXPECT_GT(highest, kRadius * 66.0 * kRadiansPerDegree + 390.0);
    EXPECT_LT(steepest, 80.0) << instant_s;
  }
}

}  // namespace
}  // namespace vegard::sim::bulge_test
