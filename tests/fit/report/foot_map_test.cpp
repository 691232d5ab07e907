#include "fit/report/foot_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/report/map_grid.h"
#include "fit/report/plot/earth_map.h"
#include "sim/base/number/constants.h"
#include "tests/support/small_fit.h"

namespace vegard::fit::foot_map_test {
namespace {

constexpr double kKmPerDegree = sim::kEarthRadiusKm * sim::kRadiansPerDegree;

TEST(EarthMap, DistancesAndDirectionsFromThePlaceAreTrue) {
  const GroundPoint north = ground_of_place(65.0, 68.0, 0.0);
  EXPECT_NEAR(north.x, 0.0, 1e-9);
  EXPECT_NEAR(north.y, 3.0 * kKmPerDegree, 1e-9);
  // Along the equator, and over the pole.
  EXPECT_NEAR(ground_of_place(0.0, 0.0, -20.0).x, -20.0 * kKmPerDegree, 1e-9);
  EXPECT_NEAR(ground_of_place(80.0, 80.0, 180.0).y, 20.0 * kKmPerDegree, 1e-6);
  const GroundPoint foot = ground_of_foot({30.0, 40.0});
  EXPECT_NEAR(std::hypot(foot.x, foot.y), sim::kEarthRadiusKm * std::asin(50.0 / 6481.0), 1e-9);
  EXPECT_NEAR(foot.x / foot.y, 0.75, 1e-12);
}

TEST(EarthMap, ALineOfSightMeetsTheAltitudeWhereTheElevationSays) {
  EXPECT_NEAR(ground_of_sight({0.0, 90.0}, 0.0)->y, 0.0, 1e-9);
  // At the horizon: the angle at the centre is acos(R / (R + h)).
  const auto horizon = ground_of_sight({90.0, 0.0}, 0.0);
  ASSERT_TRUE(horizon);
  EXPECT_NEAR(horizon->x, sim::kEarthRadiusKm * std::acos(6371.0 / 6481.0), 1e-6);
  EXPECT_FALSE(ground_of_sight({90.0, -1.0}, 0.0));
  // From orbit: straight down it is below, and upwards never.
  EXPECT_NEAR(ground_of_sight({0.0, -90.0}, 400.0)->y, 0.0, 1e-9);
  EXPECT_FALSE(ground_of_sight({0.0, 10.0}, 400.0));
}

TEST(CameraFootprint, OfACameraThatLooksUpIsARectangleAboutTheSite) {
  sim::Scene scene;
  scene.camera.width = 400;
  scene.camera.height = 200;
  scene.camera.hfov_deg = 90.0;
  scene.camera.elevation_deg = 90.0;
  const std::vector<GroundPoint> outline = camera_footprint(scene);
  ASSERT_FALSE(outline.empty());
  double east = 0.0, north = 0.0;
  for (const GroundPoint& p : outline) {
    east = std::max(east, std::abs(p.x));
    north = std::max(north, std::abs(p.y));
  }
  // Edges 45 and 26.6 degrees off the zenith: about 110 and 55 km away, on the ground a little less.
  EXPECT_NEAR(east, 108.0, 2.0);
  EXPECT_NEAR(north, 54.0, 1.0);
  scene.camera.elevation_deg = -60.0;
  EXPECT_TRUE(camera_footprint(scene).empty());
}

std::string with_site(bool latitude, bool longitude, double sigma_km) {
  FitResult result = tests::small_fit(tests::small_photo());
  if (latitude) result.best.site.latitude_deg = 64.8;
  if (longitude) result.best.site.longitude_deg = 25.3;
  result.photos[0].best.site = result.best.site;
  sim::FootBand band{"main", sim::band_places_km(result.best.sheets[0]), {}};
  if (sigma_km > 0.0) band.sigma_km.assign(band.along_km.size(), sigma_km);
  result.foot_bands = {band};
  return foot_map_svg(result);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(FootMap, HasAGraticuleOnlyWhereTheSiteIsGiven) {
  const std::string whole = with_site(true, true, 8.0);
  EXPECT_TRUE(has(whole, "\u00b0 N</text>"));
  EXPECT_TRUE(has(whole, "\u00b0 E</text>"));
  EXPECT_TRUE(has(whole, "68 %: \u00b18 km"));
  const std::string half = with_site(true, false, 0.0);
  EXPECT_TRUE(has(half, "from the site"));
  EXPECT_TRUE(has(half, "no error bar"));
  const std::string none = with_site(false, false, 8.0);
  EXPECT_FALSE(has(none, "\u00b0 N</text>"));
  EXPECT_TRUE(has(none, "not given"));
  EXPECT_EQ(whole, with_site(true, true, 8.0));
}

TEST(FootMap, OfNoSheetsIsEmpty) {
  FitResult result;
  EXPECT_TRUE(foot_map_svg(result).empty());
}

TEST(MapGrid, ALineOfLatitudePassesThroughItsPlace) {
  sim::Scene scene;
  scene.site.latitude_deg = 65.0 + 1e-9;
  scene.site.longitude_deg = 20.0;
  MapFrame frame;
  frame.area_px = {0.0, 0.0, 400.0, 400.0};
  frame.km_per_px = 2.0;
  // On the site's meridian 66 degrees lie one degree up from the middle.
  for (const GridLine& line : map_grid(frame, scene).lines) {
    if (line.label != "66\u00b0 N") continue;
    int near = 0;
    for (const PlotPoint& p : line.points) {
      if (std::abs(p.x - 200.0) >= 4.0) continue;
      ++near;
      EXPECT_NEAR(p.y, 200.0 - kKmPerDegree / 2.0, 0.05);
    }
    EXPECT_GT(near, 0);
    return;
  }
  ADD_FAILURE() << "no line of 66 degrees";
}

}  // namespace
}  // namespace vegard::fit::foot_map_test
