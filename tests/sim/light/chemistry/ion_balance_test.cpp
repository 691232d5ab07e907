#include "sim/light/chemistry/ion_balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace vegard::sim::ion_balance_test {
namespace {

ReactingAir air_at_110_km() { return {110.0, 240.0, 240.0, 1.6e12, 2.6e11, 1.8e11, 1.4e8, 0.0}; }
ReactingAir air_at_300_km() { return {300.0, 976.0, 2200.0, 9.6e7, 3.9e6, 5.4e8, 3e5, 1e6}; }

IonProduction production() {
  IonProduction p;
  p.n2p = 3000.0;
  p.np = 800.0;
  p.o2p = 700.0;
  p.op = 500.0;
  p.op2d = 250.0;
  p.op2p = 120.0;
  return p;
}

/// Ion and electron pairs that become neutral.
double recombined(const ReactingAir& air, const IonDensities& ions) {
  const RatesAtPlace k = Reactions::standard().at(air.temperature_k, air.electron_temperature_k);
  return ions.electrons * (k(Reaction::n2p_e) * ions.n2p + k.o2p_e() * ions.o2p + k.nop_e() * ions.nop);
}

// No reaction but with an electron takes a charge away: what is made recombines, or diffuses.
TEST(IonBalance, MakesNoChargeAndLosesNone) {
  for (const ReactingAir& air : {air_at_110_km(), air_at_300_km()}) {
    const IonDensities ions = ion_balance(air, production(), Reactions::standard());
    EXPECT_NEAR((recombined(air, ions) + ions.leaving_cm3_s) / production().all(), 1.0, 1e-9)
        << air.altitude_km;
    EXPECT_NEAR(ions.ions() / ions.electrons, 1.0, 1e-9);
  }
}

// In pure O2 the electrons are those of recombination alone, sqrt(P/alpha).
TEST(IonBalance, OfOneIonIsARoot) {
  const ReactingAir air{110.0, 240.0, 240.0, 0.0, 1e12, 0.0, 0.0, 0.0};
  IonProduction p;
  p.o2p = 1000.0;
  const double alpha = Reactions::standard().at(240.0, 240.0).o2p_e();
  EXPECT_NEAR(ion_balance(air, p, Reactions::standard()).electrons / std::sqrt(1000.0 / alpha), 1.0, 1e-9);
}

// Around 110 km an aurora's ions are NO+ and O2+; far up they are O+ (Rees 1989, "Physics and Chemistry of
// the Upper Atmosphere", chapter 6).
TEST(IonBalance, LeavesMoleculesLowAndAtomsHigh) {
  const IonDensities low = ion_balance(air_at_110_km(), production(), Reactions::standard());
  EXPECT_GT(low.nop + low.o2p, 0.95 * low.electrons);
  IonProduction thin = production();
  for (double* rate : {&thin.n2p, &thin.np, &thin.o2p, &thin.op, &thin.op2d, &thin.op2p}) *rate *= 0.05;
  const IonDensities high = ion_balance(air_at_300_km(), thin, Reactions::standard());
  EXPECT_GT(high.op, 0.8 * high.electrons);
}

// O2+ in pure O2 grows as sqrt(P/alpha) tanh(t sqrt(P alpha) + c) from the night's NO+ floor, which is small
// against it: eight implicit steps are within 8 % of it at 20 s, where it grows fastest, and 5 % from 60 s
// on.
TEST(IonBalance, GrowsWithTime) {
  const ReactingAir air{110.0, 240.0, 240.0, 0.0, 1e12, 0.0, 0.0, 0.0};
  IonProduction p;
  p.o2p = 1000.0;
  const double alpha = Reactions::standard().at(240.0, 240.0).o2p_e(), last = std::sqrt(p.o2p / alpha);
  for (const double seconds : {20.0, 60.0, 200.0}) {
    const double electrons = ion_balance(air, p, Reactions::standard(), seconds).electrons;
    EXPECT_NEAR(electrons / (last * std::tanh(seconds * p.o2p / last)), 1.0, seconds < 60.0 ? 0.08 : 0.05)
        << seconds;
  }
  EXPECT_NEAR(ion_balance(air, p, Reactions::standard(), 1e5).electrons / last, 1.0, 1e-3);
}

// Far up nothing recombines within a minute: the night's electrons and what has been made since.
TEST(IonBalance, AddsToTheNightsLayer) {
  const ReactingAir air = air_at_300_km();
  const double night = night_ions(air).electrons;
  EXPECT_NEAR(night, 1e5 + 2e3, 1.0);
  IonProduction p;
  p.op = 500.0;
  EXPECT_NEAR(ion_balance(air, p, Reactions::standard(), 60.0).electrons / (night + 60.0 * p.op), 1.0, 0.03);
  // Hours later diffusion and recombination balance it.
  EXPECT_NEAR(ion_balance(air, p, Reactions::standard(), 1e8).electrons /
                  ion_balance(air, p, Reactions::standard()).electrons,
              1.0, 1e-3);
}

// What is made at a rate P from the onset on and lost at a rate L is P/L (1 - exp(-L t)); at a rate P t,
// P/L (t - (1 - exp(-L t))/L); without losses P t and P t^2/2. Exact between moments of any distance.
TEST(AtomsSinceOnset, RememberWhatMadeThem) {
  const std::vector<double> steps = {0.5, 1.0, 3.0, 10.0}, steadily(5, 7.0);
  std::vector<double> at = {0.0}, growing = {0.0};
  for (const double step : steps) {
    at.push_back(at.back() + step);
    growing.push_back(7.0 * at.back());
  }
  for (const double loss : {1e-9, 1e-4, 0.02, 1.0, 400.0}) {
    const std::vector<double> losses(5, loss), even = atoms_since_onset(steps, steadily, losses),
                                               rising = atoms_since_onset(steps, growing, losses);
    EXPECT_EQ(even.front(), 0.0);
    for (std::size_t t = 1; t < at.size(); ++t) {
      const double x = loss * at[t], grown = -std::expm1(-x) / x;
      EXPECT_NEAR(even[t] / (7.0 * at[t] * grown), 1.0, 1e-9) << loss;
      // By its series where the difference would cancel.
      const double late = x < 1e-2 ? 0.5 - x / 6.0 + x * x / 24.0 : (1.0 - grown) / x;
      EXPECT_NEAR(rising[t] / (7.0 * at[t] * at[t] * late), 1.0, 1e-6) << loss;
    }
  }
  EXPECT_EQ(atoms_since_onset({}, {6.0}, {2.0}), std::vector<double>{3.0});
}

// Atoms of recombination in pure O2, whose electrons grow as sqrt(P/alpha) tanh(t sqrt(P alpha)): P tanh^2
// are made. Electrons are within 8 % at 20 s and 5 % from 60 s on (above), their square within twice as much.
TEST(AtomsSinceOnset, FollowIonsThatGrow) {
  const ReactingAir air{110.0, 240.0, 240.0, 0.0, 1e12, 0.0, 0.0, 0.0};
  IonProduction p;
  p.o2p = 1000.0;
  const double alpha = Reactions::standard().at(240.0, 240.0).o2p_e(), per_s = std::sqrt(p.o2p * alpha);
  for (const double seconds : {20.0, 60.0}) {
    const IonHistory history = ion_history(air, p, Reactions::standard(), seconds);
    std::vector<double> made;
    for (const IonDensities& ions : history.ions) made.push_back(alpha * ions.electrons * ions.o2p);
    for (const double lifetime_s : {0.7, 30.0}) {
      const double atoms =
          atoms_since_onset(history.step_s, made, std::vector<double>(made.size(), 1.0 / lifetime_s)).back();
      constexpr int kSteps = 20000;
      const double step = seconds / kSteps;
      double exact = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) * step, grown = std::tanh(t * per_s);
        exact += p.o2p * grown * grown * std::exp(-(seconds - t) / lifetime_s) * step;
      }
      EXPECT_NEAR(atoms / exact, 1.0, seconds < 60.0 ? 0.16 : 0.10)
          << seconds << " s, " << lifetime_s << " s";
    }
  }
}

TEST(IonBalance, OfNothingIsNothing) {
  EXPECT_EQ(ion_balance(air_at_110_km(), {}, Reactions::standard()).electrons, 0.0);
}

}  // namespace
}  // namespace vegard::sim::ion_balance_test
