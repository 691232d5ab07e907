#include "sim/light/height_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "sim/base/error.h"
#include "sim/light/tables/emission_table.h"
#include "sim/scene/lines/emission_lines.h"
#include "tests/support/glow.h"
#include "tests/support/source_folder.h"

namespace vegard::sim::height_profile_test {
namespace {

double column_rayleigh(const HeightProfile& profile, int line) {
  double sum = 0.0;
  for (int a = 0; a + 1 < HeightProfile::kAltitudes; ++a)
    sum += 0.5 * (profile.rate[a * profile.stride + line] + profile.rate[(a + 1) * profile.stride + line]);
  return 0.1 * HeightProfile::kStepKm * sum;
}

double peak_km(const HeightProfile& profile, int line) {
  int best = 0;
  for (int a = 1; a < HeightProfile::kAltitudes; ++a)
    if (profile.rate[a * profile.stride + line] > profile.rate[best * profile.stride + line]) best = a;
  return HeightProfile::kBottomKm + best * HeightProfile::kStepKm;
}

TEST(HeightProfile, HoldsTheColumnsOfTheModelThatMadeTheTables) {
  // data/glow/column_brightness.csv sums the model's full column. The table begins at 80 km and ends at 640
  // km: what lies outside is missing, so the profile may hold less, never more than the sampling's error.
  std::ifstream file(tests::source_folder() + "/data/glow/column_brightness.csv");
  ASSERT_TRUE(file);
  std::vector<double> lines;
  for (const EmissionLine& line : emission_lines())
    if (line.ratio == 1.0) lines.push_back(line.wavelength_nm);
  std::string row;
  std::getline(file, row);
  if (!row.empty() && row.back() == '\r') row.pop_back();
  ASSERT_EQ(row, "E0_keV,R_3371,R_4278,R_5200,R_5577,R_6300,R_7774,R_8446");
  int rows = 0;
  while (std::getline(file, row)) {
    std::replace(row.begin(), row.end(), ',', ' ');
    std::istringstream cells(row);
    double energy = 0.0;
    cells >> energy;
    ++rows;
    // The last row's energy is rounded up beyond the table's.
    const HeightProfile profile = maxwellian_profile(
        tests::glow(), lines, std::min(energy, tests::glow().tables.maxwellian().energies_kev().back()));
    for (std::size_t l = 0; l < lines.size(); ++l) {
      double expected = 0.0;
      cells >> expected;
      const double share = column_rayleigh(profile, static_cast<int>(l)) / expected;
      EXPECT_LT(share, 1.01) << lines[l] << " nm at " << energy << " keV";
      EXPECT_GT(share, energy < 17.0 ? 0.99 : 0.98) << lines[l] << " nm at " << energy << " keV";
    }
  }
  EXPECT_EQ(rows, 47);
}

TEST(HeightProfile, HasTheKnownPeaksAndBrightness) {
  // docs/physics.md: peak of 557.7 nm, rayleighs of 427.8 nm per mW m^-2, and 630.0 / 427.8, given to the
  // digits below.
  struct Known {
    double energy_kev, peak_km, blue_rayleigh, ratio, ratio_rounding;
  };
  for (const Known& known : {Known{1.0, 126.0, 214.0, 1.90, 0.01}, Known{3.0, 109.0, 231.0, 0.34, 0.005},
                             Known{10.0, 101.0, 241.0, 0.041, 0.0005}}) {
    const HeightProfile profile = maxwellian_profile(tests::glow(), {630.0, 557.7, 427.8}, known.energy_kev);
    EXPECT_NEAR(peak_km(profile, 1), known.peak_km, 1.0);
    EXPECT_NEAR(column_rayleigh(profile, 2), known.blue_rayleigh, 1.0);
    EXPECT_NEAR(column_rayleigh(profile, 0) / column_rayleigh(profile, 2), known.ratio,
                known.ratio_rounding + 0.01 * known.ratio);
  }
}

TEST(HeightProfile, LinesOfNebulaeAreDarkBesideTheOthers) {
  const HeightProfile alone = maxwellian_profile(tests::glow(), {557.7}, 2.0),
                      beside = maxwellian_profile(tests::glow(), {656.3, 557.7, 500.7}, 2.0),
                      by_flux = maxwellian_profile(tests::glow(), {656.3, 557.7, 500.7}, 2.0, 1.5,
                                                   SlopeBy::energy_flux);
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    EXPECT_EQ(beside.rate[a * 4 + 1], alone.rate[a * 4]);
    for (const int dark : {0, 2}) {
      EXPECT_EQ(beside.rate[a * 4 + dark], 0.0f);
      EXPECT_EQ(by_flux.d_rate_d_ln_energy[a * 4 + dark], 0.0f);
    }
  }
}

TEST(HeightProfile, IsOneVectorLoadPerAltitude) {
  const HeightProfile three = maxwellian_profile(tests::glow(), {630.0, 557.7, 427.8}, 2.0);
  EXPECT_EQ(three.stride, 4);
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) EXPECT_EQ(three.rate[a * 4 + 3], 0.0f);
  const HeightProfile five = maxwellian_profile(tests::glow(), {337.1, 630.0, 557.7, 427.8, 777.4}, 2.0);
  EXPECT_EQ(five.stride, 8);
  for (int a = 0; a < HeightProfile::kAltitudes; a += 100)
    EXPECT_EQ(five.rate[a * 8 + 2], three.rate[a * 4 + 1]);
}

