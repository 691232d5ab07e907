#include "sim/light/sheet_profile.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vegard::sim::sheet_profile_test {
namespace {

TEST(SheetProfile, OfAGivenBrightnessHasItInGreenWhateverTheLinesAndTheEnergy) {
  Sheet sheet;
  sheet.brightness_kilorayleigh = 10.0;
  for (const char* profile : {"maxwellian", "mono", "gaussian", "form"}) {
    for (double energy : {0.4, 3.0, 12.0}) {
      sheet.profile = tests::kind_named<ProfileKind>(profile);
      sheet.energy_kev = energy;
      const HeightProfile both = sheet_profile({427.8, 557.7}, tests::with_sheet(sheet), 0);
      EXPECT_NEAR(column_below(both, 1, sheet.top_km).rayleigh, 10000.0, 0.01);
      EXPECT_NEAR(column_below(both, 1, sheet.top_km).d_rayleigh_d_ln_energy, 0.0, 0.1);
      sheet.brightness_kilorayleigh = 20.0;
      const HeightProfile blue = sheet_profile({427.8}, tests::with_sheet(sheet), 0);
      sheet.brightness_kilorayleigh = 10.0;
      for (int a = 0; a < HeightProfile::kAltitudes; a += 50)
        EXPECT_NEAR(blue.rate[4 * a], 2.0 * both.rate[4 * a], 1e-6 * blue.rate[4 * a]);
    }
  }
}

TEST(SheetProfile, DerivativeByTheEnergyIsThatOfTheRate) {
  // Differences of floats, as for the Maxwellian profile.
  constexpr double h = 0.01;
  Sheet sheet;
  sheet.brightness_kilorayleigh = 10.0;
  for (const char* profile : {"maxwellian", "mono", "gaussian", "form"}) {
    sheet.profile = tests::kind_named<ProfileKind>(profile);
    const auto at = [&](double energy) {
      sheet.energy_kev = energy;
      return sheet_profile({630.0, 557.7, 427.8}, tests::with_sheet(sheet), 0);
    };
    const HeightProfile here = at(3.0), more = at(3.0 * std::exp(h)), less = at(3.0 * std::exp(-h));
    for (int l = 0; l < 3; ++l) {
      double peak = 0.0;
      for (int a = 0; a < HeightProfile::kAltitudes; ++a)
        peak = std::max<double>(peak, std::abs(here.d_rate_d_ln_energy[a * 4 + l]));
      ASSERT_GT(peak, 0.0);
      for (int a = 0; a < HeightProfile::kAltitudes; a += 3)
        EXPECT_NEAR(here.d_rate_d_ln_energy[a * 4 + l],
                    (more.rate[a * 4 + l] - less.rate[a * 4 + l]) / (2 * h),
                    1e-3 * peak + 1.2e-7 / h * here.rate[a * 4 + l])
            << profile << ", line " << l << ", altitude " << HeightProfile::altitude_km(a);
    }
  }
}

TEST(SheetProfile, FollowsTheColumnsOfItsEnergyFlux) {
  Sheet sheet;
  sheet.energy_kev = 20.0;
  const auto green = [&](double flux, const char* law) {
    sheet.energy_flux_mw_m2 = flux;
    Scene scene = tests::with_sheet(sheet);
    scene.emission.tables = "glow";
    scene.emission.flux_law = tests::kind_named<FluxLaw>(law);
    return column_below(sheet_profile({557.7}, scene, 0), 0, HeightProfile::kTopKm).rayleigh;
  };
  // 4723.8 R to 410.1 R above the background, data/glow/linearity_Q.csv.
  for (const char* profile : {"maxwellian", "form"}) {
    sheet.profile = tests::kind_named<ProfileKind>(profile);
    EXPECT_EQ(green(10.0, "linear"), green(1.0, "linear"));
    EXPECT_EQ(green(1.0, "column"), green(1.0, "linear"));
    if (sheet.profile == ProfileKind::maxwellian) {
      EXPECT_NEAR(green(10.0, "column") / green(1.0, "column"), 1.1519, 1e-4);
    }
    EXPECT_GT(green(10.0, "column"), 1.05 * green(1.0, "column"));
  }
}

TEST(SheetProfile, SlopesAreThoseOfTheRate) {
  // Differences of floats over 2 % of Q, in a law that changes rates by a few per cent over a factor of ten.
  constexpr double h = 0.1;
  Sheet sheet;
  sheet.energy_kev = 7.0;
  const std::vector<double> lines = {630.0, 557.7, 427.8};
  for (const char* profile : {"maxwellian", "form"}) {
    sheet.profile = tests::kind_named<ProfileKind>(profile);
    for (const double flux : {0.4, 5.0, 14.0}) {
      const auto at = [&](double q) {
        sheet.energy_flux_mw_m2 = q;
        return sheet_profile(lines, tests::with_sheet(sheet), 0);
      };
      const HeightProfile here = at(flux), more = at(flux * (1.0 + h)), less = at(flux * (1.0 - h));
      sheet.energy_flux_mw_m2 = flux;
      const Scene scene = tests::with_sheet(sheet);
      const std::vector<float> slope =
          profile_slope(lines, scene, 0, parameter_with(ParameterRole::energy_flux, 0));
      ASSERT_EQ(slope.size(), here.rate.size());
      double largest = 0.0;
      for (std::size_t i = 0; i < slope.size(); ++i) {
        const double difference = (static_cast<double>(more.rate[i]) - less.rate[i]) / (2 * h * flux);
        EXPECT_NEAR(slope[i], difference, 3e-4 * here.rate[i] / flux + 1e-30) << profile << " " << flux;
        largest = std::max<double>(largest, std::abs(slope[i]) * flux / std::max(here.rate[i], 1e-20f));
      }
      EXPECT_GT(largest, 0.01) << "there is something to test";
    }
  }
  Scene scene = tests::with_sheet(sheet);
  EXPECT_TRUE(profile_slope(lines, scene, 0, parameter_at(scene, "sheet.width_km").value()).empty());
  scene.emission.flux_law = FluxLaw::linear;
  EXPECT_TRUE(profile_slope(lines, scene, 0, parameter_with(ParameterRole::energy_flux, 0)).empty());
}

}  // namespace
}  // namespace vegard::sim::sheet_profile_test
