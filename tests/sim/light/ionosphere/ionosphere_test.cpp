#include "sim/light/ionosphere/ionosphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/light/air/msis_air.h"
#include "sim/light/chemistry/line_sources.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::sim::ionosphere_test {
namespace {

const EmissionTables& tables() { return emission_tables("vegard"); }
const std::vector<double>& altitudes() { return tables().maxwellian().altitudes_km(); }

IonosphereAir air_of_tables() {
  return ionosphere_air(read_air_table(tables().folder().files.at(kTablesAirFile), "air"), altitudes(), {});
}

/// Straight between two places of a column, in logarithms.
double at_altitude(const FieldAir& column, const std::vector<double>& values, double altitude_km) {
  const auto after = std::lower_bound(column.altitude_km.begin() + 1, column.altitude_km.end(), altitude_km);
  const auto high = static_cast<std::size_t>(after - column.altitude_km.begin());
  const double way = (altitude_km - column.altitude_km[high - 1]) /
                     (column.altitude_km[high] - column.altitude_km[high - 1]);
  return std::exp((1.0 - way) * std::log(values[high - 1]) + way * std::log(values[high]));
}

// What the electrons make in another air, and what the gases have of it, is what their transport and its ions
// have there: of 1 keV in a quiet winter, whose thermosphere is half as warm as the tables'. Rees's weights
// hold for all energies and our cross-sections are not his: O+ is within a quarter.
TEST(Ionosphere, InAnotherAirIsThatOfTheTransportThere) {
  const AirTable winter = *named_air("winter_quiet");
  constexpr double kEnergyKev = 1.0, kFlux = 10.0, kDipDeg = 78.0, kSeconds = 180.0, kRefinement = 0.5;
  const IonosphereAir to = ionosphere_air(winter, altitudes(), {});
  IonospherePhysics physics;
  physics.seconds = kSeconds;
  const Ionosphere found = ionosphere(
      to, moved_ion_pairs(ion_pairs(tables(), {}, kEnergyKev, kFlux), air_of_tables(), to), physics);

  IncidentSpectrum spectrum;
  spectrum.energy_kev = kEnergyKev;
  const Degradation collisions = degradation(energy_grid(1e3 * highest_energy_kev(spectrum), kRefinement));
  const AuroralRun run = auroral_run(collisions, field_air(winter, kDipDeg, kRefinement),
                                     incident_flux(spectrum, collisions.grid, kFlux), PitchAngles::isotropic,
                                     physics.reactions, kSeconds);
  std::vector<double> pairs, electrons, op;
  for (std::size_t m = 0; m < run.column.size(); ++m) {
    const IonDensities& ions = run.light.ions[m];
    pairs.push_back(run.rates.all_ion_pairs(m));
    electrons.push_back(ions.electrons);
    op.push_back(ions.op + ions.op2d + ions.op2p);
  }
  const double most = *std::max_element(pairs.begin(), pairs.end());
  for (std::size_t i = 0; i < altitudes().size(); ++i) {
    const double altitude = altitudes()[i], made = at_altitude(run.column, pairs, altitude);
    if (altitude > 300.0 || made < 0.02 * most) continue;
    EXPECT_NEAR(found.pairs_cm3_s[i] / made, 1.0, 0.08) << altitude;
    EXPECT_NEAR(found.ions[i].electrons / at_altitude(run.column, electrons, altitude), 1.0, 0.08)
        << altitude;
    if (found.ions[i].op > 0.01 * found.ions[i].electrons) {
      EXPECT_NEAR(found.ions[i].op / at_altitude(run.column, op, altitude), 0.85, 0.15) << altitude;
    }
  }
  EXPECT_NEAR(found.deposited_mw_m2() / (run.rates.budget.deposited_ev() / kEvPerErg), 1.0, 0.05);
}

TEST(Ionosphere, HasChargeInBalance) {
  const Ionosphere found = ionosphere(air_of_tables(), ion_pairs(tables(), {}, 5.0, 10.0), {});
  for (const IonDensities& ions : found.ions)
    if (ions.electrons > 1.0) {
      EXPECT_NEAR(ions.ions() / ions.electrons, 1.0, 1e-9);
    }
  EXPECT_EQ(ionosphere(air_of_tables(), std::vector<double>(altitudes().size(), 0.0), {}).pedersen_s, 0.0);
}

// Robinson et al. 1987, whose formulas are a fit to other models within some tens of per cent: 2 to 20 keV
// mean energy, 1 to 10 mW m^-2. Fluxes of 0.1 mW m^-2 have relatively more, by the night's own ions.
TEST(Ionosphere, ConductsAsPublishedFormulasSay) {
  const IonosphereAir air = air_of_tables();
  IonospherePhysics physics;
  physics.seconds = 180.0;
  for (const double energy_kev : {1.0, 2.0, 4.0, 8.0})
    for (const double flux : {1.0, 10.0}) {
      const Ionosphere found = ionosphere(air, ion_pairs(tables(), {}, energy_kev, flux), physics);
      const double mean = 2.0 * energy_kev, pedersen = 40.0 * mean / (16.0 + mean * mean) * std::sqrt(flux);
      const double hall = 0.45 * std::pow(mean, 0.85) * pedersen;
      EXPECT_NEAR(std::log(found.pedersen_s / pedersen), 0.0, 0.3) << energy_kev << " " << flux;
      EXPECT_NEAR(std::log(found.hall_s / hall), 0.0, 0.3) << energy_kev << " " << flux;
    }
}

// Where ions recombine, densities grow with the root of what is made.
TEST(Ionosphere, GrowsWithTheRootOfTheFlux) {
  const IonosphereAir air = air_of_tables();
  const Ionosphere once = ionosphere(air, ion_pairs(tables(), {}, 5.0, 10.0), {}),
                   four = ionosphere(air, ion_pairs(tables(), {}, 5.0, 40.0), {});
  EXPECT_NEAR(four.peak_cm3 / once.peak_cm3, 2.0, 0.1);
  EXPECT_NEAR(four.deposited_mw_m2() / once.deposited_mw_m2(), 4.0, 1e-9);
}

// The sum of many electrons of one energy is that of a Maxwellian, and harder ones stop lower.
TEST(Ionosphere, HasOtherSpectra) {
  ElectronSpectrum mono, gaussian;
  mono.kind = ElectronSpectrum::Kind::mono;
  gaussian.kind = ElectronSpectrum::Kind::gaussian;
  gaussian.spread = 0.05;
  const IonosphereAir air = air_of_tables();
  const Ionosphere one = ionosphere(air, ion_pairs(tables(), mono, 5.0, 10.0), {}),
                   narrow = ionosphere(air, ion_pairs(tables(), gaussian, 5.0, 10.0), {}),
                   harder = ionosphere(air, ion_pairs(tables(), mono, 10.0, 10.0), {});
  EXPECT_NEAR(one.hall_s / narrow.hall_s, 1.0, 0.01);
  EXPECT_NEAR(one.peak_km, narrow.peak_km, 0.5);
  EXPECT_LT(harder.peak_km, one.peak_km - 3.0);
}

TEST(Ionosphere, FindsAPeakBetweenAltitudes) {
  std::vector<double> altitude, ln;
  for (double z = 100.0; z < 112.0; z += z < 105.0 ? 1.0 : 2.0) {
    altitude.push_back(z);
    ln.push_back(3.0 - 0.1 * (z - 105.3) * (z - 105.3));
  }
  EXPECT_NEAR(density_peak(altitude, ln).altitude_km, 105.3, 1e-9);
  EXPECT_NEAR(density_peak(altitude, ln).ln, 3.0, 1e-9);
  EXPECT_EQ(height_integral({100.0, 101.0, 103.0}, {1.0, 1.0, 1.0}), 3000.0);
}

}  // namespace
}  // namespace vegard::sim::ionosphere_test