TEST(HeightProfile, DerivativeByTheEnergyIsThatOfTheRate) {
  // Differences of floats over 1 % of E0: their rounding and the third derivative leave some 1e-4 of the
  // peak.
  for (double energy : {0.3, 1.7, 3.0, 9.0}) {
    constexpr double h = 0.01;
    const std::vector<double> lines = {630.0, 557.7, 427.8};
    const HeightProfile here = maxwellian_profile(tests::glow(), lines, energy);
    const HeightProfile more = maxwellian_profile(tests::glow(), lines, energy * std::exp(h));
    const HeightProfile less = maxwellian_profile(tests::glow(), lines, energy * std::exp(-h));
    for (int l = 0; l < 3; ++l) {
      double peak = 0.0;
      for (int a = 0; a < HeightProfile::kAltitudes; ++a)
        peak = std::max<double>(peak, std::abs(here.d_rate_d_ln_energy[a * 4 + l]));
      for (int a = 0; a < HeightProfile::kAltitudes; a += 3)
        EXPECT_NEAR(here.d_rate_d_ln_energy[a * 4 + l],
                    (more.rate[a * 4 + l] - less.rate[a * 4 + l]) / (2 * h), 5e-4 * peak)
            << energy << " keV, line " << l << ", altitude " << 80 + 0.25 * a;
    }
  }
}

TEST(EmissionTable, DerivativeByTheEnergyIsThatOfTheRate) {
  const EmissionTable& table = tests::glow().tables.maxwellian();
  constexpr double h = 1e-4;
  for (double energy : {0.15, 1.0, 2.7, 15.0}) {
    const auto here = table.at_energy("ver_5577", energy);
    const auto more = table.at_energy("ver_5577", energy * std::exp(h));
    const auto less = table.at_energy("ver_5577", energy * std::exp(-h));
    for (std::size_t a = 0; a < here.size(); ++a)
      EXPECT_NEAR(here[a].d_rate_d_ln_energy, (more[a].rate - less[a].rate) / (2 * h), 1e-5 * here[a].rate);
  }
}

EmissionTable table_of(const std::string& csv) { return EmissionTable(read_csv_table(csv, "ver.csv")); }

TEST(EmissionTable, GivesItsOwnKnotsBackAboveTheFloor) {
  const EmissionTable table =
      table_of("E0_keV,altitude_km,ver_x\n1,80,0.0\n1,81,5.0\n2,80,3.0\n2,81,4.0\n4,80,1.0\n4,81,8.0\n");
  ASSERT_TRUE(table.has("ver_x"));
  EXPECT_NEAR(table.at_energy("ver_x", 1.0)[0].rate, 5e-6, 1e-12) << "a millionth of the peak";
  EXPECT_NEAR(table.at_energy("ver_x", 2.0)[0].rate, 3.0, 1e-12);
  EXPECT_NEAR(table.at_energy("ver_x", 4.0)[1].rate, 8.0, 1e-12);
}

}  // namespace
}  // namespace vegard::sim::height_profile_test
