#include "sim/emit/footprint/map/make_footprint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/error.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::make_footprint_test {
namespace {

const NumberAs<double> kPlain = [](const double& n) { return n; };

/// A smooth blob, dark at its edges.
Image blob() {
  Image image(120, 90, {"Y"});
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x)
      image.at(x, y, 0) = static_cast<float>(
          std::exp(-0.5 * (std::pow((x + 0.5 - 55.0) / 12.0, 2) + std::pow((y + 0.5 - 48.0) / 9.0, 2))));
  return image;
}

Scene scene_with(const char* source) {
  Scene scene;
  Footprint f;
  f.source = tests::kind_named<FootprintSource>(source);
  f.size_km = {240.0, 180.0};
  f.cell_km = 2.0;
  f.east_km = {-80.0, 0.0, 70.0};
  f.north_km = {0.0, 30.0, -20.0};
  f.image = "blob.png";
  f.noise_scale_km = 60.0;
  scene.footprints = {f};
  Sheet sheet;
  sheet.length_km = 150.0;
  scene.sheets = {sheet};
  return scene;
}

TEST(MakeFootprint, IsTheSameForAnyNumberOfThreadsAndWithDerivatives) {
  const Image image = blob();
  FootprintPictures pictures;
  pictures.flux = &image;
  for (const char* source : {"spline", "image", "sheets", "noise"}) {
    Scene scene = scene_with(source);
    scene.footprints[0].flow_turns = 0.1;
    const Footprint& f = scene.footprints[0];
    const PlaneFootprint<double> one = make_plane_footprint<double>(scene, f, pictures, kPlain, 1),
                                 two = make_plane_footprint<double>(scene, f, pictures, kPlain, 2);
    EXPECT_EQ(one.grid.flux_mw_m2, two.grid.flux_mw_m2) << source;
    EXPECT_EQ(one.grid.ln_energy, two.grid.ln_energy) << source;
    const double most = *std::max_element(one.grid.flux_mw_m2.begin(), one.grid.flux_mw_m2.end());
    EXPECT_GT(most, 1.0) << source;
    const NumberAs<FreeDual> dual = [](const double& n) { return FreeDual(n); };
    const PlaneFootprint<FreeDual> free = make_plane_footprint<FreeDual>(scene, f, pictures, dual, 2);
    for (std::size_t i = 0; i < free.grid.cells(); ++i)
      EXPECT_NEAR(free.grid.flux_mw_m2[i].v, one.grid.flux_mw_m2[i], 1e-12 * most) << source;
  }
}

TEST(MakeFootprint, DerivativesOfAPictureByFluxAndCentreAreThoseOfDifferences) {
  const Image image = blob();
  FootprintPictures pictures;
  pictures.flux = &image;
  const Scene scene = scene_with("image");
  const Footprint& f = scene.footprints[0];
  const NumberAs<FreeDual> seeded = [&](const double& n) {
    FreeDual dual(n);
    if (&n == &f.energy_flux_mw_m2) dual.d.t[0] = 1.0;
    if (&n == &f.center_km.east) dual.d.t[1] = 1.0;
    if (&n == &f.center_km.north) dual.d.t[2] = 1.0;
    return dual;
  };
  const PlaneFootprint<FreeDual> plane = make_plane_footprint<FreeDual>(scene, f, pictures, seeded, 2);
  const auto cell = [&](int c, int r) { return plane.grid.flux_mw_m2[r * plane.grid.columns + c]; };
  // The blob's own slope: pixels and cells are 2 km; its middle stands at pixel (55, 48) from the upper left.
  double worst = 0.0, largest = 0.0;
  for (int r = 20; r < 70; ++r)
    for (int c = 20; c < 100; ++c) {
      const double east = (c + 0.5 - 55.0) / 12.0, north = (90.0 - r - 0.5 - 48.0) / 9.0;
      const double value = 5.0 * std::exp(-0.5 * (east * east + north * north));
      EXPECT_NEAR(cell(c, r).d.t[0], value / 5.0, 1e-6);
      const double by_east = value * east / 24.0, by_north = -value * north / 18.0;
      worst =
          std::max({worst, std::abs(cell(c, r).d.t[1] - by_east), std::abs(cell(c, r).d.t[2] - by_north)});
      largest = std::max({largest, std::abs(by_east), std::abs(by_north)});
    }
  // Central differences over two of nine cells to a standard deviation: 1/6 × 3 / 81 of the largest slope.
  EXPECT_LT(worst, 0.01 * largest);
}

