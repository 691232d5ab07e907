// The height profile of protons: peak altitudes, ratios, derivatives.
#include "sim/light/proton_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/light/line_light.h"
#include "sim/light/sheet_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::proton_profile_test {
namespace {

const std::vector<double> kLines = {427.8, 486.1, 557.7, 656.3};

Scene scene_of_protons(double energy_kev) {
  Scene scene = parse_scene(
      "[emission]\nlines = [427.8, 486.1, 557.7, 656.3]\n[blur]\nwidth_deg = [0, 0, 0, 0]\n[[sheet]]\n"
      "form = \"proton_arc\"\nline_kilorayleigh = 0.2\n",
      "protons.toml");
  scene.sheets[0].energy_kev = energy_kev;
  return scene;
}

TEST(ProtonProfile, HasTheGivenBrightnessAndTheRatiosOfItsSources) {
  const HeightProfile profile = sheet_profile(kLines, scene_of_protons(5.0), 0);
  const double beta = column_below(profile, 1, 500.0).rayleigh;
  EXPECT_NEAR(beta, 200.0, 0.01);
  // Hβ over N2+ 470.9 nm is 3.0, and 470.9 nm is 0.21 of 427.8 nm.
  EXPECT_NEAR(beta / (0.21 * column_below(profile, 0, 500.0).rayleigh), 3.0, 0.01);
  EXPECT_EQ(column_below(profile, 2, 500.0).rayleigh, 0.0) << "no line of theirs";
  EXPECT_GT(column_below(profile, 3, 500.0).rayleigh, 2.0 * beta);
}

TEST(ProtonProfile, PeaksInTheERegionAndLowerForMoreEnergy) {
  // Protons of some keV deposit their energy at 100 to 160 km (Galand, www.bu.edu/csp/uv/proton).
  double last_km = 160.0;
  for (const double energy : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
    const LineLight light = line_light(486.1, scene_of_protons(energy), 0);
    EXPECT_LT(light.peak_km, last_km) << energy;
    EXPECT_GT(light.peak_km, 100.0) << energy;
    last_km = light.peak_km;
  }
}

TEST(ProtonProfile, HasTheDerivativeByItsEnergy) {
  constexpr double h = 1e-3;
  const HeightProfile here = sheet_profile(kLines, scene_of_protons(5.0), 0),
                      above = sheet_profile(kLines, scene_of_protons(5.0 * std::exp(h)), 0),
                      below = sheet_profile(kLines, scene_of_protons(5.0 * std::exp(-h)), 0);
  double largest = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < here.rate.size(); ++i) {
    const double difference = (static_cast<double>(above.rate[i]) - below.rate[i]) / (2.0 * h);
    largest = std::max(largest, std::abs(difference));
    worst = std::max(worst, std::abs(difference - here.d_rate_d_ln_energy[i]));
  }
  // Rates are floats: their rounding over 2 h is some 1e-4 of the largest rate.
  EXPECT_LT(worst, 1e-3 * largest);
}

TEST(ProtonProfile, IsRefusedForALineThatProtonsDoNotHave) {
  try {
    validate(parse_scene("[[sheet]]\nprofile = \"proton\"\nline_nm = 557.7\n", "x.toml"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(tests::has_facts(error.what(), "sheet.main.line_nm | 486.1"));
  }
}

TEST(ProtonProfile, LinesThatAreCheckedAreLinesThatShine) {
  for (const double nm : {391.4, 427.8, 486.1, 656.3}) EXPECT_TRUE(is_of_protons(nm)) << nm;
  for (const double nm : {557.7, 630.0, 610.0}) EXPECT_FALSE(is_of_protons(nm)) << nm;
}

}  // namespace
}  // namespace vegard::sim::proton_profile_test
