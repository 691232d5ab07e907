// The height profile of light without electrons: its column, its place in a sheet, and derivatives.
#include "sim/light/line_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/light/electron.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::line_profile_test {
namespace {

const std::vector<double> kLines = {557.7, 610.0};

Scene scene_of_line() {
  return parse_scene(
      "[emission]\nlines = [557.7, 610.0]\n[blur]\nwidth_deg = [0.2, 0.0]\n[[sheet]]\nprofile = \"line\"\n"
      "line_nm = 610.0\nline_kilorayleigh = 3.0\npeak_km = 190.0\nlower_km = 40.0\nupper_km = 90.0\n",
      "steve.toml");
}

TEST(LineProfile, HasTheGivenColumnInItsLineAlone) {
  const Scene scene = scene_of_line();
  const HeightProfile profile = sheet_profile(kLines, scene, 0);
  EXPECT_NEAR(column_below(profile, 1, scene.sheets[0].top_km).rayleigh, 3000.0, 0.01);
  EXPECT_EQ(column_below(profile, 0, scene.sheets[0].top_km).rayleigh, 0.0);
  EXPECT_TRUE(has_given_brightness(scene.sheets[0]));
  EXPECT_FALSE(mean_energy_kev(scene.sheets[0]).has_value()) << "no electrons";
}

TEST(LineProfile, KeepsItsColumnBelowATopThatCutsItsLightOff) {
  Scene scene = scene_of_line();
  scene.sheets[0].top_km = 210.13;
  EXPECT_NEAR(column_below(sheet_profile(kLines, scene, 0), 1, 210.13).rayleigh, 3000.0, 0.01);
}

TEST(LineProfile, HasTheDerivativesOfItsDifferences) {
  for (const char* key : {"peak_km", "lower_km", "upper_km", "line_kilorayleigh"}) {
    const Scene scene = scene_of_line();
    const ParameterId id = resolve(scene, std::string("sheet.main.") + key).front().id;
    const std::vector<float> slope = profile_slope(kLines, scene, 0, id);
    ASSERT_FALSE(slope.empty()) << key;
    Scene more = scene, less = scene;
    const double value =
        std::stod(value_text(scene, resolve(scene, std::string("sheet.main.") + key).front()));
    const double step = 1e-2 * value;
    set_from_text(more, std::string("sheet.main.") + key, std::to_string(value + step));
    set_from_text(less, std::string("sheet.main.") + key, std::to_string(value - step));
    const HeightProfile above = sheet_profile(kLines, more, 0), below = sheet_profile(kLines, less, 0);
    double largest = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < slope.size(); ++i) {
      const double difference = (static_cast<double>(above.rate[i]) - below.rate[i]) / (2.0 * step);
      largest = std::max(largest, std::abs(difference));
      worst = std::max(worst, std::abs(difference - slope[i]));
    }
    EXPECT_GT(largest, 0.0) << key;
    // A central difference of a hundredth is off by its square times the third derivative, some tenths of a
    // per cent here.
    EXPECT_LT(worst, 0.02 * largest) << key;
  }
}

TEST(LineProfile, IsRefusedWhereItCannotShine) {
  const auto message_of = [](const std::string& text) {
    try {
      validate(parse_scene(text, "steve.toml"));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string of_line = "[[sheet]]\nprofile = \"line\"\n";
  EXPECT_TRUE(tests::has_facts(message_of(of_line + "line_nm = 610.0\n"), "sheet.main.line_nm | 610"));
  EXPECT_TRUE(tests::has_facts(message_of(of_line + "brightness_kilorayleigh = 5.0\n"),
                               "sheet.main.brightness_kilorayleigh | line_kilorayleigh"));
  EXPECT_TRUE(tests::has_facts(message_of(of_line + "[[footprint]]\nsource = \"sheets\"\n"),
                               "footprint | source | electrons"));
}

}  // namespace
}  // namespace vegard::sim::line_profile_test
