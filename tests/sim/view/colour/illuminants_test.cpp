#include "sim/view/colour/colour.h"

#include <gtest/gtest.h>

#include <array>

namespace vegard::sim::illuminants_test {
namespace {

template <class Power>
std::array<double, 2> chromaticity(const Power& power) {
  Vector3 xyz{};
  for (double nm = 380.0; nm <= 780.0; nm += 5.0)
    for (int i = 0; i < 3; ++i) xyz[i] += power(nm) * colour_matching(nm)[i];
  const double sum = xyz[0] + xyz[1] + xyz[2];
  return {xyz[0] / sum, xyz[1] / sum};
}

TEST(BlackBody, IsIlluminantAAtItsTemperature) {
  // CIE 15: A is Planckian for 2848 K with a second radiation constant of 1.435e-2 m K; x 0.44757, y 0.40745.
  const double temperature_k = 2848.0 * 1.438776877 / 1.435;
  EXPECT_NEAR(temperature_k, 2855.5, 0.05);
  const auto [x, y] = chromaticity([&](double nm) { return black_body_power(nm, temperature_k); });
  EXPECT_NEAR(x, 0.44757, 1e-5 + 5e-6);
  EXPECT_NEAR(y, 0.40745, 1e-5 + 5e-6);
}

TEST(Daylight, IsD65AtItsTemperature) {
  const auto [x, y] = chromaticity([](double nm) { return daylight_power(nm, kD65Temperature_k); });
  EXPECT_NEAR(x, 0.31272, 1e-5 + 5e-6);
  EXPECT_NEAR(y, 0.32903, 1e-5 + 5e-6);
  // CIE 15, table of D65.
  EXPECT_NEAR(daylight_power(400.0, kD65Temperature_k), 82.7549, 5e-3);
  EXPECT_NEAR(daylight_power(560.0, kD65Temperature_k), 100.0, 1e-9);
  EXPECT_NEAR(daylight_power(700.0, kD65Temperature_k), 71.6091, 5e-3);
  EXPECT_NEAR(daylight_power(555.0, kD65Temperature_k), 102.023, 5e-3);
}

TEST(Daylight, EndsWithItsTable) {
  EXPECT_EQ(daylight_power(299.0, 6500.0), 0.0);
  EXPECT_EQ(daylight_power(831.0, 6500.0), 0.0);
  EXPECT_GT(daylight_power(830.0, 6500.0), 0.0);
}

}  // namespace
}  // namespace vegard::sim::illuminants_test
