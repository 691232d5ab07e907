// Conductances by Robinson et al. 1987.
#include "fit/report/netcdf/conductance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::fit::conductance_test {
namespace {

// Of mean energies 2 E0 and fluxes in round numbers the formulas can be worked out by hand.
TEST(Conductance, IsRobinsons) {
  // E = 4 keV, Q = 1: 40 4 / 32 = 5 S.
  const Conductances four = conductances(1.0, 2.0, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(four.pedersen_s, 5.0);
  EXPECT_DOUBLE_EQ(four.hall_s / four.pedersen_s, 0.45 * std::pow(4.0, 0.85));
  // E = 1 keV, Q = 4: 40 / 17 sqrt 4, and the ratio is 0.45.
  const Conductances one = conductances(4.0, 0.5, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(one.pedersen_s, 80.0 / 17.0);
  EXPECT_DOUBLE_EQ(one.hall_s, 0.45 * 80.0 / 17.0);
}

// The Pedersen conductance of a flux is largest at a mean energy of 4 keV: its derivative, and so the share
// of the energy's error, is 0 there.
TEST(Conductance, IsLargestAtFourKiloelectronvolts) {
  EXPECT_GT(conductances(1.0, 2.0, 0.0, 0.0).pedersen_s, conductances(1.0, 1.9, 0.0, 0.0).pedersen_s);
  EXPECT_GT(conductances(1.0, 2.0, 0.0, 0.0).pedersen_s, conductances(1.0, 2.1, 0.0, 0.0).pedersen_s);
  EXPECT_DOUBLE_EQ(conductances(1.0, 2.0, 0.2, 0.3).relative_pedersen_error, 0.1);
}

TEST(Conductance, HasTheErrorsOfItsDerivatives) {
  // Central differences of a step h are right to h^2 times a third derivative of order one.
  constexpr double h = 1e-4;
  for (const double energy : {0.3, 1.0, 5.0, 14.0}) {
    const auto ln = [&](double by_flux, double by_energy, bool hall) {
      const Conductances c = conductances(3.0 * std::exp(by_flux), energy * std::exp(by_energy), 0.0, 0.0);
      return std::log(hall ? c.hall_s : c.pedersen_s);
    };
    for (const bool hall : {false, true}) {
      const double of_flux = std::abs(ln(h, 0, hall) - ln(-h, 0, hall)) / (2.0 * h);
      const double of_energy = std::abs(ln(0, h, hall) - ln(0, -h, hall)) / (2.0 * h);
      const Conductances by_flux = conductances(3.0, energy, 0.1, 0.0),
                         by_energy = conductances(3.0, energy, 0.0, 0.1);
      EXPECT_NEAR(hall ? by_flux.relative_hall_error : by_flux.relative_pedersen_error, 0.1 * of_flux, 1e-7);
      EXPECT_NEAR(hall ? by_energy.relative_hall_error : by_energy.relative_pedersen_error, 0.1 * of_energy,
                  1e-7);
    }
  }
}

TEST(Conductance, KnowsTheDarkFromWhatIsNotTold) {
  EXPECT_EQ(conductances(0.0, std::nan(""), std::nan(""), std::nan("")).pedersen_s, 0.0);
  EXPECT_TRUE(std::isnan(conductances(std::nan(""), 2.0, 0.1, 0.1).pedersen_s));
  EXPECT_TRUE(std::isnan(conductances(1.0, std::nan(""), 0.1, 0.1).hall_s));
}

}  // namespace
}  // namespace vegard::fit::conductance_test
