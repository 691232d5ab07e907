// Grids of latitude and longitude over a map's ground: their lines are where the places are.
#include "fit/report/ground_lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/emit/aurora/foot_line.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::ground_lattice_test {
namespace {

sim::Scene scene_of_tromso() {
  sim::Scene scene;
  scene.site.latitude_deg = 69.6;
  scene.site.longitude_deg = 19.2;
  return scene;
}

RasterGrid raster_of_800_km() {
  RasterGrid raster;
  raster.west_km = raster.south_km = -400.0;
  raster.columns = raster.rows = 401;
  return raster;
}

/// How far the values along each line are from their first, of the value that the line holds.
template <class Value>
double scatter(const Series& line, const Value& value) {
  double least = 1e9, most = -1e9;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (std::isnan(line.x[i])) continue;
    const double here = value(sim::place_of_foot(scene_of_tromso(), {line.x[i], line.y[i]}));
    least = std::min(least, here);
    most = std::max(most, here);
  }
  return most - least;
}

TEST(GroundLattice, GeographicLinesHoldALatitudeOrALongitudeOfAWholeStep) {
  Panel panel;
  add_geographic_grid(scene_of_tromso(), raster_of_800_km(), panel);
  ASSERT_GE(panel.series.size(), 6u);
  EXPECT_TRUE(tests::has_facts(panel.series[0].label, "2 | latitude | 5 | longitude"));
  int parallels = 0, meridians = 0;
  for (const Series& line : panel.series) {
    parallels += scatter(line, [](const sim::PlaceOnEarth& p) { return p.latitude_deg; }) < 1e-9;
    meridians += scatter(line, [](const sim::PlaceOnEarth& p) { return p.longitude_deg; }) < 1e-9;
  }
  EXPECT_EQ(parallels + meridians, static_cast<int>(panel.series.size()));
  EXPECT_GE(parallels, 3);
  EXPECT_GE(meridians, 3);
}

TEST(GroundLattice, MagneticParallelsHoldTheMagneticLatitudeOfTheMapsOtherFiles) {
  Panel panel;
  add_magnetic_grid(scene_of_tromso(), raster_of_800_km(), panel);
  int parallels = 0;
  for (const Series& line : panel.series) {
    if (scatter(line, [](const sim::PlaceOnEarth& p) { return p.magnetic_latitude_deg; }) > 1e-9) continue;
    ++parallels;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (std::isnan(line.x[i])) continue;
      const double latitude =
          sim::place_of_foot(scene_of_tromso(), {line.x[i], line.y[i]}).magnetic_latitude_deg;
      EXPECT_NEAR(latitude, std::round(latitude), 1e-9) << "of a whole step";
      break;
    }
  }
  EXPECT_GE(parallels, 3);
  EXPECT_LT(parallels, static_cast<int>(panel.series.size())) << "and meridians";
}

TEST(GroundLattice, MagneticMeridiansMeetTheParallelsAtRightAngles) {
  Panel panel;
  add_magnetic_grid(scene_of_tromso(), raster_of_800_km(), panel);
  // Near the site, where the tangent plane keeps angles: the gradient of the magnetic latitude is along a
  // meridian.
  const auto latitude = [](double east, double north) {
    return sim::place_of_foot(scene_of_tromso(), {east, north}).magnetic_latitude_deg;
  };
  int looked_at = 0;
  for (const Series& line : panel.series)
    for (std::size_t i = 0; i + 1 < line.x.size(); ++i) {
      const double x = line.x[i], y = line.y[i], dx = line.x[i + 1] - x, dy = line.y[i + 1] - y;
      if (std::isnan(x + dx) || std::hypot(x, y) > 60.0) continue;
      const double gx = latitude(x + 1.0, y) - latitude(x - 1.0, y),
                   gy = latitude(x, y + 1.0) - latitude(x, y - 1.0);
      const double cosine = (gx * dx + gy * dy) / std::hypot(gx, gy) / std::hypot(dx, dy);
      EXPECT_TRUE(std::abs(cosine) < 0.02 || std::abs(cosine) > 0.999) << cosine;
      ++looked_at;
    }
  EXPECT_GT(looked_at, 0);
}

}  // namespace
}  // namespace vegard::fit::ground_lattice_test
