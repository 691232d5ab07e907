// Noise and flow around the Earth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/emit/footprint/map/make_footprint.h"

namespace vegard::sim::shell_map_test {
namespace {

constexpr int kCells = 128;

Footprint around(double latitude_deg) {
  Footprint f;
  f.shape = FootprintShape::shell;
  f.closed = true;
  f.face_cells = kCells;
  f.width_km = 250.0;
  f.energy_flux_mw_m2 = 2.0;
  f.noise_scale_km = 900.0;
  f.noise_octaves = 3;
  f.flow_scale_km = 1500.0;
  f.flow_ripple = 0.8;
  for (int i = 0; i < 24; ++i) {
    f.latitude_deg.push_back(latitude_deg);
    f.longitude_deg.push_back(15.0 * i);
  }
  return f;
}

CubeFootprint<double> even() {
  CubeFootprint<double> cube = cube_grid<double>(kCells, false);
  for (auto& face : cube.face) std::fill(face.flux_mw_m2.begin(), face.flux_mw_m2.end(), 1.0);
  return cube;
}

/// Calls see(flux of a cell in either map, its area) for each cell.
template <class See>
void each(const CubeFootprint<double>& one, const CubeFootprint<double>& two, const See& see) {
  const int n = one.face_cells;
  for (int face = 0; face < 6; ++face)
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        const double u = face_coordinate(c, n), v = face_coordinate(r, n);
        const std::size_t at = static_cast<std::size_t>(r + 1) * (n + 2) + c + 1;
        see(one.face[face].flux_mw_m2[at], two.face[face].flux_mw_m2[at],
            std::pow(1.0 + u * u + v * v, -1.5));
      }
}

double total(const CubeFootprint<double>& cube) {
  double sum = 0.0;
  each(cube, cube, [&](double flux, double, double area) { sum += flux * area; });
  return sum;
}

TEST(ShellNoise, CoversAboutAsMuchAsItIsToldToAndHasNoSeams) {
  for (const double coverage : {0.2, 0.5}) {
    Footprint f = around(66.0);
    f.noise_coverage = coverage;
    const CubeFootprint<double> cube = noise_cube(f, kEarthRadiusKm, even(), 5, 0, 0.0, 2);
    double lit = 0.0, all = 0.0, most = 0.0, steepest = 0.0;
    each(cube, cube, [&](double flux, double, double area) {
      lit += flux > 0.0 ? area : 0.0;
      all += area;
      most = std::max(most, flux);
    });
    EXPECT_NEAR(lit / all, coverage, 0.05);
    EXPECT_LE(most, 1.0);
    EXPECT_GT(most, 0.7);
    // Across the edges of the faces it changes as little as from cell to cell elsewhere.
    double at_edges = 0.0;
    const int stride = kCells + 2;
    for (const auto& face : cube.face)
      for (int r = 1; r <= kCells; ++r)
        for (int c = 0; c <= kCells; ++c) {
          const double step = std::abs(face.flux_mw_m2[r * stride + c + 1] - face.flux_mw_m2[r * stride + c]);
          (c == 0 || c == kCells ? at_edges : steepest) =
              std::max(c == 0 || c == kCells ? at_edges : steepest, step);
        }
    EXPECT_LT(at_edges, 1.1 * steepest);
  }
}

TEST(ShellNoise, PassesFromOnePatternIntoTheNextAndIsAsStrongOnTheWay) {
  Footprint f = around(66.0);
  f.noise_coverage = 0.4;
  f.noise_lifetime_s = 100.0;
  const auto at = [&](double instant_s) { return noise_cube(f, kEarthRadiusKm, even(), 5, 0, instant_s, 2); };
  const CubeFootprint<double> first = at(0.0), soon = at(2.0), half = at(50.0), next = at(100.0);
  const auto differ = [&](const CubeFootprint<double>& one, const CubeFootprint<double>& two) {
    double sum = 0.0;
    each(one, two, [&](double a, double b, double area) { sum += std::abs(a - b) * area; });
    return sum / total(one);
  };
  EXPECT_LT(differ(first, soon), 0.15);
  EXPECT_GT(differ(first, next), 0.6);
  EXPECT_NEAR(total(half) / total(first), 1.0, 0.25);
  // Continuous where a pattern ends.
  EXPECT_LT(differ(at(99.99), next), 0.01);
  f.noise_lifetime_s = 0.0;
  EXPECT_EQ(differ(at(0.0), at(1e4)), 0.0);
}

TEST(ShellNoise, ShinesAlongACurveThatItIsGiven) {
  Scene scene;
  Footprint f = around(66.0);
  f.source = FootprintSource::noise;
  f.noise_coverage = 1.0;
  scene.footprints = {f};
  const CubeFootprint<double> along = make_cube_footprint(scene, scene.footprints[0], {}, 2);
  const CubeFootprint<double> curve = spline_cube(f, kEarthRadiusKm, 1);
  bool within = true;
  each(along, curve, [&](double with, double without, double) { within = within && with <= without; });
  EXPECT_TRUE(within);
  EXPECT_GT(total(along), 0.05 * total(curve));
  scene.footprints[0].latitude_deg.clear();
  scene.footprints[0].longitude_deg.clear();
  EXPECT_GT(total(make_cube_footprint(scene, scene.footprints[0], {}, 2)), 2.0 * total(along));
}

TEST(ShellFlow, KeepsTheFluxMovesItAndIsTheSameForAnyNumberOfThreads) {
  for (const double latitude : {68.0, -68.0}) {
    const Footprint f = around(latitude);
    const CubeFootprint<double> before = spline_cube(f, kEarthRadiusKm, 2);
    CubeFootprint<double> after = before, again = before, still = before;
    wind_up_shell(f, kEarthRadiusKm, 0.6, 3, 0, 2, after);
    wind_up_shell(f, kEarthRadiusKm, 0.6, 3, 0, 1, again);
    wind_up_shell(f, kEarthRadiusKm, 0.0, 3, 0, 1, still);
    for (int face = 0; face < 6; ++face) {
      EXPECT_EQ(after.face[face].flux_mw_m2, again.face[face].flux_mw_m2);
      EXPECT_EQ(still.face[face].flux_mw_m2, before.face[face].flux_mw_m2);
    }
    EXPECT_NEAR(total(after) / total(before), 1.0, 0.01) << latitude;
    double moved = 0.0;
    each(after, before, [&](double a, double b, double area) { moved += 0.5 * std::abs(a - b) * area; });
    EXPECT_GT(moved, 0.1 * total(before)) << latitude;
  }
}

// A round patch on the pole turns as one: what is marked beside its middle goes round it, seen along the
// field or against it as a box's does.
TEST(ShellFlow, TurnsInTheSenseOfAPlanesFlow) {
  for (const double pole : {1.0, -1.0})
    for (const FlowSense sense : {FlowSense::spiral, FlowSense::charge}) {
      Footprint f = around(60.0);
      f.flow_sense = sense;
      f.flow_ripple = 0.0;
      CubeFootprint<double> cube = cube_grid<double>(kCells, true);
      const int n = kCells;
      for (int face = 0; face < 6; ++face)
        for (int r = 0; r < n; ++r)
          for (int c = 0; c < n; ++c) {
            double d[3];
            direction_on_face(face, face_coordinate(c, n), face_coordinate(r, n), d);
            const std::size_t at = static_cast<std::size_t>(r + 1) * (n + 2) + c + 1;
            const double off = std::acos(std::clamp(pole * d[2], -1.0, 1.0)) / kRadiansPerDegree;
            cube.face[face].flux_mw_m2[at] = off < 12.0 ? 1.0 : 0.0;
            // Marked at longitude 0.
            cube.face[face].ln_energy[at] = off < 12.0 && d[0] > std::abs(d[1]) ? 1.0 : 0.0;
          }
      fill_borders(cube);
      wind_up_shell(f, kEarthRadiusKm, 0.25, 3, 0, 2, cube);
      double x = 0.0, y = 0.0;
      for (int face = 0; face < 6; ++face)
        for (int r = 0; r < n; ++r)
          for (int c = 0; c < n; ++c) {
            double d[3];
            direction_on_face(face, face_coordinate(c, n), face_coordinate(r, n), d);
            const std::size_t at = static_cast<std::size_t>(r + 1) * (n + 2) + c + 1;
            const double mark = cube.face[face].flux_mw_m2[at] * cube.face[face].ln_energy[at];
            x += mark * d[0];
            y += mark * d[1];
          }
      // Counter-clockwise from above in the north for spirals, which is to the east; seen from above the
      // south pole that is clockwise, to the east as well. Less than a quarter of a turn, since the mean of
      // the plane's vorticity is taken off.
      const double longitude =
          std::atan2(y, x) / kRadiansPerDegree * (sense == FlowSense::spiral ? 1.0 : -1.0);
      EXPECT_GT(longitude, 45.0) << pole;
      EXPECT_LT(longitude, 90.0) << pole;
    }
}

}  // namespace
}  // namespace vegard::sim::shell_map_test
