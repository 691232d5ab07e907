#include "sim/light/ionosphere/conductivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/light/transport/field_air.h"

namespace vegard::sim::conductivity_test {
namespace {

constexpr double kFieldNt = 54000.0, kChargeC = 1.602176634e-19, kPerM3 = 1e6;

ReactingAir standard_air_at(double altitude_km) {
  const AirTable at = air_at(standard_air_table(), {altitude_km});
  return {altitude_km,
          at.temperature_k[0],
          at.electron_temperature_k[0],
          at.density_cm3[0][0],
          at.density_cm3[1][0],
          at.density_cm3[2][0],
          at.no_cm3[0],
          0.0};
}

IonDensities nitric_oxide_ions(double cm3) {
  IonDensities ions;
  ions.nop = ions.electrons = cm3;
  return ions;
}

/// The charge over the field's strength for a density, S m^-1: the largest Hall conductivity.
double charge_over_field(double cm3) { return kPerM3 * cm3 * kChargeC / (1e-9 * kFieldNt); }

ReactingAir denser(ReactingAir air, double factor) {
  for (double* gas : {&air.n2, &air.o2, &air.o}) *gas *= factor;
  return air;
}

// r/(1 + r^2) is largest at r = 1, where it is a half: there ions of one kind carry n e/(2B), up to the
// electrons' part, which collide some 400 times less than they gyrate.
TEST(Conductivity, PedersenIsLargestWhereIonsCollideAsOftenAsTheyGyrate) {
  constexpr double kNitricOxideU = 30.006, kStepKm = 0.1;
  double most = 0.0, most_km = 0.0, equal_km = 0.0;
  for (double altitude = 100.0; altitude < 150.0; altitude += kStepKm) {
    const ReactingAir air = standard_air_at(altitude);
    const double pedersen = conductivity(air, nitric_oxide_ions(1e5), kFieldNt).pedersen;
    if (pedersen > most) most = pedersen, most_km = altitude;
    if (collision_frequencies(air, 1e5).nop > ion_gyrofrequency_s(kNitricOxideU, kFieldNt))
      equal_km = altitude;
  }
  EXPECT_NEAR(most_km, equal_km, 2.0 * kStepKm);
  EXPECT_NEAR(most / (0.5 * charge_over_field(1e5)), 1.0, 0.01);
  // Textbooks have it at 120 to 130 km (Kelley 2009, "The Earth's Ionosphere", chapter 2).
  EXPECT_GT(equal_km, 115.0);
  EXPECT_LT(equal_km, 130.0);
}

// Without collisions all charges drift across both fields: no current. With very many the field does not
// matter, and current flows along the electric field as it does along the magnetic one.
TEST(Conductivity, HasTheLimitsOfFewAndOfManyCollisions) {
  const IonDensities ions = nitric_oxide_ions(1e5);
  const ReactingAir air = standard_air_at(120.0);
  const Conductivity few = conductivity(denser(air, 1e-6), ions, kFieldNt);
  EXPECT_LT(few.pedersen, 1e-5 * charge_over_field(1e5));
  EXPECT_LT(few.hall, 1e-9 * charge_over_field(1e5));
  const Conductivity many = conductivity(denser(air, 1e7), ions, kFieldNt);
  EXPECT_NEAR(many.pedersen / many.parallel, 1.0, 1e-3);
  EXPECT_LT(many.hall, 0.01 * many.pedersen);
  // Between them, where electrons drift and ions are held: all of n e/B is Hall current.
  EXPECT_NEAR(conductivity(denser(air, 20.0), ions, kFieldNt).hall / charge_over_field(1e5), 1.0, 0.01);
}

TEST(Conductivity, IsNoneWithoutCharges) {
  const Conductivity none = conductivity(standard_air_at(120.0), {}, kFieldNt);
  EXPECT_EQ(none.pedersen, 0.0);
  EXPECT_EQ(none.hall, 0.0);
  EXPECT_EQ(none.parallel, 0.0);
}

// A current of charges is proportional to them, except along the field, where they hinder each other.
TEST(Conductivity, GrowsWithTheCharges) {
  const ReactingAir air = standard_air_at(200.0);
  const Conductivity once = conductivity(air, nitric_oxide_ions(1e5), kFieldNt),
                     thrice = conductivity(air, nitric_oxide_ions(3e5), kFieldNt);
  EXPECT_NEAR(thrice.pedersen / once.pedersen, 3.0, 1e-9);
  EXPECT_NEAR(thrice.hall / once.hall, 3.0, 1e-9);
  EXPECT_LT(thrice.parallel, 3.0 * once.parallel);
}

}  // namespace
}  // namespace vegard::sim::conductivity_test
