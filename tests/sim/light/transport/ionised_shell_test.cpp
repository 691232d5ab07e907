#include "sim/light/transport/collisions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::ionised_shell_test {
namespace {

const IonisedShell kShell{"N2+ X", 15.58, 15.58, 54.91, 2.0, 0.0};

TEST(IonisedShell, IsKimAndRuddsFormulaAtLowEnergies) {
  // Kim and Rudd 1994, equation (57): S/(t+u+1) (ln t/2 (1 - 1/t^2) + 1 - 1/t - ln t/(t+1)).
  for (const double energy : {20.0, 100.0, 1000.0}) {
    const double t = energy / kShell.binding_ev, u = kShell.kinetic_ev / kShell.binding_ev;
    const double s = 6.5141e-14 * kShell.electrons / (kShell.binding_ev * kShell.binding_ev);
    const double l = std::log(t);
    const double expected =
        s / (t + u + 1.0) * (0.5 * l * (1.0 - 1.0 / (t * t)) + 1.0 - 1.0 / t - l / (t + 1.0));
    // What relativity changes, some T/mc^2.
    EXPECT_NEAR(ShellSpectrum(kShell, energy).cm2() / expected, 1.0, 0.001 + 3.0 * energy / 511e3) << energy;
  }
}

TEST(IonisedShell, NeedsTheBindingEnergy) {
  EXPECT_EQ(ShellSpectrum(kShell, 15.0).cm2(), 0.0);
  EXPECT_EQ(ShellSpectrum(kShell, 15.0).max_ev(), 0.0);
  EXPECT_GT(ShellSpectrum(kShell, 16.0).cm2(), 0.0);
}

TEST(IonisedShell, MakesMostlySlowElectrons) {
  // Opal, Peterson and Beaty 1971 measured 1/(1 + (W/13 eV)^2.1) in N2: half of the electrons below about 10
  // eV.
  const ShellSpectrum spectrum(kShell, 500.0);
  EXPECT_NEAR(spectrum.cm2_below(10.0) / spectrum.cm2(), 0.5, 0.07);
  double before = 0.0;
  for (double w = 1.0; w <= spectrum.max_ev(); w += 1.0) {
    EXPECT_GT(spectrum.cm2_below(w), before);
    before = spectrum.cm2_below(w);
  }
  EXPECT_EQ(spectrum.cm2_below(1e6), spectrum.cm2());
}

}  // namespace
}  // namespace vegard::sim::ionised_shell_test
