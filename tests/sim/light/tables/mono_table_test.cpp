#include "sim/light/tables/mono_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/light/spectrum_profile.h"
#include "sim/light/tables/emission_table.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/lines/emission_lines.h"
#include "tests/support/glow.h"

namespace vegard::sim::mono_table_test {
namespace {

const EmissionTable& maxwellian() { return tests::glow().tables.maxwellian(); }
const std::vector<StoppingAir>& air() { return tests::glow().tables.air(); }

double column(const std::vector<double>& curve) {
  const std::vector<double>& z = maxwellian().altitudes_km();
  double sum = 0.0;
  for (std::size_t a = 0; a + 1 < z.size(); ++a) sum += 0.5 * (curve[a] + curve[a + 1]) * (z[a + 1] - z[a]);
  return sum;
}

TEST(TablesAir, HasTheAltitudesOfTheTablesAndAnAtmospheresScaleHeights) {
  ASSERT_EQ(air().size(), maxwellian().altitudes_km().size());
  // H of 6 km in the mesosphere; the density falls by the factor that it says, but for the temperature's
  // gradient.
  EXPECT_NEAR(air().front().scale_height_cm, 6.4e5, 0.2e5);
  // 80 km of air of 18 mg/m^3 (U.S. Standard Atmosphere 1976: 1.846e-8 g/cm^3), within the season's 30 %.
  EXPECT_NEAR(air().front().mass_column_g_cm2 / air().front().scale_height_cm / 1.846e-8, 1.0, 0.3);
}

TEST(MonoEnergeticTable, AMaxwellianMadeOutOfItIsThatOfTheTables) {
  // The figures of docs/validation.md, a line and an energy at a time; above 0.2 keV, where its
  // mono-energetic electrons of twice that begin.
  for (const EmissionLine& line : emission_lines()) {
    if (!is_auroral(line)) continue;
    for (const double e0 : {0.22387, 0.50119, 1.0, 1.9953, 5.0119, 10.0, 19.953}) {
      std::vector<double> tables, made(air().size(), 0.0), off;
      for (const Emission1d& emission : maxwellian().at_energy(line.table_column, e0))
        tables.push_back(emission.rate);
      for (const SpectrumPiece& piece : maxwellian_pieces(e0)) {
        const std::vector<MonoRate> rates =
            tests::glow().tables.mono().at_energy(line.table_column, piece.energy_kev);
        for (std::size_t a = 0; a < made.size(); ++a) made[a] += piece.share * std::exp(rates[a].value);
      }
      EXPECT_NEAR(column(made) / column(tables), 1.0, 0.03) << line.wavelength_nm << " nm, " << e0 << " keV";
      for (std::size_t a = 0; a < made.size(); ++a)
        off.push_back(0.5 * std::abs(made[a] / column(made) - tables[a] / column(tables)));
      EXPECT_LT(column(off), 0.02) << line.wavelength_nm << " nm, " << e0 << " keV";
    }
  }
}

TEST(MonoEnergeticTable, GrowsWithTheEnergyAsItsSlopeSays) {
  constexpr double h = 1e-5;
  const MonoEnergeticTable& table = tests::glow().tables.mono();
  for (const double energy : {0.15, 0.9, 6.0, 19.0, 55.0}) {
    const std::vector<MonoRate> here = table.at_energy("ver_5577", energy),
                                more = table.at_energy("ver_5577", energy * std::exp(h)),
                                less = table.at_energy("ver_5577", energy * std::exp(-h));
    for (std::size_t a = 0; a < here.size(); ++a) {
      const double difference = (more[a].value - less[a].value) / (2.0 * h);
      EXPECT_NEAR(here[a].slope, difference, 1e-6 * (1.0 + std::abs(difference))) << energy << ", row " << a;
    }
  }
}

}  // namespace
}  // namespace vegard::sim::mono_table_test
