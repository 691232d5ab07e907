// A macro-loop along rays: its light's derivatives by what a scene says of it.
#include <gtest/gtest.h>

#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/emit/sun/strand/strand_emitter.h"
#include "tests/support/light_derivatives.h"
#include "tests/support/seeded_numbers.h"

namespace vegard::sim::loop_light_test {
namespace {

using tests::plain_double;

TEST(LoopLight, DerivativesAreThoseOfItsLight) {
  Sun sun = tests::level_sun(3000.0);
  sun.radius = 700.0;
  Loop loop;
  loop.longitude_deg = 80.0;
  loop.bearing_deg = 30.0;
  loop.strands = 15;
  loop.strand_radius = 6.0;
  loop.tilt_deg = 20.0;
  loop.skew = 5.0;
  loop.root_noise = 3.0;
  loop.height_noise = 0.1;
  loop.tilt_noise_deg = 4.0;
  loop.density_noise = 0.3;
  loop.filaments = 3;
  loop.height_falloff = HeightFalloff::fade;
  loop.falloff_least = 0.2;
  loop.brightening = 1.0;
  loop.brightening_at = 0.6;
  const std::vector<double*> numbers = {
      &loop.latitude_deg,  &loop.longitude_deg, &loop.bearing_deg, &loop.height,      &loop.width,
      &loop.sharpness,     &loop.skew,          &loop.tilt_deg,    &loop.spread,      &loop.strand_radius,
      &loop.falloff_least, &loop.base_density,  &loop.root_noise,  &loop.brightening, &sun.position_angle_deg,
      &sun.distance_km};
  const NumberAs<FreeDual> number = tests::seeded({numbers.begin(), numbers.end()});
  const StrandEmitter<FreeDual> dual(strands_of<FreeDual>(sun, loop, 1, number), sun,
                                     SunFrame<FreeDual>(sun, number), {FreeDual(1.0)});
  std::vector<std::array<double, 2>> places;
  for (int k = 0; k < 25; ++k) places.push_back({690.0 + 4.0 * k, 35.0 * std::sin(2.3 * k)});
  const auto make = [&] {
    return std::make_unique<StrandEmitter<double>>(strands_of<double>(sun, loop, 1, plain_double), sun,
                                                   SunFrame<double>(sun, plain_double),
                                                   std::vector<double>{1.0});
  };
  EXPECT_GE(tests::expect_light_derivatives(dual, numbers, make, 3000.0, places, 1e-4), 8);
}

}  // namespace
}  // namespace vegard::sim::loop_light_test
