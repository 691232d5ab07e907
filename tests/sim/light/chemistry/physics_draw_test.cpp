#include "sim/light/chemistry/physics_draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/file/csv_table.h"
#include "sim/light/transport/collisions.h"
#include "sim/light/transport/degradation.h"

namespace vegard::sim::physics_draw_test {
namespace {

// Of 2000 draws (seed 3) a sample standard deviation is within 1/sqrt(2 2000) = 1.6 % of the true one in 68
// %: 7 % is beyond four of these. The mean is within 4.5 standard errors.
TEST(PhysicsDraw, HasTheSpreadOfTheTable) {
  constexpr int kDraws = 2000;
  const int number = static_cast<int>(Reaction::o1s_of_n2a);
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t d = 0; d < kDraws; ++d) {
    const double ln = std::log(draw_physics(3, d).reactions.at(number));
    sum += ln;
    squares += ln * ln;
  }
  const CsvTable table = embedded_csv_table("uncertainties.csv");
  double sigma = 0.0;
  for (std::size_t r = 0; r < table.rows(); ++r)
    if (table.column("table")[r] == 1 && table.column("number")[r] == number)
      sigma = table.column("ln_sigma")[r];
  EXPECT_NEAR(sum / kDraws, 0.0, 4.5 * sigma / std::sqrt(kDraws));
  EXPECT_NEAR(std::sqrt(squares / kDraws) / sigma, 1.0, 0.07);
}

TEST(PhysicsDraw, NamesNumbersThatExist) {
  const CsvTable reactions = embedded_csv_table("reactions.csv"),
                 cross_sections = embedded_csv_table("cross_sections.csv"),
                 emissions = embedded_csv_table("emissions.csv");
  const auto has = [](const std::vector<double>& numbers, int number) {
    return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
  };
  const PhysicsDraw draw = draw_physics(1, 0);
  for (const auto& [number, factor] : draw.reactions)
    EXPECT_TRUE(has(reactions.column("number"), number)) << number;
  for (const auto& [process, factor] : draw.processes)
    EXPECT_TRUE(process == kElasticTurn || process == kInelasticTurn ||
                has(cross_sections.column("process"), process) || has(emissions.column("process"), process))
        << process;
  EXPECT_EQ(draw.of_the_air.size(), 6u);
}

TEST(PhysicsDraw, ScalesCrossSections) {
  const auto scaled = scaled_collisions({{131, 2.0}, {110, 1.5}});
  const GasCollisions &now = scaled[0], &before = gas_collisions(Gas::n2);
  for (std::size_t e = 0; e < now.excitations.size(); ++e) {
    const double factor = now.excitations[e].name == "N2 A3Sigma v=5-9" ? 2.0 : 1.0;
    EXPECT_DOUBLE_EQ(now.excitations[e].curve.at(20.0), factor * before.excitations[e].curve.at(20.0));
  }
  EXPECT_NEAR(now.shell_factor(100.0), 1.5 * before.shell_factor(100.0), 1e-12);
}

TEST(PhysicsDraw, KeepsSharesOfReactions) {
  const Reactions changed = Reactions::standard().scaled({{82, 3.0}, {69, 2.0}, {94, 5.0}});
  EXPECT_NEAR(changed.value(Reaction::np_to_nop) + changed.value(Reaction::np_to_o2p) +
                  changed.value(Reaction::np_to_op),
              1.0, 1e-12);
  EXPECT_EQ(changed.value(Reaction::b_of_w), 1.0);            // a share
  EXPECT_DOUBLE_EQ(changed.value(Reaction::o1d_of_o2), 2.0);  // a yield
}

// Isothermal air in hydrostatic balance: n = n0 exp(-(z - 100)/H) with H in proportion to T.
TEST(PhysicsDraw, WarmerAirIsHydrostatic) {
  AirTable air;
  for (double z = 80.0; z <= 400.0; z += 10.0) {
    air.altitude_km.push_back(z);
    air.temperature_k.push_back(500.0);
    for (auto& gas : air.density_cm3) gas.push_back(1e12 * std::exp(-(z - 100.0) / 20.0));
  }
  const AirTable warm = changed_air(air, {{UncertainAir::temperature, 1.1}});
  for (std::size_t i = 0; i < air.altitude_km.size(); ++i) {
    if (air.altitude_km[i] < 100.0) continue;
    EXPECT_DOUBLE_EQ(warm.temperature_k[i], 550.0);
    EXPECT_NEAR(std::log(warm.density_cm3[0][i] / (1e12 * std::exp(-(air.altitude_km[i] - 100.0) / 22.0))),
                0.0, 1e-12);
  }
  const AirTable more = changed_air(air, {{UncertainAir::oxygen, 2.0}, {UncertainAir::density, 1.5}});
  EXPECT_NEAR(more.density_cm3[2][3] / air.density_cm3[2][3], 3.0, 1e-12);
  EXPECT_NEAR(more.density_cm3[0][3] / air.density_cm3[0][3], 1.5, 1e-12);
}

}  // namespace
}  // namespace vegard::sim::physics_draw_test
