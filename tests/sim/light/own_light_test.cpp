#include "sim/light/own_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/light/excited_atom.h"
#include "sim/light/line_light.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/render.h"
#include "sim/scene/file/inert_keys.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/view/colour/line_colours.h"
#include "tests/support/bad_scene.h"
#include "tests/support/same_bytes.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::own_light_test {
namespace {

Scene with_own(const OwnLine& own, const std::vector<double>& lines_nm) {
  Scene scene = tests::small_scene();
  scene.own_lines = {own};
  change_lines(scene, lines_nm);
  return scene;
}

OwnLine follower(double wavelength_nm, double follows_nm, double ratio, double lifetime_s) {
  OwnLine own;
  own.name = "mine";
  own.wavelength_nm = wavelength_nm;
  own.follows_nm = follows_nm;
  own.ratio = ratio;
  own.lifetime_s = lifetime_s;
  return own;
}

/// That of a sheet that changes, so that light lags, with all that goes by a line: quenching, blur, colour.
Rendering moving(Scene scene) {
  scene.sheets[0].drift_km_s = {0.0, 1.0};
  return render(scene, {});
}

TEST(OwnLight, OfTheNumbersOfAListedLineIsThatLine) {
  const std::vector<double> lines = {630.0, 557.7, 427.8};
  Scene listed = tests::small_scene();
  change_lines(listed, lines);
  const Rendering known = moving(listed), own = moving(with_own(follower(630.0, 630.0, 1.0, 110.0), lines));
  EXPECT_TRUE(tests::same_bytes(known.rayleigh.data, own.rayleigh.data));
  EXPECT_TRUE(tests::same_bytes(known.rgb.data, own.rgb.data));
}

TEST(OwnLight, FollowsAnotherLineByItsRatio) {
  // 636.4 nm has 1/2.997 of the photons of 630.0 nm; what is left is the rounding of floats, 6e-8 of the
  // rate each time. A form's slope is made of the difference of two rates, each rounded once on either side:
  // 4 times 6e-8 of the rate; the tables' slope is that difference over a step of 0.23 of ln E, 4 times 6e-8 / 0.23. Light below 1e-12 of the peak does not count.
  const Scene listed = [] {
    Scene scene = tests::small_scene();
    change_lines(scene, {636.4});
    return scene;
  }();
  const Scene own =
      with_own(follower(636.4, 630.0, 1.0 / 2.997, find_emission_line(636.4)->lifetime_s), {636.4});
  for (const ProfileKind kind :
       {ProfileKind::maxwellian, ProfileKind::mono, ProfileKind::gaussian, ProfileKind::form}) {
    Scene a = listed, b = own;
    a.sheets[0].profile = b.sheets[0].profile = kind;
    const HeightProfile known = sheet_profile({636.4}, a, 0), mine = sheet_profile({636.4}, b, 0);
    const float faint = 1e-12f * *std::max_element(known.rate.begin(), known.rate.end());
    for (std::size_t i = 0; i < known.rate.size(); ++i) {
      if (known.rate[i] < faint) continue;
      ASSERT_NEAR(mine.rate[i], known.rate[i], 3e-7f * known.rate[i]) << i;
      ASSERT_NEAR(mine.d_rate_d_ln_energy[i], known.d_rate_d_ln_energy[i],
                  1e-6f * std::fabs(known.d_rate_d_ln_energy[i]) + 1.05e-6f * known.rate[i]);
    }
  }
}

TEST(OwnLight, OfALineThatFollowsLosesAsMuchByCollisions) {
  const Scene own = with_own(follower(700.0, 630.0, 0.5, 110.0), {700.0});
  const Air air = standard_air(150.0);
  EXPECT_EQ(effective_lifetime_s(*find_line(own, 700.0), air),
            effective_lifetime_s(*find_emission_line(630.0), air));
  EXPECT_EQ(own.blur.width_deg, std::vector<double>{default_blur_width_deg(630.0)});
  OwnLine free = follower(700.0, 0.0, 1.0, 5.0);
  EXPECT_EQ(effective_lifetime_s(*find_line(with_own(free, {700.0}), 700.0), air), 5.0);
  EXPECT_FALSE(is_prompt(*find_line(with_own(free, {700.0}), 700.0)));
}

TEST(OwnLight, OfALayerHasItsColumnItsPeakAndItsScaleHeight) {
  OwnLine own;
  own.name = "layer";
  own.wavelength_nm = 700.0;
  own.rayleigh_per_mw_m2 = 250.0;
  own.peak_km = 160.0;
  own.scale_height_km = 14.0;
  Scene scene = with_own(own, {557.7, 700.0});
  for (const ProfileKind kind : {ProfileKind::maxwellian, ProfileKind::layer}) {
    scene.sheets[0].profile = kind;
    const HeightProfile profile = sheet_profile({557.7, 700.0}, scene, 0);
    // 0.1 times the integral of a Chapman layer is what it was given; the ends of the profile are 5.7 scale
    // heights below the peak, where nothing is left, and 34 above it.
    EXPECT_NEAR(column_below(profile, 1, 640.0).rayleigh, 250.0, 0.01);
    EXPECT_EQ(column_below(profile, 0, 640.0).rayleigh > 0.0, kind == ProfileKind::maxwellian);
    const LineLight light = line_light(700.0, scene, 0);
    EXPECT_NEAR(light.peak_km, 160.0, 1e-3);
    // Far above the peak it falls by e over the scale height.
    const auto rate = [&](double h) {
      return profile.rate[static_cast<std::size_t>((h - 80.0) / 0.25) * profile.stride + 1];
    };
    EXPECT_NEAR(std::log(rate(300.0) / rate(314.0)), 1.0, 1e-4);
  }
}

TEST(OwnLight, OfAColumnOfAFileIsThatColumnWhateverElseTheLineHas) {
  OwnLine own = follower(486.1, 557.7, 10.0, 0.0);
  Scene scene = with_own(own, {557.7, 486.1});
  Sheet& sheet = scene.sheets[0];
  sheet.profile = ProfileKind::file;
  sheet.profile_file = "drawn.csv";
  const std::string path = "sheet." + sheet.name + ".profile_file";
  scene.tables[path] = "altitude_km,557.7,486.1\n100,20,8\n140,20,8\n";
  const auto at_120 = [&] {
    const HeightProfile profile = sheet_profile({557.7, 486.1}, scene, 0);
    return profile.rate[static_cast<std::size_t>(160) * profile.stride + 1];
  };
  EXPECT_EQ(at_120(), 8.0f);
  scene.tables[path] = "altitude_km,557.7\n100,20\n140,20\n";
  EXPECT_EQ(at_120(), 200.0f);
}

TEST(OwnLight, HasTheColourOfItsWavelength) {
  const Scene h_beta = [] {
    Scene scene;
    change_lines(scene, {486.1});
    return scene;
  }();
  const Scene near = with_own(follower(486.2, 557.7, 1.0, 0.0), {486.2});
  const Vector3 listed = line_colours(h_beta)[0], own = line_colours(near)[0];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(own[c], listed[c], 0.02 * std::fabs(listed[2])) << c;
  EXPECT_GT(own[2], own[0]);
}

TEST(OwnLight, IsReadAndWrittenWithTheScene) {
  const std::string text =
      "[[line]]\nname = \"h_beta\"\nwavelength_nm = 486.1\nfollows_nm = 427.8\nratio = 0.1\n\n"
      "[emission]\nlines = [557.7, 486.1]\n\n[[sheet]]\n";
  const Scene scene = parse_scene(text, "proton.toml");
  EXPECT_EQ(scene.own_lines.at(0).ratio, 0.1);
  const Scene again = parse_scene(write_scene(scene, ""), "again.toml");
  EXPECT_EQ(again.own_lines.at(0).follows_nm, 427.8);
  EXPECT_EQ(again.emission.lines, scene.emission.lines);
}

TEST(OwnLight, ThatNobodyWouldSeeIsTold) {
  const auto told = [](const std::string& text) {
    std::string all;
    for (const std::string& line : inert_keys(parse_scene(text, "a.toml"))) all += line + "\n";
    return all;
  };
  EXPECT_TRUE(tests::has_facts(told("[[line]]\nname = \"x\"\nwavelength_nm = 500.0\n[[sheet]]\n"),
                               "a.toml:3: | line.x.wavelength_nm: | emission.lines"));
  const std::string shown = "[emission]\nlines = [500.0]\n[[sheet]]\n";
  EXPECT_NE(told("[[line]]\nname = \"x\"\nwavelength_nm = 500.0\n" + shown).find("nothing"),
            std::string::npos);
  EXPECT_NE(
      told("[[line]]\nname = \"x\"\nwavelength_nm = 500.0\nratio = 2\n" + shown).find("follows no other"),
      std::string::npos);
  EXPECT_EQ(told("[[line]]\nname = \"x\"\nwavelength_nm = 500.0\nfollows_nm = 557.7\nratio = 2\n" + shown),
            "");
}

class BadOwnLine : public ::testing::TestWithParam<Bad> {};
TEST_P(BadOwnLine, IsRefusedInItsLine) { expect_refused(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    OwnLight, BadOwnLine,
    ::testing::Values(
        Bad{"unknown", "[emission]\nlines = [557.7,\n500.0]\n", 3, "emission.lines", "500 nm | 9.4"},
        Bad{"twice", "[[line]]\nname = \"a\"\n[[line]]\nname = \"b\"\nwavelength_nm = 486.12\n", 5,
            "line.b.wavelength_nm", "'a' | 'b' | 486.12 nm"},
        Bad{"bands", "[[line]]\nwavelength_nm = 670.5\n", 2, "line.line.wavelength_nm", "a set"},
        Bad{"follows", "[[line]]\nfollows_nm = 656.3\n", 2, "line.line.follows_nm", "656.3 nm | 337.1"},
        Bad{"both", "[[line]]\nfollows_nm = 557.7\nrayleigh_per_mw_m2 = 3\n", 3,
            "line.line.rayleigh_per_mw_m2", "one of"},
        Bad{"dark_layers", "[[sheet]]\nprofile = \"layer\"\n", 2, "sheet.main.profile", "nothing shines"}),
    [](const auto& info) { return std::string(info.param.what); });

}  // namespace
}  // namespace vegard::sim::own_light_test
