#include "tests/support/glow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim::glow_columns_test {
namespace {

std::vector<const EmissionLine*> lines_with_columns() {
  std::vector<const EmissionLine*> lines;
  for (const EmissionLine& line : emission_lines())
    if (line.ratio == 1.0) lines.push_back(&line);
  return lines;
}

TEST(GlowColumns, AreThereToTwoPercentBetweenTheEnergiesOfTheTable) {
  // The energies that a table with every second one left out does not have: twice as far apart as the
  // program's own. Above 17 keV part of the light lies below the tables.
  const tests::GlowColumns glow;
  const EmissionTable half = tests::every_second_energy();
  ASSERT_EQ(half.energies_kev().size(), 24u);
  for (const EmissionLine* line : lines_with_columns())
    for (std::size_t i = 1; i + 1 < glow.energies_kev().size() && glow.energies_kev()[i] < 17.0; i += 2) {
      const double energy = glow.energies_kev()[i];
      EXPECT_NEAR(tests::column_of(half, line->table_column, energy) / glow.rayleigh(line->wavelength_nm)[i],
                  1.0, 0.02)
          << line->wavelength_nm << " nm at " << energy << " keV";
    }
}

TEST(GlowColumns, AreInterpolatedLikeTheRates) {
  // Half-way between its energies, the program's column beside a spline through GLOW's own columns.
  const tests::GlowColumns glow;
  for (const EmissionLine* line : lines_with_columns())
    for (std::size_t i = 0; i + 1 < glow.energies_kev().size(); i += 3) {
      const double energy = std::sqrt(glow.energies_kev()[i] * glow.energies_kev()[i + 1]);
      if (energy > 17.0) break;
      const double expected = std::exp(glow.log_at(line->wavelength_nm, energy).value);
      EXPECT_NEAR(tests::program_column(line->wavelength_nm, energy).rayleigh / expected, 1.0, 0.01)
          << line->wavelength_nm << " nm at " << energy << " keV";
    }
}

TEST(GlowColumns, GrowWithTheEnergyAsTheirDifferencesDo) {
  // Central differences over steps of 12 % in E0. At the first inner energy the natural spline, straight at
  // the table's end, is off by up to 0.015. Above 10 keV the light below 80 km, which the program lacks and
  // GLOW's columns have, makes for up to 0.02 (docs/validation.md prints the largest).
  const tests::GlowColumns glow;
  for (const EmissionLine* line : lines_with_columns())
    for (std::size_t i = 1; i + 1 < glow.energies_kev().size() && glow.energies_kev()[i] < 9.0; i += 2) {
      const double energy = glow.energies_kev()[i];
      const Column column = tests::program_column(line->wavelength_nm, energy);
      EXPECT_NEAR(column.d_rayleigh_d_ln_energy / column.rayleigh, glow.difference(line->wavelength_nm, i),
                  i == 1 ? 0.02 : 0.01)
          << line->wavelength_nm << " nm at " << energy << " keV";
    }
}

TEST(GlowColumns, OfLinesWithARatioAreWiredToTheOtherLines) {
  // The wiring only: that the ratio of a row is applied, and to the right column. The figures are the rows'
  // own and checked by nothing here; their sources stand in sim/scene/lines/emission_lines.cpp.

  for (const double energy : {0.3, 3.0, 12.0}) {
    const double red = tests::program_column(630.0, energy).rayleigh;
    EXPECT_NEAR(red / tests::program_column(636.4, energy).rayleigh, 2.997, 1e-3);
    const double blue = tests::program_column(427.8, energy).rayleigh;
    EXPECT_NEAR(tests::program_column(391.4, energy).rayleigh / blue, 3.28, 1e-3);
    const double violet = tests::program_column(337.1, energy).rayleigh;
    EXPECT_NEAR(tests::program_column(670.5, energy).rayleigh / violet, 13.6, 1e-2);
  }
}

}  // namespace
}  // namespace vegard::sim::glow_columns_test
