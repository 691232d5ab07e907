#include "sim/emit/footprint/map/make_footprint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/emit/footprint/map/curve.h"
#include "sim/emit/footprint/map/footprint_map.h"

namespace vegard::sim::spline_footprint_test {
namespace {

const NumberAs<double> kPlain = [](const double& n) { return n; };
constexpr double kSqrtTwoPi = 2.5066282746310002;

Footprint straight() {
  Footprint f;
  f.center_km = {10.0, 150.0};
  f.size_km = {300.0, 100.0};
  f.east_km = {-80.0, 80.0};
  f.north_km = {0.5, 0.5};
  f.width_km = 3.0;
  f.energy_flux_mw_m2 = 7.0;
  return f;
}

Footprint bent() {
  Footprint f = straight();
  f.east_km = {-90.0, -30.0, 35.0, 95.0};
  f.north_km = {-10.0, 22.0, -15.0, 12.0};
  f.point_flux = {0.5, 1.5, 0.8, 2.0};
  f.point_energy = {0.6, 1.0, 2.5, 1.4};
  return f;
}

double total(const std::vector<double>& cells) {
  double sum = 0.0;
  for (const double cell : cells) sum += cell;
  return sum;
}

TEST(SplineFootprint, IsAGaussianAcrossAStraightCurve) {
  const Footprint f = straight();
  const PlaneFootprint<double> plane = spline_plane(f, kPlain, 1);
  ASSERT_EQ(plane.grid.columns, 300);
  ASSERT_EQ(plane.grid.rows, 100);
  EXPECT_EQ(plane.west_km, 10.0 - 150.0);
  EXPECT_EQ(plane.south_km, 150.0 - 50.0);
  for (const int column : {120, 150, 171})
    for (int row = 0; row < 100; ++row) {
      const double off = plane.south_km + row + 0.5 - (150.0 + 0.5);
      // 3e-7 of the peak is left out; the sum over the pieces is the integral to 1e-12.
      EXPECT_NEAR(plane.grid.flux_mw_m2[row * 300 + column], 7.0 * std::exp(-off * off / 18.0), 7.0 * 4e-7);
    }
  // The end falls as an error function, by half at the last point.
  const double end = 0.5 * (plane.grid.flux_mw_m2[50 * 300 + 229] + plane.grid.flux_mw_m2[50 * 300 + 230]);
  EXPECT_NEAR(end, 3.5, 3.5 * 1e-3);
  EXPECT_TRUE(plane.grid.ln_energy.empty());
}

TEST(SplineFootprint, HasTheTotalOfItsLengthHoweverItRuns) {
  for (const bool closed : {false, true})
    for (const double width : {0.2, 0.9, 3.0, 6.0}) {
      Footprint f = bent();
      f.closed = closed;
      f.width_km = width;
      double expected = 0.0;
      std::vector<CurveNode<double, 2>> points;
      for (int i = 0; i < 4; ++i) points.push_back({{f.east_km[i], f.north_km[i]}, f.point_flux[i], 0.0});
      for (const auto& piece : curve_pieces<double, 2>(points, closed, 0.1, false).pieces)
        expected += 7.0 * piece.middle.flux * piece.length * width * kSqrtTwoPi;
      // At 0.7 cells the samples of a Gaussian add up to 1 within 2 exp(-2 pi^2 0.49) = 1.3e-4 where the
      // curve runs along the grid; pieces differ from finer ones by less than that.
      EXPECT_NEAR(total(spline_plane(f, kPlain, 2).grid.flux_mw_m2), expected, 3e-4 * expected);
    }
}

TEST(SplineFootprint, AddsWhereArmsCross) {
  Footprint a = straight(), b = straight(), both = straight();
  a.north_km = {-30.0, 30.0};
  b.north_km = {30.0, -30.0};
  // One curve that goes along the one, far around, and back along the other.
  both.east_km = {-80.0, -20.0, 20.0, 80.0, 130.0, 130.0, 80.0, 20.0, -20.0, -80.0};
  both.north_km = {-30.0, -7.5, 7.5, 30.0, 25.0, -25.0, -30.0, -7.5, 7.5, 30.0};
  const PlaneFootprint<double> of_a = spline_plane(a, kPlain, 1), of_b = spline_plane(b, kPlain, 1),
                               of_both = spline_plane(both, kPlain, 1);
  for (int row = 44; row < 56; ++row)
    for (int column = 144; column < 156; ++column) {
      const std::size_t i = row * 300 + column;
      // The arms of the one curve are straight between the inner points.
      EXPECT_NEAR(of_both.grid.flux_mw_m2[i], of_a.grid.flux_mw_m2[i] + of_b.grid.flux_mw_m2[i], 0.02);
    }
  EXPECT_GT(of_both.grid.flux_mw_m2[50 * 300 + 150], 13.0);
}

TEST(SplineFootprint, HasTheEnergyOfTheNearestPoints) {
  Footprint f = straight();
  f.east_km = {-80.0, 0.0, 80.0};
  f.north_km = {0.5, 0.5, 0.5};
  f.point_energy = {0.5, 0.5, 2.0};
  const PlaneFootprint<double> plane = spline_plane(f, kPlain, 1);
  const auto at = [&](int column) { return plane.grid.ln_energy[50 * 300 + column]; };
  EXPECT_NEAR(at(100), std::log(0.5), 1e-12);
  // Evenly spaced points on a line: the parameter goes as the way. Column 190 is 40.5 km east of the middle.
  EXPECT_NEAR(at(190), std::log(0.5) + 40.5 / 80.0 * std::log(4.0), 1e-3);
  EXPECT_EQ(at(0), 0.0);
}

TEST(SplineFootprint, IsTheSameForAnyNumberOfThreads) {
  const PlaneFootprint<double> one = spline_plane(bent(), kPlain, 1), two = spline_plane(bent(), kPlain, 2);
  EXPECT_EQ(one.grid.flux_mw_m2, two.grid.flux_mw_m2);
  EXPECT_EQ(one.grid.ln_energy, two.grid.ln_energy);
}

TEST(SplineFootprint, DerivativesAreThoseOfDifferences) {
  Footprint f = bent();
  std::vector<double*> numbers = {&f.center_km.east, &f.center_km.north, &f.width_km, &f.energy_flux_mw_m2};
  for (std::vector<double>* list : {&f.east_km, &f.north_km, &f.point_flux, &f.point_energy})
    for (const int i : {1, 3}) numbers.push_back(&(*list)[i]);
  const NumberAs<FreeDual> seeded = [&](const double& n) {
    FreeDual dual(n);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      if (numbers[k] == &n) dual.d.t[k] = 1.0;
    return dual;
  };
  const PlaneFootprint<FreeDual> dual = spline_plane(f, seeded, 2);
  // The grid stays where it is: the centre's difference is taken by moving all points.
  const auto moved = [&](std::size_t k, double by) {
    Footprint g = f;
    if (k < 2) {
      for (double& x : k == 0 ? g.east_km : g.north_km) x += by;
      return spline_plane(g, kPlain, 1);
    }
    const double was = *numbers[k];
    *numbers[k] = was + by;
    PlaneFootprint<double> plane = spline_plane(f, kPlain, 1);
    *numbers[k] = was;
    return plane;
  };
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    constexpr double h = 1e-3;
    const PlaneFootprint<double> more = moved(k, h), less = moved(k, -h);
    double largest = 0.0, worst = 0.0, largest_energy = 0.0, worst_energy = 0.0;
    for (std::size_t i = 0; i < dual.grid.cells(); ++i) {
      const double slope = (more.grid.flux_mw_m2[i] - less.grid.flux_mw_m2[i]) / (2.0 * h);
      largest = std::max(largest, std::abs(slope));
      worst = std::max(worst, std::abs(slope - dual.grid.flux_mw_m2[i].d.t[k]));
      if (dual.grid.flux_mw_m2[i].v < 0.5) continue;
      const double slope_of_energy = (more.grid.ln_energy[i] - less.grid.ln_energy[i]) / (2.0 * h);
      largest_energy = std::max(largest_energy, std::abs(slope_of_energy));
      worst_energy = std::max(worst_energy, std::abs(slope_of_energy - dual.grid.ln_energy[i].d.t[k]));
    }
    EXPECT_GT(largest + largest_energy, 0.01) << k;
    // Differences err by h² times the third derivative over 6, some 1e-6 of the first here, and by cells at
    // the edge of the reach that are in one of the two and not in the other: 3e-7 of the flux over 2 h.
    EXPECT_LT(worst, 1e-4 * largest + 14.0 * 3e-7 / (2.0 * h)) << k;
    // The same over a flux of 0.5 at the least, times the spread of ln E.
    EXPECT_LT(worst_energy, 1e-4 * largest_energy + 14.0 * 3e-7 / (2.0 * h)) << k;
  }
}

TEST(SplineFootprint, AroundThePoleHasNoPreferredSideAndTheTotalOfItsLength) {
  Footprint f;
  f.shape = FootprintShape::shell;
  f.closed = true;
  f.face_cells = 256;
  f.width_km = 150.0;
  f.energy_flux_mw_m2 = 2.0;
  for (int i = 0; i < 24; ++i) {
    f.latitude_deg.push_back(62.0);
    f.longitude_deg.push_back(15.0 * i);
  }
  const CubeFootprint<double> cube = spline_cube(f, kEarthRadiusKm, 2);
  const double radius = kEarthRadiusKm + kFootAltitudeKm;
  double sum = 0.0, most = 0.0;
  for (const auto& grid : cube.face)
    for (int r = 1; r <= 256; ++r)
      for (int c = 1; c <= 256; ++c) {
        const double u = (2.0 * c - 1.0) / 256.0 - 1.0, v = (2.0 * r - 1.0) / 256.0 - 1.0;
        const double area = std::pow(2.0 * radius / 256.0, 2) / std::pow(1.0 + u * u + v * v, 1.5);
        sum += grid.flux_mw_m2[r * 258 + c] * area;
        most = std::max(most, grid.flux_mw_m2[r * 258 + c]);
      }
  const double length = 2.0 * M_PI * radius * std::cos(62.0 * kRadiansPerDegree);
  // Points 15 degrees apart make a circle to 1e-4; on the round Earth the Gaussian's area is less by
  // 1 - width² / (8 radius²), 7e-5, and the middle rule of the cells errs by less.
  EXPECT_NEAR(sum, 2.0 * length * 150.0 * kSqrtTwoPi, 1e-3 * sum);
  EXPECT_NEAR(most, 2.0, 0.01);
  // A quarter turn of the north face, which lies on the pole, changes nothing.
  const auto& north = cube.face[4].flux_mw_m2;
  for (int r = 1; r <= 256; ++r)
    for (int c = 1; c <= 256; ++c) EXPECT_NEAR(north[r * 258 + c], north[c * 258 + (257 - r)], 1e-6);
}

}  // namespace
}  // namespace vegard::sim::spline_footprint_test
