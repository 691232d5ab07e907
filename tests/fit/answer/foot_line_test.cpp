#include "sim/emit/aurora/foot_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/answer/derived.h"
#include "sim/base/number/constants.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/structs/station.h"
#include "tests/support/free_paths.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::foot_line_test {
namespace {

constexpr double kRadiusKm = 6481.0;  // of the sphere at 110 km

double degrees(double radians) { return radians * 180.0 / std::acos(-1.0); }

sim::Scene scene_at(double latitude_deg, double longitude_deg) {
  sim::Scene scene = tests::with_sheet({});
  scene.site.latitude_deg = latitude_deg;
  scene.site.longitude_deg = longitude_deg;
  return scene;
}

TEST(PlaceOfFoot, StraightNorthIsFurtherNorthByTheAngleAtTheEarthsCentre) {
  const sim::Scene scene = scene_at(64.8, 25.0);
  const sim::PlaceOnEarth place = sim::place_of_foot(scene, {0.0, 300.0});
  EXPECT_NEAR(place.latitude_deg, 64.8 + degrees(std::asin(300.0 / kRadiusKm)), 1e-12);
  EXPECT_NEAR(place.longitude_deg, 25.0, 1e-12);
  EXPECT_NEAR(sim::place_of_foot(scene, {0.0, 0.0}).latitude_deg, 64.8, 1e-12);
}

TEST(PlaceOfFoot, EastFromTheEquatorIsFurtherEastOnly) {
  const sim::PlaceOnEarth place = sim::place_of_foot(scene_at(0.0, 179.0), {500.0, 0.0});
  EXPECT_NEAR(place.latitude_deg, 0.0, 1e-12);
  EXPECT_NEAR(place.longitude_from_site_deg, degrees(std::asin(500.0 / kRadiusKm)), 1e-12);
  EXPECT_NEAR(place.longitude_deg, 179.0 + degrees(std::asin(500.0 / kRadiusKm)) - 360.0, 1e-9);
  EXPECT_TRUE(std::isnan(sim::place_of_foot(scene_at(0.0, 0.0), {6000.0, 3000.0}).latitude_deg));
}

TEST(PlaceOfFoot, IsWhereAnotherStationHasTheSameFoot) {
  // A sheet carried to another site (sim/scene/structs/station.h) stands where it stood.
  const sim::Scene home = scene_at(67.8, 20.4);
  sim::Scene there = scene_at(69.3, -170.0);
  there.site.longitude_deg = 16.0;
  there.sheets = {home.sheets[0]};
  there.sheets[0].center_km = {120.0, 250.0};
  const sim::PlaceOnEarth before = sim::place_of_foot(home, there.sheets[0].center_km);
  sim::Station(home.site, there.site).carry(there.sheets[0]);
  const sim::PlaceOnEarth after = sim::place_of_foot(there, there.sheets[0].center_km);
  EXPECT_NEAR(after.latitude_deg, before.latitude_deg, 1e-9);
  EXPECT_NEAR(after.longitude_deg, before.longitude_deg, 1e-9);
  EXPECT_NEAR(after.magnetic_latitude_deg, before.magnetic_latitude_deg, 1e-9);
}

TEST(PlaceOfFoot, GeomagneticLatitudeIsNinetyDegreesLessTheWayToThePole) {
  sim::Scene scene = scene_at(70.0, 25.0);
  scene.field.pole_latitude_deg = 80.0;
  scene.field.pole_longitude_deg = 25.0;
  // On the pole's meridian: the way to it is the difference of latitudes.
  EXPECT_NEAR(sim::place_of_foot(scene, {0.0, 0.0}).magnetic_latitude_deg, 80.0, 1e-9);
  // And across the geographic pole from it.
  scene.field.pole_longitude_deg = 205.0;
  EXPECT_NEAR(sim::place_of_foot(scene, {0.0, 0.0}).magnetic_latitude_deg, 60.0, 1e-9);
}

TEST(FootPoints, AreTheEndsTheMiddleAndTheNearest) {
  sim::Sheet sheet;
  sheet.center_km = {50.0, 200.0};
  sheet.bearing_deg = 90.0;
  sheet.length_km = 300.0;
  sheet.drift_km_s = {0.0, 1.0};
  const sim::FootPoints feet = sim::foot_points(sheet, 10.0);
  EXPECT_NEAR(feet.start.east, -100.0, 1e-9);
  EXPECT_NEAR(feet.end.east, 200.0, 1e-9);
  EXPECT_NEAR(feet.middle.north, 210.0, 1e-9);
  EXPECT_NEAR(feet.nearest.east, 0.0, 1e-9);
  EXPECT_NEAR(feet.nearest.north, 210.0, 1e-9);
}

TEST(SineFeet, LieOffTheLineByTheSineToTheLeftInTheNorth) {
  sim::Sheet sheet;
  sheet.center_km = {0.0, 200.0};
  sheet.bearing_deg = 90.0;  // to the left is north
  sheet.length_km = 100.0;
  sheet.wavelength_km = 400.0;  // a quarter of a wave from end to end
  sheet.layers = 1;
  sheet.phase_rad = 0.0;
  sim::Scene scene = tests::with_sheet(sheet);
  EXPECT_NEAR(sim::sine_feet(scene, sheet, 0.0, 0, 11).back().north, 200.0 + sheet.thickness_km, 1e-9);
  EXPECT_NEAR(sim::sine_feet(scene, sheet, 0.0, 0, 11).front().north, 200.0, 1e-9);
  scene.field.inclination_deg = -78.0;
  EXPECT_NEAR(sim::sine_feet(scene, sheet, 0.0, 0, 11).back().north, 200.0 - sheet.thickness_km, 1e-9);
}

TEST(SineFeet, OfThreeLayersAreThoseOfTheMiddleOne) {
  sim::Sheet sheet;
  sheet.center_km = {20.0, 180.0};
  sheet.bearing_deg = 90.0;
  sheet.length_km = 240.0;
  sheet.wavelength_km = 70.0;
  sheet.phase_rad = 0.4;
  sheet.layers = 3;
  sheet.phase_shift_rad = 0.9;
  constexpr int kFeet = 9;
  const std::vector<sim::EastNorth> feet = sim::sine_feet(tests::with_sheet(sheet), sheet, 0.0, 0, kFeet);
  for (int i = 0; i < kFeet; ++i) {
    sim::BeamPlace place;
    place.s = place.s_of_phase = static_cast<double>(i) / (kFeet - 1);
    EXPECT_NEAR(feet[i].north - 180.0, sim::aside_laid_out_km(sheet, place, 1, 0.0), 1e-9) << i;
  }
}

const DerivedNumber* find(const std::vector<DerivedNumber>& numbers, const std::string& name) {
  for (const DerivedNumber& d : numbers)
    if (d.name == name) return &d;
  return nullptr;
}

/// North known to 2 km, bearing to 0.1 degrees; the line runs east, 200 km to the north.
std::vector<DerivedNumber> numbers_of(sim::Scene scene) {
  scene.sheets[0].center_km = {0.0, 200.0};
  scene.sheets[0].bearing_deg = 90.0;
  scene.fit.free = {tests::free_entry("sheet.main.center_km.north"),
                    tests::free_entry("sheet.main.bearing_deg")};
  return derived_numbers(scene, free_numbers(scene), {200.0, 90.0}, {{{4.0, 0.0}, {0.0, 0.01}}, {}});
}

TEST(FeetOnEarth, HaveErrorBars) {
  const auto numbers = numbers_of(scene_at(64.8, 25.0));
  const DerivedNumber* latitude = find(numbers, "latitude of the middle foot of the main sheet");
  ASSERT_TRUE(latitude != nullptr && latitude->sigma);
  EXPECT_NEAR(latitude->value, 64.8 + degrees(std::asin(200.0 / kRadiusKm)), 1e-9);
  EXPECT_NEAR(*latitude->sigma, degrees(2.0 / std::sqrt(kRadiusKm * kRadiusKm - 200.0 * 200.0)), 1e-7);
  const DerivedNumber* longitude = find(numbers, "longitude of the middle foot of the main sheet");
  ASSERT_NE(longitude, nullptr);
  EXPECT_NEAR(longitude->value, 25.0, 1e-9);
  EXPECT_NE(find(numbers, "geomagnetic latitude of the nearest foot of the main sheet"), nullptr);
}

TEST(FeetOnEarth, AreMissingWithAReasonWhereTheSiteIsNotGiven) {
  const auto nowhere = numbers_of(tests::with_sheet({}));
  const DerivedNumber* none = find(nowhere, "geographic coordinates of the feet of the main sheet");
  ASSERT_NE(none, nullptr);
  EXPECT_TRUE(std::isnan(none->value));
  EXPECT_NE(none->why_none.find("site"), std::string::npos);
  EXPECT_EQ(find(nowhere, "latitude of the nearest foot of the main sheet"), nullptr);
  // Half a site gives latitudes.
  const auto half =
      numbers_of(sim::parse_scene("[site]\nlatitude_deg = 65.0\n[[sheet]]\nname = \"main\"\n", "a.toml"));
  EXPECT_NE(find(half, "latitude of the nearest foot of the main sheet"), nullptr);
  EXPECT_EQ(find(half, "longitude of the nearest foot of the main sheet"), nullptr);
  ASSERT_NE(find(half, "longitude and geomagnetic latitude of the feet of the main sheet"), nullptr);
}

TEST(FootBands, OpenTowardsTheEndsByTheBearingsError) {
  sim::Scene scene = scene_at(64.8, 25.0);
  scene.sheets[0].center_km = {0.0, 200.0};
  scene.sheets[0].bearing_deg = 90.0;
  scene.sheets[0].length_km = 400.0;
  scene.fit.free = {tests::free_entry("sheet.main.center_km.north"),
                    tests::free_entry("sheet.main.bearing_deg")};
  ValueUncertainty known{{{4.0, 0.0}, {0.0, 0.01}}, {}};
  const auto bands = foot_bands(scene, free_numbers(scene), {200.0, 90.0}, known);
  ASSERT_EQ(bands.size(), 1u);
  ASSERT_EQ(bands[0].sigma_km.size(), bands[0].along_km.size());
  EXPECT_NEAR(bands[0].along_km.back(), 200.0, 1e-9);
  EXPECT_NEAR(bands[0].sigma_km[bands[0].sigma_km.size() / 2], 2.0, 1e-6);
  EXPECT_NEAR(bands[0].sigma_km.back(), std::hypot(2.0, 200.0 * 0.1 * sim::kRadiansPerDegree), 1e-5);
  known.undetermined = {{1.0, 0.0}};
  EXPECT_TRUE(foot_bands(scene, free_numbers(scene), {200.0, 90.0}, known)[0].sigma_km.empty());
}

}  // namespace
}  // namespace vegard::fit::foot_line_test
