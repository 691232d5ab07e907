#include "sim/light/tables/light_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "sim/base/error.h"
#include "sim/light/sheet_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/table/emission_folder.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::light_modes_test {
namespace {

const std::vector<double> kLinesNm = {630.0, 557.7, 427.8};

/// Two modes that differ by line, energy and altitude.
std::string two_modes() {
  std::string text = "mode,E0_keV,altitude_km,ver_4278,ver_5577,ver_6300\n";
  for (const int mode : {1, 2})
    for (const double energy : {0.1, 1.0, 20.0})
      for (const double altitude : {80.0, 110.0, 200.0, 640.0}) {
        const double x = 0.1 * mode + 0.05 * std::log(energy) + 0.001 * altitude;
        text += std::to_string(mode) + "," + std::to_string(energy) + "," + std::to_string(altitude);
        for (const double of_line : {1.0, -2.0, 0.7}) text += "," + std::to_string(of_line * x);
        text += "\n";
      }
  return text;
}

LightModes modes() { return LightModes(read_csv_table(two_modes(), "modes.csv")); }

TEST(LightModes, AreLinearInAltitudeAndLogarithmOfTheEnergy) {
  const LightModes two = modes();
  ASSERT_EQ(two.count(), 2);
  // What the table is made by is linear in both, so that it holds between the rows too.
  for (const double energy : {0.3, 1.0, 7.0}) {
    const std::vector<ModeValue> green = two.at(1, "ver_5577", energy, {95.0, 110.0, 300.0});
    EXPECT_NEAR(green[0].value, -2.0 * (0.2 + 0.05 * std::log(energy) + 0.095), 2e-6);
    EXPECT_NEAR(green[2].value, -2.0 * (0.2 + 0.05 * std::log(energy) + 0.300), 2e-6);
    EXPECT_NEAR(green[1].slope, -2.0 * 0.05, 2e-6);
  }
}

TEST(LightModes, AreConstantBeyondTheTableAndZeroForOtherColumns) {
  const LightModes two = modes();
  EXPECT_EQ(two.at(0, "ver_4278", 0.01, {70.0})[0].value, two.at(0, "ver_4278", 0.1, {80.0})[0].value);
  EXPECT_EQ(two.at(0, "ver_4278", 0.01, {70.0})[0].slope, 0.0);
  EXPECT_EQ(two.at(0, "ver_7774", 1.0, {100.0})[0].value, 0.0);
}

TEST(LightModes, RefuseRowsThatAreMissing) {
  std::string text = two_modes();
  text.resize(text.rfind('\n', text.size() - 2) + 1);
  EXPECT_THROW(LightModes(read_csv_table(text, "modes.csv")), Error);
}

Scene scene_with_modes(ProfileKind profile, double brightness) {
  TableFolder folder = *built_in_tables("vegard");
  folder.place = "made";
  folder.files[kModesFile] = two_modes();
  Sheet sheet;
  sheet.profile = profile;
  sheet.energy_kev = 3.0;
  sheet.energy_spread = 0.3;
  sheet.brightness_kilorayleigh = brightness;
  Scene scene = tests::with_sheet(sheet);
  scene.emission.tables = "made";
  scene.emission.folder = std::make_shared<const TableFolder>(folder);
  scene.emission.modes = {0.4, -0.7};
  return scene;
}

TEST(LightModes, ScaleTheLightOfAProfile) {
  Scene scene = scene_with_modes(ProfileKind::maxwellian, 0.0);
  const HeightProfile with = sheet_profile(kLinesNm, scene, 0);
  scene.emission.modes.clear();
  const HeightProfile without = sheet_profile(kLinesNm, scene, 0);
  const int row = static_cast<int>((120.0 - HeightProfile::kBottomKm) / HeightProfile::kStepKm);
  const auto i = static_cast<std::size_t>(row * with.stride + 1);
  const double x1 = 0.1 + 0.05 * std::log(3.0) + 0.120, x2 = x1 + 0.1;
  EXPECT_NEAR(std::log(with.rate[i] / without.rate[i]), -2.0 * (0.4 * x1 - 0.7 * x2), 1e-4);
}

// Central differences, step 0.01: a step squared over 6 of the third derivative, below 1e-5 of the rate for
// changes of the logarithm below 1.2 per unit; and rounding to floats.
TEST(LightModes, ProfilesHaveTheirDerivatives) {
  for (const ProfileKind profile :
       {ProfileKind::maxwellian, ProfileKind::mono, ProfileKind::gaussian, ProfileKind::form})
    for (const double brightness : {0.0, 10.0})
      for (const int mode : {0, 1}) {
        Scene scene = scene_with_modes(profile, brightness);
        ParameterId id = parameter_with(ParameterRole::light_mode, -1);
        id.component = mode;
        const std::vector<float> slope = profile_slope(kLinesNm, scene, 0, id);
        const HeightProfile here = sheet_profile(kLinesNm, scene, 0);
        ASSERT_EQ(slope.size(), here.rate.size());
        constexpr double kStep = 0.01;
        const double value = scene.emission.modes[static_cast<std::size_t>(mode)];
        scene.emission.modes[static_cast<std::size_t>(mode)] = value + kStep;
        const HeightProfile more = sheet_profile(kLinesNm, scene, 0);
        scene.emission.modes[static_cast<std::size_t>(mode)] = value - kStep;
        const HeightProfile less = sheet_profile(kLinesNm, scene, 0);
        double largest = 0.0;
        for (const float s : slope) largest = std::max<double>(largest, std::abs(s));
        ASSERT_GT(largest, 0.0);
        for (std::size_t i = 0; i < slope.size(); ++i)
          EXPECT_NEAR(slope[i], (more.rate[i] - less.rate[i]) / (2.0 * kStep),
                      2e-4 * largest + 1.2e-7 / kStep * here.rate[i]);
      }
}

TEST(LightModes, DerivativesByTheEnergyContainThem) {
  for (const ProfileKind profile : {ProfileKind::maxwellian, ProfileKind::mono}) {
    Scene scene = scene_with_modes(profile, 0.0);
    const HeightProfile here = sheet_profile(kLinesNm, scene, 0);
    constexpr double kStep = 1e-3;
    scene.sheets[0].energy_kev = 3.0 * std::exp(kStep);
    const HeightProfile more = sheet_profile(kLinesNm, scene, 0);
    scene.sheets[0].energy_kev = 3.0 * std::exp(-kStep);
    const HeightProfile less = sheet_profile(kLinesNm, scene, 0);
    double largest = 0.0;
    for (const float s : here.d_rate_d_ln_energy) largest = std::max<double>(largest, std::abs(s));
    for (std::size_t i = 0; i < here.rate.size(); ++i)
      EXPECT_NEAR(here.d_rate_d_ln_energy[i], (more.rate[i] - less.rate[i]) / (2.0 * kStep),
                  2e-4 * largest + 1.2e-7 / kStep * here.rate[i]);
  }
}

}  // namespace
}  // namespace vegard::sim::light_modes_test
