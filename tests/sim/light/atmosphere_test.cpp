#include "sim/light/atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace vegard::sim::atmosphere_test {
namespace {

constexpr double kGas = 8314.32;  // J kg^-1 K^-1 times the molar mass in kg kmol^-1, the standard's
constexpr double kEffectiveEarthKm = 6356.766;

double gravity_m_s2(double altitude_km) {
  const double ratio = kEffectiveEarthKm / (kEffectiveEarthKm + altitude_km);
  return 9.80665 * ratio * ratio;
}

/// The logarithm of the factor by which n T of a gas falls from one altitude to another under its own weight.
double fall_of_log_nt(double from_km, double to_km, double molar_mass) {
  constexpr int kSteps = 200;
  const double step_km = (to_km - from_km) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double h = from_km + (i + 0.5) * step_km;
    sum += molar_mass * gravity_m_s2(h) / (kGas * standard_air(h).temperature_k) * 1e3 * step_km;
  }
  return sum;
}

TEST(StandardAir, IsTheStandardsPrintedTable) {
  // U.S. Standard Atmosphere 1976, tables I (temperature) and VIII (number densities, here per cm3).
  struct Printed {
    double altitude_km, temperature_k, n2, o, o2;
  };
  for (const Printed& p : std::initializer_list<Printed>{{86, 186.87, 1.130e14, 8.600e10, 3.031e13},
                                                         {100, 195.08, 9.210e12, 4.298e11, 2.151e12},
                                                         {120, 360.00, 3.726e11, 9.275e10, 4.395e10},
                                                         {150, 634.39, 3.124e10, 1.780e10, 2.750e9},
                                                         {200, 854.56, 2.925e9, 4.050e9, 1.918e8},
                                                         {300, 976.01, 9.593e7, 5.443e8, 3.942e6},
                                                         {400, 995.83, 4.669e6, 9.584e7, 1.252e5},
                                                         {500, 999.24, 2.592e5, 1.836e7, 4.607e3},
                                                         {600, 999.85, 1.575e4, 3.707e6, 1.880e2}}) {
    const Air air = standard_air(p.altitude_km);
    EXPECT_NEAR(air.temperature_k, p.temperature_k, 0.01) << p.altitude_km;
    EXPECT_NEAR(air.n2_cm3 / p.n2, 1.0, 1e-3) << p.altitude_km;
    EXPECT_NEAR(air.o2_cm3 / p.o2, 1.0, 1e-3) << p.altitude_km;
    EXPECT_NEAR(air.o_cm3 / p.o, 1.0, 3e-3) << p.altitude_km;
  }
}

TEST(StandardAir, IsHeldUpByItsOwnPressureFromRowToRow) {
  // Above 100 km N2, and above 150 km O and O2 as well, lie each under its own weight: d ln(n T)/dh = -M
  // g/RT. The table has four digits and straight lines between its rows.
  for (double h = 105.0; h < 635.0; h += 10.0) {
    const Air low = standard_air(h), high = standard_air(h + 5.0);
    const auto fall = [&](double below, double above) {
      return std::log(below * low.temperature_k / (above * high.temperature_k));
    };
    EXPECT_NEAR(fall(low.n2_cm3, high.n2_cm3) / fall_of_log_nt(h, h + 5.0, 28.0134), 1.0, 0.01) << h;
    if (h < 150.0) continue;
    EXPECT_NEAR(fall(low.o2_cm3, high.o2_cm3) / fall_of_log_nt(h, h + 5.0, 31.9988), 1.0, 0.01) << h;
    EXPECT_NEAR(fall(low.o_cm3, high.o_cm3) / fall_of_log_nt(h, h + 5.0, 15.9994), 1.0, 0.01) << h;
  }
}

TEST(StandardAir, IsMixedBelow86KilometresAndEndsWithItsTable) {
  for (const double h : {80.0, 82.5, 85.0}) {
    const Air air = standard_air(h);
    EXPECT_NEAR(air.o2_cm3 / air.n2_cm3, 0.209476 / 0.78084, 1e-4) << h;
    EXPECT_LT(air.o_cm3, 3e-3 * air.o2_cm3) << h;
    const double pressure_falls = std::log(air.n2_cm3 * air.temperature_k /
                                           (standard_air(86.0).n2_cm3 * standard_air(86.0).temperature_k));
    EXPECT_NEAR(pressure_falls / fall_of_log_nt(h, 86.0, 28.9644), 1.0, 0.01) << h;
  }
  EXPECT_EQ(standard_air(20.0).n2_cm3, standard_air(80.0).n2_cm3);
  EXPECT_EQ(standard_air(900.0).o_cm3, standard_air(640.0).o_cm3);
}

}  // namespace
}  // namespace vegard::sim::atmosphere_test
