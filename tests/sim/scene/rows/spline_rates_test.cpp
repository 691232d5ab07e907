#include "sim/scene/rows/spline_rates.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::spline_rates_test {
namespace {

const char* const kFreeForm =
    "[[sheet]]\nprofile = \"spline\"\nspline_knots = 12\n"
    "[emission]\nlines = [557.7, 427.8]\n"
    "[fit]\nfree = [\"sheet.main.spline_rate\"]\n";

/// The message of the error that a scene text causes.
std::string complaint(const std::string& text) {
  try {
    parse_scene(text, "scene.toml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SplineRates, AreFilledInWhereTheFileHasNone) {
  const Scene scene = parse_scene(kFreeForm, "scene.toml");
  ASSERT_EQ(scene.sheets[0].spline_rate.size(), 24u);
  for (const double rate : scene.sheets[0].spline_rate) EXPECT_GT(rate, 0.0);
  const std::vector<ParameterPath> paths = resolve(scene, "sheet.spline_rate");
  ASSERT_EQ(paths.size(), 24u);
  EXPECT_EQ(paths[0].text, "sheet.main.spline_rate.5577_0");
  EXPECT_EQ(paths[15].text, "sheet.main.spline_rate.4278_3");
  EXPECT_EQ(real_value(scene, paths[15]), &scene.sheets[0].spline_rate[15]);
}

TEST(SplineRates, SurviveWritingAndReading) {
  Scene scene = parse_scene(kFreeForm, "scene.toml");
  scene.sheets[0].spline_rate[7] = 12.345678901234567;
  const Scene again = parse_scene(write_scene(scene), "again.toml");
  EXPECT_EQ(again.sheets[0].spline_rate, scene.sheets[0].spline_rate);
}

TEST(SplineRates, FollowTheLinesAndTheKnots) {
  Scene scene = parse_scene(kFreeForm, "scene.toml");
  set_from_text(scene, "sheet.main.spline_rate.4278_3", "77.0");
  set_from_text(scene, "emission.lines", "[427.8, 630.0, 557.7]");
  ASSERT_EQ(scene.sheets[0].spline_rate.size(), 36u);
  EXPECT_EQ(scene.sheets[0].spline_rate[3], 77.0);
  set_from_text(scene, "sheet.main.spline_knots", "20");
  EXPECT_EQ(scene.sheets[0].spline_rate.size(), 60u);
  set_from_text(scene, "sheet.main.profile", "\"maxwellian\"");
  set_from_text(scene, "fit.free", "[]");
  EXPECT_NO_THROW(validate(scene));
}

TEST(SplineRates, AProfileSetLaterIsFilledIn) {
  Scene scene = parse_scene("[[sheet]]\n", "scene.toml");
  EXPECT_TRUE(scene.sheets[0].spline_rate.empty());
  set_from_text(scene, "sheet.main.profile", "\"spline\"");
  EXPECT_EQ(scene.sheets[0].spline_rate.size(), 3u * scene.sheets[0].spline_knots);
  EXPECT_NO_THROW(validate(scene));
}

TEST(SplineRates, WhatCannotBeIsRefused) {
  EXPECT_TRUE(tests::has_facts(
      complaint("[[sheet]]\nprofile = \"spline\"\nspline_knots = 5\nspline_rate = [1.0, 2.0]\n"),
      "2 coefficients | 3 emission lines | 5 knots"));
  EXPECT_NE(complaint("[[sheet]]\nprofile = \"spline\"\nspline_bottom_km = 300\nspline_top_km = 200\n")
                .find("300 and 200"),
            std::string::npos);
  EXPECT_NE(
      complaint("[[sheet]]\nprofile = \"spline\"\nbrightness_kilorayleigh = 3.0\n").find("own brightness"),
      std::string::npos);
  EXPECT_NE(complaint("[[sheet]]\nprofile = \"spline\"\n[fit]\nfree = [\"sheet.main.energy_kev\"]\n")
                .find("electrons' energy"),
            std::string::npos);
  EXPECT_TRUE(tests::has_facts(complaint("[[sheet]]\nprofile = \"spline\"\ntop_km = 300\n"), "500 km | 300"));
  EXPECT_NE(complaint("[[sheet]]\nprofile = \"spline\"\n[fit]\n"
                      "free = [\"sheet.main.energy_flux_mw_m2\", \"sheet.spline_rate\"]\n")
                .find("energy flux"),
            std::string::npos);
  EXPECT_EQ(complaint("[[sheet]]\nprofile = \"spline\"\ntop_km = 300\nspline_top_km = 300\n[fit]\n"
                      "free = [\"sheet.main.energy_flux_mw_m2\"]\n"),
            "")
      << "a profile that is known";
  EXPECT_NE(complaint("[[sheet]]\n[fit]\nfree = [\"sheet.main.spline_rate\"]\n").find("no coefficients"),
            std::string::npos);
  EXPECT_NE(complaint("[[sheet]]\n[fit]\nfree = [\"sheet.main.peak_km\"]\n").find("peak_km has no effect"),
            std::string::npos);
  EXPECT_EQ(complaint("[[sheet]]\nprofile = \"form\"\n[fit]\nfree = [\"sheet.main.peak_km\"]\n"), "");
}

}  // namespace
}  // namespace vegard::sim::spline_rates_test
