// Densities of known electrons against those of `vegard ionosphere`, and their derivatives.
#include "fit/radar/radar_density.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/light/ionosphere/ionosphere_model.h"

namespace vegard::fit::radar_density_test {
namespace {

constexpr double kSteady = std::numeric_limits<double>::infinity();

const sim::EmissionTables& tables() { return sim::emission_tables("vegard"); }

/// At altitudes of the tables themselves, so that nothing is between two of them.
std::vector<double> altitudes_km() {
  std::vector<double> chosen;
  for (const double altitude : tables().maxwellian().altitudes_km())
    if (altitude >= 90.0 && altitude <= 150.0) chosen.push_back(altitude);
  return chosen;
}

TEST(RadarDensity, IsThatOfTheIonosphere) {
  for (const double seconds : {kSteady, 30.0})
    for (const auto kind : {sim::ElectronSpectrum::Kind::maxwellian, sim::ElectronSpectrum::Kind::gaussian}) {
      sim::IonosphereRequest request;
      request.spectrum.kind = kind;
      request.seconds = seconds;
      const sim::IonosphereModel model(tables(), request);
      RadarDensityOptions options;
      options.seconds = seconds;
      const RadarDensity density(tables(), altitudes_km(), options);
      ASSERT_GT(density.altitudes(), 10u);
      for (const double energy_kev : {2.0, 6.0}) {
        const double flux = 7.0;
        const sim::Ionosphere truth = model.at(energy_kev, flux);
        const RadarDensity::Pairs pairs = density.pairs(request.spectrum, energy_kev);
        std::size_t i = 0;
        for (std::size_t k = 0; k < truth.altitude_km.size(); ++k) {
          if (i == density.altitudes() || truth.altitude_km[k] != altitudes_km()[i]) continue;
          const double found = density.density(i, flux * pairs.value[i]).value;
          // Where no electrons come, both are 0.
          EXPECT_NEAR(found, truth.ions[k].electrons, 1e-3 * truth.ions[k].electrons)
              << truth.altitude_km[k] << " km " << energy_kev << " keV " << seconds << " s";
          ++i;
        }
        EXPECT_EQ(i, density.altitudes());
      }
    }
}

TEST(RadarDensity, HasExactDerivatives) {
  sim::ElectronSpectrum spectrum;
  spectrum.kind = sim::ElectronSpectrum::Kind::gaussian;
  const RadarDensity density(tables(), altitudes_km(), {});
  const RadarDensity::Pairs pairs = density.pairs(spectrum, 5.0), more = density.pairs(spectrum, 5.005),
                            less = density.pairs(spectrum, 4.995);
  constexpr double kSpreadStep = 2e-4;
  sim::ElectronSpectrum wide = spectrum, narrow = spectrum;
  wide.spread += kSpreadStep;
  narrow.spread -= kSpreadStep;
  const RadarDensity::Pairs wider = density.pairs(wide, 5.0), narrower = density.pairs(narrow, 5.0);
  for (std::size_t i = 0; i < density.altitudes(); ++i) {
    const double by_energy = (more.value[i] - less.value[i]) / std::log(5.005 / 4.995),
                 by_spread = (wider.value[i] - narrower.value[i]) / (2.0 * kSpreadStep);
    EXPECT_NEAR(pairs.by_ln_energy[i], by_energy, 1e-3 * (std::abs(by_energy) + pairs.value[i]));
    EXPECT_NEAR(pairs.by_spread[i], by_spread, 1e-3 * (std::abs(by_spread) + pairs.value[i]));
    for (const double at : {1e-5, 0.3, 50.0, 3e4}) {
      const double step = 1e-5 * at;
      const double difference =
          (density.density(i, at + step).value - density.density(i, at - step).value) / (2.0 * step);
      EXPECT_NEAR(density.density(i, at).by_pairs / difference, 1.0, 1e-4) << at;
    }
    EXPECT_EQ(density.density(i, 0.0).value, 0.0);
  }
}

/// The draws' own scatter, which contains 98 % of it by the modes.
TEST(RadarDensity, ModesHoldTheScatterOfPhysics) {
  const RadarDensity density(tables(), altitudes_km(), {});
  const Eigen::MatrixXd modes = density.physics_modes({}, 4.0, 6.0, 1);
  EXPECT_GE(modes.cols(), 1);
  EXPECT_LE(modes.cols(), 8);
  for (Eigen::Index i = 0; i < modes.rows(); ++i) {
    const double sigma = modes.row(i).norm();
    EXPECT_GT(sigma, 0.03) << altitudes_km()[static_cast<std::size_t>(i)];
    EXPECT_LT(sigma, 0.6) << altitudes_km()[static_cast<std::size_t>(i)];
  }
}

}  // namespace
}  // namespace vegard::fit::radar_density_test
