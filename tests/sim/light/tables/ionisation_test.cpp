#include "sim/light/tables/ionisation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::ionisation_test {
namespace {

/// Of the energy that comes in, what is spent at 35 eV an ion pair: the integral of f dz/H, and
/// dz/H = -d ln(rho H) = -d ln(y)/0.7 whatever the air.
double share_of_energy(double energy_kev) {
  constexpr double step = 0.01;
  double sum = 0.0;
  for (double log_y = -15.0; log_y < 10.0; log_y += step)
    sum += energy_dissipation(std::exp(log_y), energy_kev) * step / 0.7;
  return sum;
}

TEST(Ionisation, SpendsTheElectronsEnergy) {
  // What the source's fit leaves of 35 eV an ion pair; at its lower end a sixth is missing.
  for (const double energy : {4.0, 10.0, 20.0, 50.0, 100.0, 300.0})
    EXPECT_NEAR(share_of_energy(energy), 1.0, 0.02) << energy;
  for (const double energy : {0.3, 0.5, 1.0, 2.0}) EXPECT_NEAR(share_of_energy(energy), 0.95, 0.03) << energy;
  EXPECT_NEAR(share_of_energy(0.1), 0.84, 0.01);
}

/// Fang et al. 2008, J. Geophys. Res. 113, A09311, doi:10.1029/2008JA013384, equations (2) to (7) and table
/// 1: the same for Maxwellian electrons, from other model runs and with other coefficients.
double maxwellian_of_2008(double mass_column, double e0) {
  constexpr double kP[8][4] = {
      {3.49979e-1, -6.18200e-2, -4.08124e-2, 1.65414e-2}, {5.85425e-1, -5.00793e-2, 5.69309e-2, -4.02491e-3},
      {1.69692e-1, -2.58981e-2, 1.96822e-2, 1.20505e-3},  {-1.22271e-1, -1.15532e-2, 5.37951e-6, 1.20189e-3},
      {1.57018, 2.87896e-1, -4.14857e-1, 5.18158e-2},     {8.83195e-1, 4.31402e-2, -8.33599e-2, 1.02515e-2},
      {1.90953, -4.74704e-2, -1.80200e-1, 2.46652e-2},    {-1.29566, -2.10952e-1, 2.73106e-1, -2.92752e-2}};
  const double l = std::log(e0), y = std::pow(mass_column / 4e-6, 0.606) / e0;
  double c[8];
  for (int i = 0; i < 8; ++i) c[i] = std::exp(kP[i][0] + l * (kP[i][1] + l * (kP[i][2] + l * kP[i][3])));
  const double f = c[0] * std::pow(y, c[1]) * std::exp(-c[2] * std::pow(y, c[3])) +
                   c[4] * std::pow(y, c[5]) * std::exp(-c[6] * std::pow(y, c[7]));
  return 0.5 * f;  // its f is of half the energy flux
}

double maxwellian_of_pieces(double mass_column, double e0) {
  constexpr double kRatio = 1.03;
  double sum = 0.0, weights = 0.0;
  for (double energy = 0.05; energy < 40.0 * e0; energy *= kRatio) {
    const double weight = energy * energy * energy * std::exp(-energy / e0);
    sum += weight * energy_dissipation(2.0 / energy * std::pow(mass_column / 6e-6, 0.7), energy);
    weights += weight;
  }
  return sum / weights;
}

TEST(Ionisation, OfAMaxwellianIsThatOfThePaperOnMaxwellians) {
  // Two fits to model runs; the older paper claims 5 % for the total and for the peak.
  for (const double e0 : {0.5, 1.0, 2.0, 5.0, 10.0}) {
    double sum = 0.0, sum_2008 = 0.0, peak = 0.0, peak_2008 = 0.0, at = 0.0, at_2008 = 0.0;
    for (double log_column = -19.0; log_column < -1.0; log_column += 0.02) {
      const double here = maxwellian_of_pieces(std::exp(log_column), e0);
      const double here_2008 = maxwellian_of_2008(std::exp(log_column), e0);
      sum += here;
      sum_2008 += here_2008;
      if (here > peak) peak = here, at = log_column;
      if (here_2008 > peak_2008) peak_2008 = here_2008, at_2008 = log_column;
    }
    EXPECT_NEAR(sum / sum_2008, 1.0, 0.02) << e0;
    EXPECT_NEAR(peak / peak_2008, 1.0, 0.04) << e0;
    EXPECT_NEAR(at, at_2008, 0.2) << e0;  // scale heights
  }
}

TEST(Ionisation, GrowsWithTheEnergyAsItsSlopeSays) {
  constexpr double h = 1e-5;
  for (const double column : {1e-9, 1e-6, 1e-4, 1e-2}) {
    const StoppingAir air{column, 6e5};
    for (const double energy : {0.03, 0.1, 1.0, 7.0, 60.0}) {
      const double difference = (log_ionisation(air, energy * std::exp(h)).value -
                                 log_ionisation(air, energy * std::exp(-h)).value) /
                                (2.0 * h);
      EXPECT_NEAR(log_ionisation(air, energy).slope, difference, 1e-6 * (1.0 + std::abs(difference)))
          << column << " g/cm^2, " << energy << " keV";
    }
  }
}

TEST(Ionisation, IsFiniteWhereNothingArrives) {
  const LogRate rate = log_ionisation({1.0, 6e5}, 0.1);
  EXPECT_TRUE(std::isfinite(rate.value) && std::isfinite(rate.slope));
  EXPECT_LT(rate.value, -1000.0);
}

/// As share_of_energy(), of protons, whose y goes by the power 0.9 of rho H.
double share_of_proton_energy(double energy_kev) {
  constexpr double step = 0.01;
  double sum = 0.0;
  for (double log_y = -15.0; log_y < 12.0; log_y += step)
    sum += proton_energy_dissipation(std::exp(log_y), energy_kev) * step / 0.9;
  return sum;
}

TEST(ProtonIonisation, SpendsTheEnergyPerIonPairOfItsSource) {
  // Fang et al. 2013, abstract: a nearly monotonic increase from about 22 eV at 100 eV to 33 eV at 1 MeV.
  EXPECT_NEAR(35.0 / share_of_proton_energy(0.1), 22.0, 0.6);
  EXPECT_NEAR(35.0 / share_of_proton_energy(1000.0), 33.0, 0.7);
  double last_ev = 0.0;
  for (const double energy : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 300.0, 1000.0}) {
    const double ev = 35.0 / share_of_proton_energy(energy);
    EXPECT_GT(ev, last_ev) << energy;
    last_ev = ev;
  }
}

TEST(ProtonIonisation, GrowsWithTheEnergyAsItsSlopeSays) {
  constexpr double h = 1e-5;
  for (const double column : {1e-9, 1e-6, 1e-4}) {
    const StoppingAir air{column, 6e5};
    for (const double energy : {0.05, 0.3, 3.0, 40.0}) {
      const double difference = (log_proton_ionisation(air, energy * std::exp(h)).value -
                                 log_proton_ionisation(air, energy * std::exp(-h)).value) /
                                (2.0 * h);
      EXPECT_NEAR(log_proton_ionisation(air, energy).slope, difference, 1e-6 * (1.0 + std::abs(difference)))
          << column << " " << energy;
    }
  }
}

}  // namespace
}  // namespace vegard::sim::ionisation_test
