#include "fit/search/sine_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/parameters/parameter_map.h"
#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_line.h"
#include "tests/support/free_paths.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::sine_search_test {
namespace {

/// A sheet that runs east, with its sine free.
sim::Scene scene_with_sine(int layers, const std::vector<std::string>& also = {}) {
  sim::Scene scene = tests::small_scene();
  sim::Sheet& sheet = scene.sheets[0];
  sheet.center_km = {20.0, 200.0};
  sheet.bearing_deg = 90.0;
  sheet.length_km = 300.0;
  sheet.layers = layers;
  sheet.phase_shift_rad = 0.9;
  for (const char* key : {"wavelength_km", "phase_rad", "thickness_km"})
    scene.fit.free.push_back(tests::free_entry(std::string("sheet.main.") + key));
  for (const std::string& key : also) scene.fit.free.push_back(tests::free_entry("sheet.main." + key));
  return scene;
}

/// The scene once it has taken the sine that was found.
sim::Scene with_sine(sim::Scene scene, const SineThroughOffsets& found) {
  const std::vector<FreeNumber> free = free_numbers(scene);
  std::vector<double> values;
  for (const FreeNumber& number : free) values.push_back(number.start);
  take_sine(scene, free, found, 0, values);
  ParameterMap(scene, free).put(values, scene);
  return scene;
}

SineThroughOffsets found_sine() {
  SineThroughOffsets found;
  found.wavelength_km = 70.0;
  found.amplitude_km = 3.0;
  found.phase_rad = 1.1;
  return found;
}

// Lateral offsets are those of the mean layer, which sim::sine_feet draws.
TEST(TakeSine, IsTheMeanLayersOfOneAndOfThree) {
  constexpr int kFeet = 25;
  for (const int layers : {1, 3}) {
    const sim::Scene scene = with_sine(scene_with_sine(layers), found_sine());
    const std::vector<sim::EastNorth> feet = sim::sine_feet(scene, scene.sheets[0], 0.0, 0, kFeet);
    for (int i = 0; i < kFeet; ++i) {
      const double along = 300.0 * i / (kFeet - 1);
      EXPECT_NEAR(feet[i].north - 200.0, 3.0 * std::sin(sim::kTwoPi * along / 70.0 + 1.1), 1e-6)
          << layers << " layers, " << along << " km from the start";
    }
  }
}

TEST(TakeSine, MovesTheLineAsideAndTheSineWithIt) {
  SineThroughOffsets found = found_sine();
  found.offset_km = 4.0;
  for (const auto& free : {std::vector<std::string>{"center_km.east", "center_km.north"},
                           std::vector<std::string>{"center_km.north"}}) {
    const sim::Scene scene = with_sine(scene_with_sine(2, free), found);
    EXPECT_NEAR(scene.sheets[0].center_km.east, 20.0, 1e-9);
    EXPECT_NEAR(scene.sheets[0].center_km.north, 204.0, 1e-9) << "to the left, which is north";
    EXPECT_NEAR(std::remainder(scene.sheets[0].phase_rad + 0.45 - 1.1, sim::kTwoPi), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace vegard::fit::sine_search_test
