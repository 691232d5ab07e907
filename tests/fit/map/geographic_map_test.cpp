// Maps on grids of longitude and latitude.
#include "fit/map/geographic_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/scene/structs/scene.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::geographic_map_test {
namespace {

/// A blob of 20 km about (east, north) = (30, 200) km, E0 from 2 keV in the west to 4 keV in the east; a
/// corner is not constrained.
PrecipitationPlanes blob() {
  PrecipitationPlanes map;
  map.columns = 101;
  map.rows = 121;
  map.west_km = -70.0;
  map.south_km = 80.0;
  map.step_km = 2.0;
  map.site.latitude_deg = 65.1;
  map.site.longitude_deg = -147.4;
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      const double east = map.west_km + 2.0 * column, north = map.south_km + 2.0 * row;
      const double q = 5.0 * std::exp(-(std::pow(east - 30.0, 2) + std::pow(north - 200.0, 2)) / 800.0);
      map.energy_flux_mw_m2.push_back(row < 10 && column < 10 ? sim::kNaN : q);
      map.energy_kev.push_back(3.0 + (east - 30.0) / 100.0);
      map.relative_flux_error.push_back(0.1);
      map.ln_energy_error.push_back(0.2);
      map.sensitivity.push_back(10.0);
    }
  return map;
}

// The formulas of GEMINI (gemini3d/pygemini, coord.py: geog2geomag), by spherical triangles instead of axes.
LongitudeLatitude by_triangles(LongitudeLatitude geographic) {
  constexpr double kDegrees = sim::kRadiansPerDegree;
  const double pole = 11.0 * kDegrees, pole_longitude = 289.0 * kDegrees;
  const double theta = (90.0 - geographic.latitude_deg) * kDegrees;
  double phi = geographic.longitude_deg * kDegrees;
  if (phi < 0.0) phi += 2.0 * sim::kPi;
  const double from_pole = std::acos(std::cos(theta) * std::cos(pole) +
                                     std::sin(theta) * std::sin(pole) * std::cos(phi - pole_longitude));
  const double angle = std::acos(std::clamp(
      (std::cos(theta) - std::cos(from_pole) * std::cos(pole)) / (std::sin(from_pole) * std::sin(pole)), -1.0,
      1.0));
  const bool is_east = (pole_longitude > phi && pole_longitude - phi > sim::kPi) ||
                       (pole_longitude < phi && phi - pole_longitude < sim::kPi);
  return {(is_east ? sim::kPi - angle : angle + sim::kPi) / kDegrees, 90.0 - from_pole / kDegrees};
}

TEST(GeographicMap, HasTheDipoleOfGemini) {
  for (const double latitude : {-70.0, -10.0, 30.0, 65.0, 78.0})
    for (const double longitude : {-170.0, -147.0, -71.5, -60.0, 0.0, 16.0, 110.0}) {
      const LongitudeLatitude place{longitude, latitude},
          magnetic = in_frame(EarthFrame::gemini_dipole, place), wanted = by_triangles(place);
      // An arc cosine near 1 is good to some 1e-7.
      EXPECT_NEAR(magnetic.latitude_deg, wanted.latitude_deg, 1e-5) << latitude << " " << longitude;
      EXPECT_NEAR(magnetic.longitude_deg, wanted.longitude_deg, 2e-5) << latitude << " " << longitude;
      const LongitudeLatitude back = geographic_of(EarthFrame::gemini_dipole, magnetic);
      EXPECT_NEAR(back.latitude_deg, latitude, 1e-10);
      EXPECT_NEAR(back.longitude_deg, longitude, 1e-10);
    }
  EXPECT_NEAR(in_frame(EarthFrame::gemini_dipole, {289.0, 79.0}).latitude_deg, 90.0, 1e-6);
}

TEST(GeographicMap, PutsLightWhereItFalls) {
  const PrecipitationPlanes map = blob();
  for (const EarthFrame frame : {EarthFrame::geographic, EarthFrame::gemini_dipole}) {
    const GeographicGrid grid = grid_over({map}, frame, 0.05);
    const GeographicMap made = on_grid(map, grid);
    std::size_t most = 0;
    for (std::size_t i = 0; i < grid.cells(); ++i)
      if (!(made.energy_flux_mw_m2[most] >= made.energy_flux_mw_m2[i]) &&
          std::isfinite(made.energy_flux_mw_m2[i]))
        most = i;
    const LongitudeLatitude place =
        geographic_of(frame, {grid.longitude_deg[most % grid.longitude_deg.size()],
                              grid.latitude_deg[most / grid.longitude_deg.size()]});
    sim::Scene scene;
    scene.site = map.site;
    const sim::PlaceOnEarth wanted = sim::place_of_foot(scene, {30.0, 200.0});
    // Within a cell: 0.05 degrees of latitude and as far to the east.
    EXPECT_NEAR(place.latitude_deg, wanted.latitude_deg, 0.05);
    EXPECT_NEAR(place.longitude_deg, wanted.longitude_deg, 0.05 / std::cos(67.0 * sim::kRadiansPerDegree));
    EXPECT_NEAR(made.energy_kev[most], 3.0, 0.1);
    EXPECT_NEAR(made.relative_flux_error[most], 0.1, 1e-12);
    EXPECT_NEAR(made.ln_energy_error[most], 0.2, 1e-12);
  }
}