// The box takes the flow along with what flows: the same cells, elsewhere.
TEST(MakeFootprint, WhatFlowsMovesWithItsCentre) {
  for (const char* source : {"spline", "noise"}) {
    Scene scene = scene_with(source);
    Footprint& f = scene.footprints[0];
    f.flow_turns = 0.3;
    f.width_km = 8.0;
    const NumberAs<FreeDual> seeded = [&](const double& n) {
      FreeDual dual(n);
      if (&n == &f.energy_flux_mw_m2) dual.d.t[0] = 1.0;
      if (&n == &f.center_km.east) dual.d.t[1] = 1.0;
      if (&n == &f.center_km.north) dual.d.t[2] = 1.0;
      return dual;
    };
    const PlaneFootprint<FreeDual> here = make_plane_footprint<FreeDual>(scene, f, {}, seeded, 2);
    // Both ways by a cell: what stands in a cell then stood in the next one before.
    constexpr double kMove = 2.0;
    const auto moved = [&](double east, double north) {
      Scene other = scene;
      other.footprints[0].center_km.east += east;
      other.footprints[0].center_km.north += north;
      return make_plane_footprint<double>(other, other.footprints[0], {}, kPlain, 2);
    };
    const auto at = [&](const PlaneFootprint<double>& plane, double east, double north) {
      const int c = static_cast<int>(std::lround((east - plane.west_km) / plane.cell_km - 0.5)),
                r = static_cast<int>(std::lround((north - plane.south_km) / plane.cell_km - 0.5));
      return plane.grid.flux_mw_m2[static_cast<std::size_t>(r) * plane.grid.columns + c];
    };
    const PlaneFootprint<double> west = moved(-kMove, 0.0), east = moved(kMove, 0.0),
                                 south = moved(0.0, -kMove), north = moved(0.0, kMove);
    double most = 0.0;
    for (int r = 2; r < here.grid.rows - 2; ++r)
      for (int c = 2; c < here.grid.columns - 2; ++c) {
        const double x = here.west_km + (c + 0.5) * here.cell_km,
                     y = here.south_km + (r + 0.5) * here.cell_km;
        const FreeDual& cell = here.grid.flux_mw_m2[static_cast<std::size_t>(r) * here.grid.columns + c];
        most = std::max(most, std::abs(cell.d.t[2]));
        EXPECT_NEAR(cell.d.t[0], cell.v / f.energy_flux_mw_m2, 1e-12) << source;
        EXPECT_NEAR(cell.d.t[1], (at(east, x, y) - at(west, x, y)) / (2.0 * kMove), 1e-6) << source;
        EXPECT_NEAR(cell.d.t[2], (at(north, x, y) - at(south, x, y)) / (2.0 * kMove), 1e-6) << source;
      }
    EXPECT_GT(most, 0.1) << source;
  }
}

TEST(MakeFootprint, RefusesDerivativesThatTakeTooMuchMemory) {
  Scene scene = scene_with("noise");
  Footprint& f = scene.footprints[0];
  f.size_km = {6000.0, 6000.0};
  f.cell_km = 1.0;  // 36 million cells of 136 bytes; 0.3 GB of plain numbers
  try {
    make_plane_footprint<FreeDual>(
        scene, f, {}, [](const double& n) { return FreeDual(n); }, 1);
    FAIL() << "made";
  } catch (const Error& error) {
    EXPECT_EQ(error.details().key, "footprint.arc.cell_km");
    EXPECT_NE(error.details().problem.find("4.9 GB"), std::string::npos) << error.details().problem;
    EXPECT_NE(error.details().hint.find("raise cell_km"), std::string::npos);
  }
}

TEST(MakeFootprint, OfAShellComesFromACurveOrAPicture) {
  Scene scene = scene_with("spline");
  Footprint& f = scene.footprints[0];
  f.shape = FootprintShape::shell;
  f.face_cells = 32;
  f.width_km = 400.0;
  f.latitude_deg = {70.0, 72.0, 68.0};
  f.longitude_deg = {-20.0, 10.0, 40.0};
  const auto most = [](const CubeFootprint<double>& cube) {
    double value = 0.0;
    for (const auto& grid : cube.face)
      if (!grid.flux_mw_m2.empty())
        value = std::max(value, *std::max_element(grid.flux_mw_m2.begin(), grid.flux_mw_m2.end()));
    return value;
  };
  EXPECT_NEAR(most(make_cube_footprint(scene, f, {}, 2)), 5.0, 0.3);
  f.source = FootprintSource::image;
  const Image image = blob();
  FootprintPictures pictures;
  pictures.flux = &image;
  EXPECT_NEAR(most(make_cube_footprint(scene, f, pictures, 2)), 5.0, 0.3);
}

}  // namespace
}  // namespace vegard::sim::make_footprint_test
