#include "sim/emit/footprint/map/plane_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/emit/footprint/map/make_footprint.h"

namespace vegard::sim::plane_flow_test {
namespace {

const NumberAs<double> kPlain = [](const double& n) { return n; };

Footprint arc(double turns) {
  Footprint f;
  f.size_km = {240.0, 120.0};
  f.cell_km = 1.0;
  f.east_km = {-90.0, -20.0, 90.0};
  f.north_km = {-5.0, 10.0, 0.0};
  f.width_km = 4.0;
  f.flow_turns = turns;
  return f;
}

double total(const PlaneFootprint<double>& plane) {
  double sum = 0.0;
  for (const double flux : plane.grid.flux_mw_m2) sum += flux;
  return sum;
}

TEST(PlaneFft, TransformsWavesAndBack) {
  constexpr int columns = 12, rows = 10;
  std::vector<std::complex<double>> plane(columns * rows);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      plane[r * columns + c] = std::cos(2.0 * M_PI * (2.0 * c / columns - 3.0 * r / rows));
  const auto before = plane;
  transform_plane(plane, columns, rows, false, 2);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const int x = wave_number(c, columns), y = wave_number(r, rows);
      const bool is_there = (x == 2 && y == -3) || (x == -2 && y == 3);
      EXPECT_NEAR(std::abs(plane[r * columns + c]), is_there ? 60.0 : 0.0, 1e-12);
    }
  transform_plane(plane, columns, rows, true, 1);
  for (std::size_t i = 0; i < plane.size(); ++i) EXPECT_NEAR(std::abs(plane[i] - before[i]), 0.0, 1e-14);
  EXPECT_EQ(transform_size(7), 8);
  EXPECT_EQ(transform_size(49), 50);
  EXPECT_EQ(transform_size(54), 54);
}

TEST(PlaneFlow, HasNoDivergence) {
  const Footprint f = arc(0.5);
  const PlaneFlow flow = wind_up(spline_plane(f, kPlain, 2), f, f.flow_turns, 1, 0, true, 2);
  double worst = 0.0, fastest = 0.0;
  for (int r = 0; r < flow.rows; ++r)
    for (int c = 0; c < flow.columns; ++c) {
      const auto at = [&](const std::vector<double>& v, int column, int row) {
        return v[static_cast<std::size_t>((row + flow.rows) % flow.rows) * flow.columns +
                 (column + flow.columns) % flow.columns];
      };
      worst =
          std::max(worst, std::abs(at(flow.velocity_east, c + 1, r) - at(flow.velocity_east, c - 1, r) +
                                   at(flow.velocity_north, c, r + 1) - at(flow.velocity_north, c, r - 1)));
      fastest = std::max(fastest, std::abs(at(flow.velocity_east, c, r)));
    }
  EXPECT_GT(fastest, 0.5);
  EXPECT_LT(worst, 1e-12 * fastest);
}

TEST(PlaneFlow, KeepsFluxAndEnergy) {
  for (const double turns : {0.5, 1.0}) {
    const Footprint f = arc(turns);
    const PlaneFootprint<double> before = spline_plane(f, kPlain, 2);
    PlaneFootprint<double> after = before;
    const PlaneFlow flow = wind_up(before, f, f.flow_turns, 1, 0, true, 2);
    carry(flow, after, 2);
    // The flow is followed on cells a quarter of the arc's width: both are kept as well as that resolves it.
    EXPECT_NEAR(total(after), total(before), 0.01 * total(before)) << turns;
    EXPECT_NEAR(flow.energy_last, flow.energy_first, 0.02 * flow.energy_first) << turns;
    // It has not stood still: a tenth of the light at least is elsewhere.
    double moved = 0.0;
    for (std::size_t i = 0; i < before.grid.cells(); ++i)
      moved += 0.5 * std::abs(after.grid.flux_mw_m2[i] - before.grid.flux_mw_m2[i]);
    EXPECT_GT(moved, 0.1 * total(before)) << turns;
  }
}

/// A round patch of even flux, and a mark in its ln E: a half of it has another.
PlaneFootprint<double> patch() {
  PlaneFootprint<double> plane;
  plane.west_km = plane.south_km = -60.0;
  plane.grid.columns = plane.grid.rows = 120;
  plane.grid.flux_mw_m2.resize(plane.grid.cells());
  plane.grid.ln_energy.resize(plane.grid.cells());
  for (int r = 0; r < 120; ++r)
    for (int c = 0; c < 120; ++c) {
      const double east = c - 59.5, north = r - 59.5;
      const double inside = 0.5 * std::erfc((std::hypot(east, north) - 25.0) / 2.0);
      plane.grid.flux_mw_m2[r * 120 + c] = inside;
      plane.grid.ln_energy[r * 120 + c] = inside > 0.0 ? std::tanh(east / 2.0) : 0.0;
    }
  return plane;
}

// Murphree, Cogger and Elphinstone 1989 (abstract): the spirals that Viking saw "always have a
// counterclockwise sense (viewed in the direction of the magnetic field in the northern hemisphere)". B
// points down in the north: counter-clockwise seen from above, and clockwise in the south. A charged sheet
// turns the other way (E x B about an excess of electrons).
TEST(PlaneFlow, TurnsARoundPatchAsAWholeCounterClockwiseSeenAlongTheFieldAsSpirals) {
  Footprint f;
  f.flow_ripple = 0.0;
  EXPECT_EQ(f.flow_sense, FlowSense::spiral);
  for (const auto& [north, sense] : {std::pair{true, FlowSense::spiral},
                                     {false, FlowSense::spiral},
                                     {true, FlowSense::charge},
                                     {false, FlowSense::charge}}) {
    f.flow_sense = sense;
    const bool clockwise_from_above = north == (sense == FlowSense::charge);
    f.flow_turns = 0.25;
    PlaneFootprint<double> plane = patch();
    carry(wind_up(plane, f, f.flow_turns, 1, 0, north, 2), plane, 2);
    // The bright energy was in the east; clockwise, seen from above, a quarter turn brings it to the south.
    // Less the mean vorticity of the plane the patch turns slower, by the share of it that the patch takes
    // up: 1964 of 22500 km², 9 %.
    double towards_south = 0.0, towards_east = 0.0;
    for (int r = 0; r < 120; ++r)
      for (int c = 0; c < 120; ++c) {
        const double cell = plane.grid.flux_mw_m2[r * 120 + c] * plane.grid.ln_energy[r * 120 + c];
        towards_south -= cell * (r - 59.5);
        towards_east += cell * (c - 59.5);
      }
    const double turned = std::atan2(towards_south, towards_east) / (2.0 * M_PI);
    EXPECT_NEAR(turned, (clockwise_from_above ? 1.0 : -1.0) * 0.25 * (1.0 - 1964.0 / 22500.0), 0.01);
  }
}

TEST(PlaneFlow, IsTheSameForAnyNumberOfThreads) {
  const Footprint f = arc(0.3);
  PlaneFootprint<double> one = spline_plane(f, kPlain, 1), two = one;
  carry(wind_up(one, f, f.flow_turns, 1, 0, true, 1), one, 1);
  carry(wind_up(two, f, f.flow_turns, 1, 0, true, 2), two, 2);
  EXPECT_EQ(one.grid.flux_mw_m2, two.grid.flux_mw_m2);
}

// Dual numbers pass over no cell. Windings far from the others, a box that they leave, and cells of all
// sizes.
TEST(PlaneFlow, PassesOverCellsThatStayDarkAlone) {
  for (const double turns : {0.2, 1.5})
    for (const double cell_km : {1.1, 1.9}) {
      Footprint f = arc(turns);
      f.cell_km = cell_km;
      f.flow_ripple = 0.6;
      f.point_flux = {};
      PlaneFootprint<double> plane = spline_plane(f, kPlain, 2);
      const NumberAs<FreeDual> still = [](const double& n) { return FreeDual(n); };
      PlaneFootprint<FreeDual> dual = spline_plane(f, still, 2);
      for (std::size_t i = 0; i < dual.grid.cells(); ++i)
        dual.grid.flux_mw_m2[i] = FreeDual(plane.grid.flux_mw_m2[i]);
      const PlaneFlow flow = wind_up(plane, f, f.flow_turns, 3, 0, true, 2);
      carry(flow, plane, 2);
      carry(flow, dual, 2);
      std::size_t lit = 0;
      for (std::size_t i = 0; i < plane.grid.cells(); ++i) {
        lit += plane.grid.flux_mw_m2[i] > 0.0 ? 1 : 0;
        ASSERT_EQ(plane.grid.flux_mw_m2[i], dual.grid.flux_mw_m2[i].v) << turns << " " << cell_km << " " << i;
      }
      EXPECT_GT(lit, plane.grid.cells() / 100);
      EXPECT_LT(lit, plane.grid.cells() * 9 / 10);
    }
}

TEST(PlaneFlow, CarriesDerivativesAlong) {
  const Footprint f = arc(0.3);
  const NumberAs<FreeDual> seeded = [&](const double& n) {
    FreeDual dual(n);
    if (&n == &f.north_km[1]) dual.d.t[2] = 1.0;
    return dual;
  };
  PlaneFootprint<FreeDual> dual = spline_plane(f, seeded, 2);
  PlaneFootprint<double> plane = spline_plane(f, kPlain, 2), slope = plane;
  for (std::size_t i = 0; i < slope.grid.cells(); ++i)
    slope.grid.flux_mw_m2[i] = dual.grid.flux_mw_m2[i].d.t[2];
  const PlaneFlow flow = wind_up(plane, f, f.flow_turns, 1, 0, true, 2);
  carry(flow, dual, 1);
  carry(flow, plane, 1);
  carry(flow, slope, 2);
  for (std::size_t i = 0; i < slope.grid.cells(); ++i) {
    EXPECT_NEAR(dual.grid.flux_mw_m2[i].v, plane.grid.flux_mw_m2[i], 1e-12);
    EXPECT_NEAR(dual.grid.flux_mw_m2[i].d.t[2], slope.grid.flux_mw_m2[i], 1e-12);
  }
}

}  // namespace
}  // namespace vegard::sim::plane_flow_test
