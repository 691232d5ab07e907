#include "sim/light/transport/collisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/base/file/csv_table.h"

namespace vegard::sim::collisions_test {
namespace {

TEST(Collisions, KnowEveryProcessOfTheTables) {
  const CsvTable table = embedded_csv_table("cross_sections.csv"), shells = embedded_csv_table("shells.csv");
  const auto& numbers = table.column("process");
  const std::set<double> processes(numbers.begin(), numbers.end());
  std::size_t known = 1, ions = 0;  // the momentum transfer of N2
  for (int g = 0; g < kGases; ++g) {
    const GasCollisions& gas = gas_collisions(static_cast<Gas>(g));
    EXPECT_FALSE(gas.elastic.cm2.empty());
    EXPECT_FALSE(gas.ionisation.cm2.empty());
    known += 2 + gas.excitations.size();
    ions += gas.shells.size();
    for (const Excitation& e : gas.excitations) {
      ASSERT_GE(e.curve.cm2.size(), 2u) << e.name;
      EXPECT_EQ(e.curve.at(e.curve.loss_ev), 0.0) << e.name;
      EXPECT_GE(e.curve.energy_ev.front(), e.curve.loss_ev - 1e-9) << e.name;
      for (std::size_t i = 1; i < e.curve.energy_ev.size(); ++i)
        EXPECT_GT(e.curve.energy_ev[i], e.curve.energy_ev[i - 1]) << e.name;
    }
  }
  EXPECT_EQ(known, processes.size());
  EXPECT_EQ(ions, shells.rows());
}

TEST(Collisions, GoOnWithoutAStepBeyondTheirTables) {
  for (int g = 0; g < kGases; ++g) {
    const GasCollisions& gas = gas_collisions(static_cast<Gas>(g));
    for (const Excitation& e : gas.excitations) {
      const double end = e.curve.energy_ev.back(), before = e.curve.at(end * (1.0 - 1e-9));
      const double most = *std::max_element(e.curve.cm2.begin(), e.curve.cm2.end());
      EXPECT_NEAR(e.curve.at(end * (1.0 + 1e-9)), before, 1e-6 * most) << e.name;
    }
    const double end = gas.elastic.energy_ev.back();
    EXPECT_NEAR(gas.elastic_cm2(end * 1.000001) / gas.elastic_cm2(end * 0.999999), 1.0, 1e-4);
    const double last = gas.ionisation.energy_ev.back();
    EXPECT_NEAR(gas.shell_factor(last * 1.000001) / gas.shell_factor(last * 0.999999), 1.0, 1e-4);
  }
  EXPECT_NEAR(elastic_transfer_ratio(965.06) / elastic_transfer_ratio(965.04), 1.0, 1e-3);
}

TEST(Collisions, IoniseAsObserved) {
  // Rapp and Englander-Golden 1965 at 100 eV: 2.52e-16 cm^2 of N2.
  const GasCollisions& n2 = gas_collisions(Gas::n2);
  double sum = 0.0;
  for (const IonisedShell& shell : n2.shells) sum += ShellSpectrum(shell, 100.0).cm2();
  EXPECT_NEAR(n2.shell_factor(100.0) * sum, 2.52e-16, 1e-20);
  // The formula alone: its constants would not be those of N2 if it were far off.
  EXPECT_NEAR(n2.shell_factor(100.0), 1.0, 0.05);
  EXPECT_NEAR(n2.shell_factor(1000.0), 1.0, 0.05);
  EXPECT_EQ(n2.shell_factor(2e4), 1.0);
}

TEST(Collisions, StopAsBetheHasIt) {
  // Dry air of NIST's ESTAR (mean excitation energy 85.7 eV), MeV cm^2 g^-1, for a mixture of 78 and 22 %.
  // The tolerance is what independent cross-sections reach; at 1 keV it is Bethe's formula with ICRU's 82 and
  // 95 eV that is compared with, whose shells are not yet all fast.
  constexpr double kMolar = 0.78 * 28.014 + 0.22 * 31.998, kPerG = 6.02214076e23 / kMolar;
  const auto air = [](double energy) {
    return 1e-6 * kPerG * (0.78 * stopping_ev_cm2(Gas::n2, energy) + 0.22 * stopping_ev_cm2(Gas::o2, energy));
  };
  EXPECT_NEAR(air(1e4) / 19.76, 1.0, 0.04);
  EXPECT_NEAR(air(2e4) / 11.57, 1.0, 0.04);
  EXPECT_NEAR(air(5e4) / 5.819, 1.0, 0.04);
  const auto bethe = [](double z, double mean_excitation, double energy) {
    return 2.0 * 6.514e-14 * z / energy * std::log(1.166 * energy / mean_excitation);
  };
  EXPECT_NEAR(air(1e3) / (1e-6 * kPerG * (0.78 * bethe(14, 82, 1e3) + 0.22 * bethe(16, 95, 1e3))), 1.0, 0.06);
}

}  // namespace
}  // namespace vegard::sim::collisions_test