// The energy that falls down in all is what fell down: the sum over cells of flux times area, on the sphere
// of the feet and in the tangent plane (whose cells are larger there by one over the cosine of the angle
// between).
TEST(GeographicMap, KeepsTheEnergyThatFalls) {
  const PrecipitationPlanes map = blob();
  constexpr double kRadius_km = 6481.0;
  double before = 0.0;
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      const double q = map.energy_flux_mw_m2[static_cast<std::size_t>(row) * map.columns + column];
      const double from_km = std::hypot(map.west_km + 2.0 * column, map.south_km + 2.0 * row);
      if (std::isfinite(q)) before += q * 4.0 / std::sqrt(1.0 - std::pow(from_km / kRadius_km, 2));
    }
  for (const double step_deg : {0.03, 0.1, 0.25}) {
    const GeographicGrid grid = grid_over({map}, EarthFrame::geographic, step_deg);
    const GeographicMap made = on_grid(map, grid);
    const double dlon = (grid.longitude_deg[1] - grid.longitude_deg[0]) * sim::kRadiansPerDegree,
                 dlat = step_deg * sim::kRadiansPerDegree;
    double after = 0.0;
    for (std::size_t i = 0; i < grid.cells(); ++i) {
      const double q = made.energy_flux_mw_m2[i];
      const double latitude = grid.latitude_deg[i / grid.longitude_deg.size()] * sim::kRadiansPerDegree;
      if (std::isfinite(q)) after += q * kRadius_km * kRadius_km * dlon * dlat * std::cos(latitude);
    }
    // The blob ends before the map does; its cells are sampled twice a step each way.
    EXPECT_NEAR(after / before, 1.0, 0.01) << step_deg;
  }
}

// 200 km to the north of 88.5 degrees lies beyond the pole.
TEST(GeographicMap, GoesOnceAroundAPole) {
  PrecipitationPlanes map = blob();
  map.site.latitude_deg = 88.5;
  constexpr double kStep_deg = 0.1, kRadius_km = 6481.0;
  const GeographicGrid grid = grid_over({map}, EarthFrame::geographic, kStep_deg);
  EXPECT_LT(grid.longitude_deg.back() - grid.longitude_deg.front(), 360.0);
  EXPECT_GE(grid.longitude_deg.front(), -180.0);
  EXPECT_LE(grid.latitude_deg.back(), 90.0);
  const GeographicMap made = on_grid(map, grid);
  double before = 0.0, after = 0.0;
  for (const double q : map.energy_flux_mw_m2)
    if (std::isfinite(q)) before += q * map.step_km * map.step_km;
  const double dlon = (grid.longitude_deg[1] - grid.longitude_deg[0]) * sim::kRadiansPerDegree;
  for (std::size_t i = 0; i < grid.cells(); ++i) {
    const double q = made.energy_flux_mw_m2[i];
    const double latitude = grid.latitude_deg[i / grid.longitude_deg.size()] * sim::kRadiansPerDegree;
    if (std::isfinite(q))
      after += q * kRadius_km * kRadius_km * dlon * kStep_deg * sim::kRadiansPerDegree * std::cos(latitude);
  }
  // A place that had two columns would count twice. Cells that touch the pole are not square: 2 %.
  EXPECT_NEAR(after / before, 1.0, 0.02);
}

TEST(GeographicMap, LeavesOutWhatIsUnconstrained) {
  const PrecipitationPlanes map = blob();
  const GeographicGrid grid = grid_over({map}, EarthFrame::geographic, 0.05);
  const GeographicMap made = on_grid(map, grid);
  sim::Scene scene;
  scene.site = map.site;
  const sim::PlaceOnEarth dark = sim::place_of_foot(scene, {-60.0, 90.0});
  double nearest = 1e9;
  std::size_t at = 0;
  for (std::size_t i = 0; i < grid.cells(); ++i) {
    const double off = std::hypot(grid.longitude_deg[i % grid.longitude_deg.size()] - dark.longitude_deg,
                                  grid.latitude_deg[i / grid.longitude_deg.size()] - dark.latitude_deg);
    if (off < nearest) nearest = off, at = i;
  }
  EXPECT_TRUE(std::isnan(made.energy_flux_mw_m2[at]));
}

TEST(GeographicMap, RefusesStepsThatMakeNoGrid) {
  EXPECT_NE(
      tests::expect_error(sim::ErrorKind::usage, [] { grid_over({blob()}, EarthFrame::geographic, 0.0005); })
          .find("--step-deg"),
      std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::geographic_map_test
