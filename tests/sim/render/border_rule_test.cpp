// The lower border by where beams start, literally as the paper has it, beside that of their light.
#include <gtest/gtest.h>

#include "sim/render/film.h"
#include "tests/support/exposed.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::border_rule_test {
namespace {

double green_light(const Scene& scene) {
  const Exposure exposure = tests::exposed(scene);
  double sum = 0.0;
  for (std::size_t i = 0; i < exposure.cells(); ++i) sum += exposure.rayleigh[exposure.cells() + i];
  return sum;
}

TEST(BorderRule, OfTheStartCutsLightOff) {
  Scene scene = tests::small_scene();
  const double even = green_light(scene);
  Sheet& sheet = scene.sheets[0];
  sheet.border_rule = BorderRule::start;
  EXPECT_EQ(green_light(scene), even) << "without an undulation there is nothing to move";
  // The octaves' sum is mostly within a quarter of the amplitude: half of the beams end up to 25 km higher,
  // at 80 to 105 km, where a tenth of the light is below. Random: the scene's seed, and 5 % for it.
  sheet.border_amplitude_km = 100.0;
  const double cut = green_light(scene);
  EXPECT_LT(cut, 0.97 * even);
  EXPECT_GT(cut, 0.6 * even);
}

TEST(BorderRule, OfTheStartLeavesLightWhereItIs) {
  Scene scene = tests::small_scene();
  Sheet& sheet = scene.sheets[0];
  const Exposure even = tests::exposed(scene);
  sheet.border_amplitude_km = 2.0;  // a path that ends below 86 km has all of its light
  sheet.border_rule = BorderRule::start;
  const Exposure literal = tests::exposed(scene);
  double difference = 0.0, light = 0.0;
  for (std::size_t i = 0; i < even.rayleigh.size(); ++i) {
    difference += literal.rayleigh[i] - even.rayleigh[i];
    light += even.rayleigh[i];
  }
  EXPECT_NEAR(difference / light, 0.0, 0.005);
}

}  // namespace
}  // namespace vegard::sim::border_rule_test
