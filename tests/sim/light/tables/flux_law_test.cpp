#include "sim/light/tables/flux_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <string>

#include "sim/base/file/csv_table.h"
#include "sim/light/height_profile.h"
#include "tests/support/glow.h"
#include "tests/support/source_folder.h"

namespace vegard::sim::flux_law_test {
namespace {

const FluxFactors& glow_factors() { return tests::glow().tables.flux_factors(); }

TEST(FluxLaw, GivesGlowsColumnsBackWithTheBackgroundOfZeroFlux) {
  const CsvTable glow = tests::glow_table("linearity_Q.csv");
  int checked = 0;
  for (const std::string line : {"3371", "4278", "5200", "5577", "6300", "7774", "8446"}) {
    const std::string column = "ver_" + line;
    const std::vector<double>& rayleigh = glow.column("R_" + line);
    std::map<double, double> at_one;
    for (std::size_t row = 0; row < glow.rows(); ++row)
      if (glow.column("Q_erg")[row] == 1.0) at_one[glow.column("E0_keV")[row]] = rayleigh[row];
    for (std::size_t row = 0; row < glow.rows(); ++row, ++checked) {
      const double flux = glow.column("Q_erg")[row], energy = glow.column("E0_keV")[row];
      const double background = glow_factors().background_rayleigh(column);
      const double expected = background + flux * (at_one.at(energy) - background) *
                                               std::exp(glow_factors().at(column, energy, flux).log_factor);
      EXPECT_NEAR(rayleigh[row] / expected, 1.0, 1e-6) << column << " at " << energy << " keV, Q " << flux;
    }
  }
  EXPECT_EQ(checked, 7 * 45);
}

TEST(FluxLaw, TakesTheBackgroundThatTheModelHasWithoutElectrons) {
  // data/glow/background.csv, summed: another run of the same model, on the tables' altitudes. 0.5 % for the
  // trapezium over steps of up to 10 km.
  std::ifstream file(tests::source_folder() + "/data/glow/background.csv");
  ASSERT_TRUE(file);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const CsvTable zero = read_csv_table(text, "background.csv");
  const std::vector<double>& altitude = zero.column("altitude_km");
  for (const char* column :
       {"ver_3371", "ver_4278", "ver_5200", "ver_5577", "ver_6300", "ver_7774", "ver_8446"}) {
    const std::vector<double>& rate = zero.column(column);
    double sum = 0.0;
    for (std::size_t a = 0; a + 1 < rate.size(); ++a)
      sum += 0.05 * (rate[a] + rate[a + 1]) * (altitude[a + 1] - altitude[a]);
    EXPECT_NEAR(glow_factors().background_rayleigh(column), sum, 0.005 * sum) << column;
  }
}

TEST(FluxLaw, IsOneAtOneAndForLightInProportion) {
  for (double energy : {0.1, 0.9, 7.0, 20.0}) {
    EXPECT_EQ(glow_factors().at("ver_5577", energy, 1.0).log_factor, 0.0);
    for (double flux : {0.0, 0.02, 3.0, 400.0})
      EXPECT_NEAR(glow_factors().at("ver_4278", energy, flux).log_factor, 0.0, 1e-5);
  }
  // 15 % more green light per mW m^-2 at 20 keV and 10 mW m^-2: docs/physics.md.
  EXPECT_NEAR(std::exp(glow_factors().at("ver_5577", 20.0, 10.0).log_factor), 1.152, 0.001);
}

TEST(FluxLaw, DerivativesAreThoseOfTheFactorAndHaveNoSteps) {
  constexpr double h = 1e-5;
  for (const char* column : {"ver_6300", "ver_5577", "ver_5200"})
    for (double energy : {0.13, 1.0, 2.7, 16.0})
      for (double flux : {0.003, 0.1, 0.3, 1.0, 4.0, 10.0, 11.0, 300.0}) {
        const auto at = [&](double e, double q) { return glow_factors().at(column, e, q).log_factor; };
        const FluxFactor here = glow_factors().at(column, energy, flux);
        EXPECT_NEAR(here.by_log_energy,
                    (at(energy * std::exp(h), flux) - at(energy * std::exp(-h), flux)) / (2 * h), 1e-8);
        EXPECT_NEAR(here.by_log_flux,
                    (at(energy, flux * std::exp(h)) - at(energy, flux * std::exp(-h))) / (2 * h), 1e-8);
        // The slopes go on where the pieces meet.
        const FluxFactor next = glow_factors().at(column, energy, flux * (1.0 + 1e-9));
        EXPECT_NEAR(next.by_log_flux, here.by_log_flux, 1e-8);
      }
}

TEST(FluxLaw, LevelsOutBeyondTheFluxesThatAreKnown) {
  for (double energy : {0.5, 5.0, 20.0}) {
    const FluxFactor end = glow_factors().at("ver_5577", energy, 10.0);
    for (double flux : {30.0, 1e4, 1e12}) {
      const FluxFactor beyond = glow_factors().at("ver_5577", energy, flux);
      EXPECT_LE(std::abs(beyond.log_factor - end.log_factor), std::abs(end.by_log_flux) * (1.0 + 1e-12));
    }
    EXPECT_NEAR(glow_factors().at("ver_5577", energy, 1e12).by_log_flux, 0.0, 1e-12);
    EXPECT_TRUE(std::isfinite(glow_factors().at("ver_5577", energy, 0.0).log_factor));
    EXPECT_EQ(glow_factors().at("ver_5577", energy, 0.0).by_log_flux, 0.0);
  }
}

}  // namespace
}  // namespace vegard::sim::flux_law_test
