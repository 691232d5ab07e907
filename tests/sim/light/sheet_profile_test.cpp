#include "sim/light/sheet_profile.h"
#include "tests/support/one_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vegard::sim {
namespace {

TEST(SheetProfile, OfAGivenBrightnessHasItInGreenWhateverTheLinesAndTheEnergy) {
  Sheet sheet;
  sheet.brightness_kilorayleigh = 10.0;
  for (const char* profile : {"maxwellian", "mono", "gaussian", "form"}) {
    for (double energy : {0.4, 3.0, 12.0}) {
      sheet.profile = profile;
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
    sheet.profile = profile;
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

}  // namespace
}  // namespace vegard::sim
