#include "sim/light/chemistry/light_mode_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/light/chemistry/physics_draw.h"
#include "sim/light/height_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/light/tables/light_modes.h"

namespace vegard::sim::light_mode_maker_test {
namespace {

TableRequest coarse_request() {
  TableRequest request;
  request.refinement = 0.4;
  request.maxwellian_kev = {0.5, 2.0, 8.0};
  return request;
}

// With as many modes as there are draws, the squares of all modes add up to the mean square of the changes:
// nothing of the covariance is lost. Text has four decimals.
TEST(LightModeMaker, ModesCarryTheVarianceOfTheDraws) {
  ModeRequest modes;
  modes.draws = 5;
  modes.seed = 2;
  modes.carried_share = 1.0 - 1e-9;
  ModeSummary summary;
  const TableRequest request = coarse_request();
  const std::string text = make_light_modes(request, modes, 2, summary);
  EXPECT_EQ(summary.modes, 5);
  EXPECT_NEAR(summary.carried_share, 1.0, 1e-9);
  EXPECT_EQ(text, make_light_modes(request, modes, 1, summary));  // for any number of threads
  const LightModes made(read_csv_table(text, "modes.csv"));

  TableRequest usual = request;
  usual.mono_kev.clear();
  usual.refinement *= kModeRefinement;
  const MadeLight before =
      made_light({SpectrumKind::maxwellian, 1.0, 8.0, 1.0}, usual, table_degradation(usual));
  double square = 0.0;
  constexpr std::size_t kRow = 30;  // 110 km, near the peak
  const double altitude = made_altitudes_km()[kRow];
  const auto blue = static_cast<std::size_t>(std::find(before.names.begin(), before.names.end(), "ver_4278") -
                                             before.names.begin());
  for (std::uint32_t d = 0; d < 5; ++d) {
    const PhysicsDraw draw = draw_physics(modes.seed, d);
    TableRequest drawn = usual;
    drawn.reactions = usual.reactions.scaled(draw.reactions);
    drawn.air = changed_air(usual.air, draw.of_the_air);
    drawn.seconds *= draw.of_the_air.at(UncertainAir::seconds);
    const MadeLight light = made_light({SpectrumKind::maxwellian, 1.0, 8.0, 1.0}, drawn,
                                       table_degradation(drawn, draw.processes));
    square += std::pow(std::log(light.rates[blue][kRow] / before.rates[blue][kRow]), 2) / 5.0;
  }
  double of_modes = 0.0;
  for (int k = 0; k < made.count(); ++k)
    of_modes += std::pow(made.at(k, "ver_4278", 8.0, {altitude})[0].value, 2);
  EXPECT_NEAR(of_modes / square, 1.0, 5e-3);  // light below 1e-4 of the peak is damped
}

// GLOW is not among the draws. Of the columns of 427.8, 557.7 and 630.0 nm at 0.5 to 8 keV none of its is
// more than 2.6 standard deviations from ours (1 % by chance).
TEST(LightModeMaker, ShippedModesContainAnotherModel) {
  const EmissionTables &own = emission_tables("vegard"), &glow = emission_tables("glow");
  ASSERT_GT(own.modes().count(), 0);
  const std::vector<double> lines_nm = {427.8, 557.7, 630.0};
  for (const double energy : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    const HeightProfile ours = maxwellian_profile({own}, lines_nm, energy),
                        theirs = maxwellian_profile({glow}, lines_nm, energy);
    for (int l = 0; l < 3; ++l) {
      const double usual = column_below(ours, l, 640.0).rayleigh;
      double variance = 0.0;
      for (int k = 0; k < own.modes().count(); ++k) {
        std::vector<double> coefficients(static_cast<std::size_t>(k) + 1, 0.0);
        constexpr double kStep = 0.01;
        coefficients.back() = kStep;
        const HeightProfile more = maxwellian_profile({own, 1.0, coefficients}, lines_nm, energy);
        variance += std::pow(std::log(column_below(more, l, 640.0).rayleigh / usual) / kStep, 2);
      }
      const double off = std::log(column_below(theirs, l, 640.0).rayleigh / usual);
      EXPECT_LT(std::abs(off) / std::sqrt(variance), 2.6)
          << lines_nm[static_cast<std::size_t>(l)] << " nm, " << energy << " keV";
    }
  }
}

}  // namespace
}  // namespace vegard::sim::light_mode_maker_test
