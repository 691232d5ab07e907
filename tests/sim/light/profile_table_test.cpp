#include "sim/light/profile_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/light/sheet_profile.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::profile_table_test {
namespace {

const std::vector<double> kLines = {630.0, 557.7, 427.8};

HeightProfile direct(const Scene& scene, const Footprint& f, double energy_kev) {
  Scene one;
  one.emission = scene.emission;
  Sheet sheet;
  sheet.energy_kev = energy_kev;
  sheet.energy_flux_mw_m2 = f.energy_flux_mw_m2;
  sheet.profile = f.profile;
  sheet.energy_spread = f.energy_spread;
  one.sheets = {sheet};
  return sheet_profile(kLines, one, 0);
}

TEST(ProfileTable, OfOneEnergyHasThatProfileAlone) {
  Scene scene;
  Footprint f;
  f.top_km = 300.1;
  const ProfileTable table = profile_table(kLines, scene, f, 0.0, 0.0);
  ASSERT_EQ(table.of_energy.size(), 1u);
  EXPECT_EQ(table.ln_first, 0.0);
  EXPECT_EQ(table.ln_step, 0.0);
  const HeightProfile own = direct(scene, f, f.energy_kev);
  const HeightProfile& of = table.of_energy[0];
  for (int a = 0; a < HeightProfile::kAltitudes; ++a)
    for (int l = 0; l < 3; ++l) {
      // The first altitude at or above 300.1 km is 300.25 km.
      const bool lit = HeightProfile::altitude_km(a) <= 300.25;
      EXPECT_EQ(of.rate[a * 4 + l], lit ? own.rate[a * 4 + l] : 0.0f);
      EXPECT_EQ(of.d_rate_d_ln_energy[a * 4 + l], lit ? own.d_rate_d_ln_energy[a * 4 + l] : 0.0f);
    }
}

TEST(ProfileTable, BetweenItsEnergiesIsWithinThreeThousandthsOfThePeak) {
  Scene scene;
  for (const char* profile : {"maxwellian", "gaussian"}) {
    Footprint f;
    f.profile = tests::kind_named<ProfileKind>(profile);
    f.top_km = 640.0;
    // A Gaussian is a sum of many narrow spectra, which takes its time.
    const double reach = f.profile == ProfileKind::gaussian ? 0.1 : 1.0;
    const ProfileTable table = profile_table(kLines, scene, f, -reach, reach);
    for (const double part : {0.13, 0.5, 0.77}) {
      // Half way between two entries, where it is worst.
      const double n = std::floor(part * static_cast<double>(table.of_energy.size() - 1)) + 0.5;
      const HeightProfile own = direct(scene, f, f.energy_kev * std::exp(table.ln_first + n * table.ln_step));
      const HeightProfile &below = table.of_energy[static_cast<std::size_t>(n)],
                          &above = table.of_energy[static_cast<std::size_t>(n) + 1];
      for (int l = 0; l < 3; ++l) {
        double peak = 0.0, worst = 0.0;
        for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
          const std::size_t i = static_cast<std::size_t>(a) * 4 + l;
          peak = std::max(peak, static_cast<double>(own.rate[i]));
          worst = std::max(worst, std::abs(0.5 * (below.rate[i] + above.rate[i]) - own.rate[i]));
        }
        EXPECT_LT(worst, 0.003 * peak) << profile << " " << kLines[l] << " " << part;
      }
    }
  }
}

TEST(ProfileTable, EndsWhereTheEmissionTablesEnd) {
  Scene scene;
  Footprint f;
  f.energy_kev = 15.0;
  const ProfileTable table = profile_table(kLines, scene, f, std::log(0.9), std::log(20.0));
  EXPECT_NEAR(15.0 * std::exp(table.ln_first), 13.5, 1e-9);
  const double last = table.ln_first + table.ln_step * static_cast<double>(table.of_energy.size() - 1);
  EXPECT_NEAR(15.0 * std::exp(last), 20.0, 1e-9);
}

}  // namespace
}  // namespace vegard::sim::profile_table_test
