#include "sim/light/drawn_profile.h"

#include <gtest/gtest.h>

#include "sim/light/sheet_profile.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::drawn_profile_test {
namespace {

Scene scene_with_table(const std::string& text, std::vector<double> lines = {557.7}) {
  Sheet sheet;
  sheet.profile = ProfileKind::file;
  sheet.profile_file = "drawn.csv";
  Scene scene = tests::with_sheet(sheet);
  scene.emission.lines = std::move(lines);
  scene.tables["sheet.main.profile_file"] = text;
  return scene;
}

float rate_at(const HeightProfile& profile, double altitude_km, int line = 0) {
  return profile.rate[static_cast<std::size_t>((altitude_km - 80.0) / 0.25) * profile.stride + line];
}

std::string message(const Scene& scene) {
  return tests::expect_error(ErrorKind::unreadable_input, [&] { check_profiles(scene); });
}

TEST(DrawnProfile, IsStraightBetweenItsRowsAndDarkBeyondThem) {
  const Scene scene =
      scene_with_table("altitude_km,5577,630.0\n100,0,2\n110,20,4\n200,2,0\n", {630.0, 557.7});
  check_profiles(scene);
  const HeightProfile profile = sheet_profile(scene.emission.lines, scene, 0);
  EXPECT_EQ(rate_at(profile, 99.75, 1), 0.0f);
  EXPECT_EQ(rate_at(profile, 102.5, 1), 5.0f);
  EXPECT_EQ(rate_at(profile, 110.0, 1), 20.0f);
  EXPECT_EQ(rate_at(profile, 155.0, 1), 11.0f);
  EXPECT_EQ(rate_at(profile, 200.0, 1), 2.0f);
  EXPECT_EQ(rate_at(profile, 200.25, 1), 0.0f);
  EXPECT_EQ(rate_at(profile, 105.0, 0), 3.0f);
  for (const float slope : profile.d_rate_d_ln_energy) EXPECT_EQ(slope, 0.0f);
}

// Protons bring H beta along, which no table of electrons has.
TEST(DrawnProfile, HasLinesThatAreNotTheElectronsIfTheyHaveAColumn) {
  const std::string without = "altitude_km,557.7\n100,0\n110,20\n200,2\n";
  EXPECT_EQ(rate_at(sheet_profile({486.1, 557.7}, scene_with_table(without), 0), 110.0, 0), 0.0f);
  const Scene scene =
      scene_with_table("altitude_km,557.7,486.1\n100,0,0\n110,20,8\n120,2,0\n", {486.1, 557.7});
  check_profiles(scene);
  const HeightProfile profile = sheet_profile(scene.emission.lines, scene, 0);
  EXPECT_EQ(rate_at(profile, 110.0, 0), 8.0f);
  EXPECT_EQ(rate_at(profile, 115.0, 0), 4.0f);
  EXPECT_EQ(rate_at(profile, 110.0, 1), 20.0f);
  // 8 photons cm^-3 s^-1 in a triangle 20 km wide at its foot: 8 R.
  EXPECT_NEAR(column_below(profile, 0, 500.0).rayleigh, 8.0, 0.1);
}

TEST(DrawnProfile, OfAGivenBrightnessTakesAnyUnit) {
  Scene scene = scene_with_table("altitude_km,ver_5577,ver_4278\n100,0,0\n110,7,1\n140,0,0\n", {427.8});
  scene.sheets[0].brightness_kilorayleigh = 5.0;
  check_profiles(scene);
  EXPECT_NEAR(column_below(sheet_profile({557.7}, scene, 0), 0, 500.0).rayleigh, 5000.0, 1.0);
  EXPECT_NEAR(column_below(sheet_profile({427.8}, scene, 0), 0, 500.0).rayleigh, 5000.0 / 7.0, 1.0);
}

TEST(DrawnProfile, NamesWhatIsWrongWithATable) {
  const auto expect = [](const std::string& text, const std::string& words) {
    const std::string said = message(scene_with_table(text));
    EXPECT_NE(said.find("drawn.csv"), std::string::npos) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  expect("altitude_km,630.0\n100,1\n110,2\n", "no column of 557.7 nm beside altitude_km, 630.0");
  expect("height,557.7\n100,1\n110,2\n", "altitude_km");
  expect("altitude_km,557.7\n100,1\n110,-2\n", "drawn.csv:3: -2 in column '557.7'");
  expect("altitude_km,557.7\n110,1\n100,2\n", "drawn.csv:3");
  expect("altitude_km,557.7\n110,1\n", "a single row");
  expect("altitude_km,557.7,5577\n100,1,1\n110,1,1\n", "both of 557.7 nm");
  expect("altitude_km,557.7\n10,1\n60,2\n", "80 and 640 km");
}

TEST(DrawnProfile, WithoutGreenLightHasNoBrightness) {
  Scene scene = scene_with_table("altitude_km,5577\n100,0\n110,0\n");
  check_profiles(scene);
  scene.sheets[0].brightness_kilorayleigh = 1.0;
  EXPECT_NE(message(scene).find("cannot be reached"), std::string::npos);
  scene = scene_with_table("altitude_km,6300\n100,1\n110,1\n", {630.0});
  scene.sheets[0].brightness_kilorayleigh = 1.0;
  EXPECT_NE(message(scene).find("557.7 nm"), std::string::npos);
}

}  // namespace
}  // namespace vegard::sim::drawn_profile_test
