#include "sim/view/colour/eye.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/radiometry.h"

namespace vegard::sim::eye_test {
namespace {

EyeLight times(double rayleigh, const EyeLight& one) {
  EyeLight light = one;
  for (double& value : light.xyz_cd_m2) value *= rayleigh;
  light.scotopic_cd_m2 *= rayleigh;
  return light;
}

EyeLight green(double kilorayleigh) { return times(1e3 * kilorayleigh, eye_light_per_rayleigh(557.7)); }

double scotopic_over_photopic(double wavelength_nm) {
  const EyeLight light = eye_light_per_rayleigh(wavelength_nm);
  return light.scotopic_cd_m2 / light.xyz_cd_m2[1];
}

double luminance(const Vector3& rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

TEST(Rods, EfficiencyBetweenTheKnotsIsThatOfTheFinerTable) {
  // CIE 1951 at 1 nm (Wyszecki and Stiles 1982, table I(4.3.2)), between the 5 nm of data/cie; it has three
  // digits near the peak.
  for (const auto& [nm, efficiency] :
       {std::pair(391.0, 0.002547), std::pair(428.0, 0.1764), std::pair(507.0, 1.0), std::pair(558.0, 0.3569),
        std::pair(636.0, 0.002062)})
    EXPECT_NEAR(scotopic_efficiency(nm), efficiency, nm == 507.0 ? 1e-3 : 2e-3 * efficiency) << nm;
  EXPECT_EQ(scotopic_efficiency(379.9), 0.0);
  EXPECT_EQ(scotopic_efficiency(844.6), 0.0);
}

TEST(Rods, ScotopicOverPhotopicLuminanceOfTheLinesIsThatOfTheTables) {
  // 1700 V' / (683 V). V' at 557.7 and 427.8 nm from the 1 nm table, V from the CIE 1924 table.
  EXPECT_NEAR(scotopic_over_photopic(557.7), 1700 * 0.36128 / (683 * 0.9983), 3e-3);
  EXPECT_NEAR(scotopic_over_photopic(630.0), 1700 * 0.003335 / (683 * 0.265), 1e-5);
  EXPECT_NEAR(scotopic_over_photopic(427.8), 1700 * 0.17414 / (683 * 0.00968), 0.5);
  // The candela is one at 540 THz, 555.016 nm.
  EXPECT_NEAR(scotopic_over_photopic(555.016), 1.0, 2e-3);
}

// V' at 595 nm is some 300 times that at 670 nm: a few per cent of the photons near there are most of the
// light.
TEST(Eye, SeesAllBandsOfASetThatIsNamedAfterOne) {
  const EyeLight bands = eye_light_per_rayleigh(line_components(670.5)),
                 named = eye_light_per_rayleigh(670.5);
  EXPECT_GT(bands.scotopic_cd_m2, 3.0 * named.scotopic_cd_m2);
  EXPECT_NEAR(bands.xyz_cd_m2[1], luminance_cd_m2_per_rayleigh(line_components(670.5)), 1e-15);
  // A line is a set of one.
  EXPECT_EQ(eye_light_per_rayleigh(line_components(557.7)).scotopic_cd_m2,
            eye_light_per_rayleigh(557.7).scotopic_cd_m2);
}

TEST(Rods, DoNotSeeRedAurora) {
  const double red = eye_light_per_rayleigh(630.0).scotopic_cd_m2;
  EXPECT_LT(red / eye_light_per_rayleigh(557.7).scotopic_cd_m2, 0.01);
  // So 10 kR of it are nearly invisible, whatever their luminance: its rods' part is 3 %.
  const EyeLight light = times(1e4, eye_light_per_rayleigh(630.0));
  EXPECT_LT(luminance(seen_linear_srgb(light)), 0.05 * light.xyz_cd_m2[1]);
}

TEST(Rods, ApproximationFromColourIsThatOfABlackBodysSpectrum) {
  // Larson et al. 1997 fitted theirs to spectra of things; black bodies go through the same tables here.
  for (double kelvin : {2856.0, 4000.0, 6500.0}) {
    EyeLight light;
    for (int nm = 380; nm <= 780; nm += 5) {
      const double planck = std::pow(nm, -5.0) / std::expm1(1.438777e7 / (nm * kelvin));
      const Vector3 bar = colour_matching(nm);
      for (int i = 0; i < 3; ++i) light.xyz_cd_m2[i] += kLuminousEfficacy_lm_w * planck * bar[i];
      light.scotopic_cd_m2 += kScotopicEfficacy_lm_w * planck * scotopic_efficiency(nm);
    }
    EXPECT_NEAR(eye_light_of_colour(light.xyz_cd_m2).scotopic_cd_m2 / light.scotopic_cd_m2, 1.0, 0.1)
        << kelvin;
  }
  EXPECT_EQ(eye_light_of_colour({}).scotopic_cd_m2, 0.0);
}

TEST(Eye, RodsAndConesShareAlikeAtThePublishedLuminance) {
  EXPECT_EQ(rod_share(0.0), 1.0);
  EXPECT_NEAR(rod_share(0.04), 0.5, 1e-15);
  for (double y = 1e-6; y < 1e3; y *= 3.0) EXPECT_GT(rod_share(y), rod_share(3.0 * y));
  EXPECT_LT(rod_share(5.0), 0.01);
}

TEST(Eye, FaintLightIsTheGreyOfNightWhateverItsLine) {
  for (double nm : {427.8, 557.7}) {
    const EyeLight light = times(1e-3, eye_light_per_rayleigh(nm));
    const Vector3 seen = seen_linear_srgb(light);
    EXPECT_NEAR(luminance(seen) / light.scotopic_cd_m2, 1.0, 1e-4);
    EXPECT_NEAR(seen[0] / seen[1], 1.05 / 0.97, 1e-4);
    EXPECT_NEAR(seen[2] / seen[1], 1.27 / 0.97, 1e-4);
  }
}

TEST(Eye, BrightLightHasItsFullColour) {
  const EyeLight light = green(1e9);
  const Vector3 seen = seen_linear_srgb(light), line = rgb_of_line(557.7, Primaries::srgb);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(seen[c] / light.xyz_cd_m2[1], line[c] / colour_matching(557.7)[1], 1e-5);
}

TEST(Eye, ThreeKilorayleighAreGreyAndThreeHundredGreen) {
  // Colour vision begins between the second and the third class: WMO Cloud Atlas, "Polar aurora, brightness".
  const auto green_over_red = [](double kilorayleigh) {
    const Vector3 seen = seen_linear_srgb(green(kilorayleigh));
    return seen[1] / seen[0];
  };
  EXPECT_NEAR(green_over_red(3.0), 0.97 / 1.05, 0.03);
  EXPECT_GT(green_over_red(300.0), 1.5);
  for (double kilorayleigh = 0.1; kilorayleigh < 1e4; kilorayleigh *= 2.0)
    EXPECT_LT(green_over_red(kilorayleigh), green_over_red(2.0 * kilorayleigh));
}

TEST(Eye, MoreLightOfAnyLineLooksBrighter) {
  for (double nm : {391.4, 427.8, 520.0, 557.7, 630.0, 636.4}) {
    double before = 0.0, shown_before = 0.0;
    for (double rayleigh = 1.0; rayleigh < 1e9; rayleigh *= 1.5) {
      const Vector3 seen = seen_linear_srgb(times(rayleigh, eye_light_per_rayleigh(nm)));
      EXPECT_GT(luminance(seen), before) << nm << " nm, " << rayleigh << " R";
      before = luminance(seen);
      const Vector3 shown = displayed_as_seen(seen, kSeenHalf_cd_m2);
      const double most = std::max({shown[0], shown[1], shown[2]});
      EXPECT_GE(most, shown_before) << nm << " nm, " << rayleigh << " R";
      shown_before = most;
    }
  }
}

TEST(Eye, DisplayShowsTheHalfLuminanceAsHalfOfWhite) {
  const Vector3 half = displayed_as_seen({0.3, 0.3, 0.3}, 0.3);
  for (double value : half) EXPECT_NEAR(value, 0.5, 1e-12);
  // Ten times less is 1 / (1 + 10^0.73).
  EXPECT_NEAR(displayed_as_seen({0.03, 0.03, 0.03}, 0.3)[0], 1.0 / (1.0 + std::pow(10.0, 0.73)), 1e-12);
  EXPECT_EQ(displayed_as_seen({}, 0.3), (Vector3{}));
  const Vector3 clipped = displayed_as_seen({-1.0, 300.0, 1.0}, 0.3);
  EXPECT_EQ(clipped[0], 0.0);
  EXPECT_EQ(clipped[1], 1.0);
}

}  // namespace
}  // namespace vegard::sim::eye_test
