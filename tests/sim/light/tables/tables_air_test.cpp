#include "sim/light/tables/emission_tables.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "sim/base/file/csv_table.h"
#include "tests/support/glow.h"

namespace vegard::sim::tables_air_test {
namespace {

// What gravity there must be for the scale height, kT / (m H), beside that of the U.S. Standard Atmosphere
// 1976, table I: 9.5644, 9.5052 and 8.9427 m s^-2 at 80, 100 and 300 km. Its Earth's radius is
// 6357 km.
TEST(TablesAir, IsHeldByTheEarthsGravity) {
  constexpr double kBoltzmann = 1.380649e-23, kDalton = 1.66053907e-27;
  const CsvTable table = tests::glow_table("atmosphere.csv");
  const std::vector<double>& altitude = table.column("altitude_km");
  ASSERT_EQ(tests::glow().tables.air().size(), altitude.size());
  int found = 0;
  for (std::size_t r = 0; r < altitude.size(); ++r) {
    const double gravity = altitude[r] == 80.0    ? 9.5644
                           : altitude[r] == 100.0 ? 9.5052
                           : altitude[r] == 300.0 ? 8.9427
                                                  : 0.0;
    if (gravity == 0.0) continue;
    ++found;
    const double o = table.column("nO")[r], o2 = table.column("nO2")[r], n2 = table.column("nN2")[r];
    const double mass_dalton = (15.999 * o + 31.998 * o2 + 28.014 * n2) / (o + o2 + n2);
    const StoppingAir& air = tests::glow().tables.air()[r];
    const double height_m = 0.01 * air.scale_height_cm;
    EXPECT_NEAR(kBoltzmann * table.column("T_K")[r] / (mass_dalton * kDalton * height_m), gravity, 0.003)
        << altitude[r] << " km";
    const double density_g_cm3 = 1e3 * kDalton * mass_dalton * (o + o2 + n2);
    EXPECT_NEAR(air.mass_column_g_cm2 / (density_g_cm3 * air.scale_height_cm), 1.0, 1e-9)
        << altitude[r] << " km";
  }
  EXPECT_EQ(found, 3);
}

}  // namespace
}  // namespace vegard::sim::tables_air_test
