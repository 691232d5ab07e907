// The curtains of a map as GeoJSON and KML.
#include "fit/report/curtain_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "sim/base/number/constants.h"

namespace vegard::fit::curtain_places_test {
namespace {

sim::Scene scene_at(double latitude_deg, double longitude_deg) {
  sim::Scene scene;
  scene.site.latitude_deg = latitude_deg;
  scene.site.longitude_deg = longitude_deg;
  return scene;
}

/// A curtain from the site's zenith to the north, and beyond the sphere's edge.
Curtain curtain_to_the_north() {
  Curtain curtain;
  curtain.length_km = 222.0;
  curtain.probability = std::nan("");
  const double degree_km = (sim::kEarthRadiusKm + sim::kFootAltitudeKm) * std::sin(sim::kRadiansPerDegree);
  for (const double north : {0.0, degree_km, 1e5}) {
    CurtainPoint point;
    point.foot_km = {0.0, north};
    point.flux_mw_m2 = {4.0, 0.5};
    point.energy_kev = {2.0, std::nan("")};
    curtain.points.push_back(point);
  }
  return curtain;
}

TEST(CurtainPlaces, AreWhereTheFeetAreWithNullForTheUnknown) {
  const sim::Scene scene = scene_at(67.0, 179.5);
  const auto json = nlohmann::json::parse(curtains_geojson(scene, true, {curtain_to_the_north()}));
  ASSERT_EQ(json["features"].size(), 1u);
  const auto& line = json["features"][0]["geometry"]["coordinates"];
  ASSERT_EQ(line.size(), 2u) << "without the point beyond the edge";
  EXPECT_NEAR(line[0][0], 179.5, 1e-6);
  EXPECT_NEAR(line[0][1], 67.0, 1e-6);
  EXPECT_NEAR(line[1][1], 68.0, 1e-6) << "one degree to the north";
  EXPECT_NEAR(line[0][2], 1e3 * sim::kFootAltitudeKm, 0.1);
  const auto& numbers = json["features"][0]["properties"];
  EXPECT_EQ(numbers["energy_flux_mw_m2"], nlohmann::json({4.0, 4.0}));
  EXPECT_EQ(numbers["energy_flux_mw_m2_error"], nlohmann::json({0.5, 0.5}));
  EXPECT_TRUE(numbers["energy_error_kev"][0].is_null());
  EXPECT_TRUE(numbers["probability"].is_null());
}

TEST(CurtainPlaces, AreCutAtTheDateLine) {
  Curtain curtain = curtain_to_the_north();
  curtain.points.resize(2);
  curtain.points[0].foot_km = {-30.0, 0.0};
  curtain.points[1].foot_km = {90.0, 0.0};
  for (const double sign : {1.0, -1.0}) {
    std::swap(curtain.points[0], curtain.points[1]);
    const auto json = nlohmann::json::parse(curtains_geojson(scene_at(67.0, 180.0), true, {curtain}));
    const auto& geometry = json["features"][0]["geometry"];
    ASSERT_EQ(geometry["type"], "MultiLineString");
    const auto& lines = geometry["coordinates"];
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0][1][0], -180.0 * sign);
    EXPECT_EQ(lines[1][0][0], 180.0 * sign);
    EXPECT_EQ(lines[0][1][1], lines[1][0][1]);
    for (const auto& line : lines)
      for (const auto& at : line) EXPECT_EQ(at[0].get<double>() > 0.0, line[0][0].get<double>() > 0.0);
    // A quarter of the way is west of the date line.
    const double west = 180.0 - std::abs(lines[sign > 0.0 ? 1 : 0][sign > 0.0 ? 1 : 0][0].get<double>());
    const double east = 180.0 - std::abs(lines[sign > 0.0 ? 0 : 1][sign > 0.0 ? 0 : 1][0].get<double>());
    EXPECT_NEAR(west / (west + east), 0.25, 1e-3);
  }
}

TEST(CurtainPlaces, CallAFluxRelativeThatIsKnownUpToAFactor) {
  const auto json =
      nlohmann::json::parse(curtains_geojson(scene_at(67.0, 20.0), false, {curtain_to_the_north()}));
  const auto& numbers = json["features"][0]["properties"];
  EXPECT_TRUE(numbers.contains("relative_energy_flux"));
  EXPECT_FALSE(numbers.contains("energy_flux_mw_m2"));
}

TEST(CurtainPlaces, OfAMapWithoutCurtainsAreAnEmptyFile) {
  const sim::Scene scene = scene_at(67.0, 20.0);
  EXPECT_TRUE(nlohmann::json::parse(curtains_geojson(scene, true, {}))["features"].empty());
  EXPECT_EQ(curtains_kml(scene, {}).find("Placemark"), std::string::npos);
}

TEST(CurtainPlaces, HaveTheSameCoordinatesInKml) {
  EXPECT_NE(curtains_kml(scene_at(67.0, 20.0), {curtain_to_the_north()})
                .find("20.000000,67.000000,110000.0 20.000000,68.000000,110000.0"),
            std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::curtain_places_test
