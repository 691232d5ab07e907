#include "sim/view/sensor/tone_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/scene/structs/scene.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::display_table_test {
namespace {

int by_the_curve(const ToneCurve& tone, float light) {
  const double encoded = static_cast<float>(tone.encode(std::clamp<double>(light, 0.0, 1.0)));
  return static_cast<int>(std::lround(encoded * 255.0));
}

TEST(DisplayTable, IsTheRoundedCurve) {
  Scene scene;
  for (const char* name : {"srgb", "linear", "gamma"}) {
    scene.sensor.tone = tests::kind_named<ToneKind>(name);
    const ToneCurve tone(scene);
    const DisplayTable table(tone);
    for (int i = -100; i <= 20100; ++i) {
      const float light = static_cast<float>(i) / 20000.0f;
      ASSERT_EQ(table(light), by_the_curve(tone, light)) << name << " " << light;
    }
    EXPECT_EQ(table(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(table(std::numeric_limits<float>::infinity()), 255);
  }
}

TEST(DisplayTable, ChangesAtTheVeryFloatWhereTheCurveRoundsUp) {
  const ToneCurve tone{Scene()};
  const DisplayTable table(tone);
  for (int number = 1; number < 256; ++number) {
    float light = static_cast<float>(tone.decode((number - 0.5) / 255.0));
    for (int i = 0; i < 40; ++i) light = std::nextafter(light, 0.0f);
    for (int i = 0; i < 80; ++i, light = std::nextafter(light, 1.0f))
      ASSERT_EQ(table(light), by_the_curve(tone, light)) << number;
  }
}

TEST(DisplayTable, OfAPictureDoesNotDependOnTheThreads) {
  Image light(7, 5, {"R", "G", "B"});
  for (std::size_t i = 0; i < light.data.size(); ++i) light.data[i] = 0.01f * static_cast<float>(i) - 0.02f;
  const DisplayTable table(ToneCurve{Scene()});
  const std::vector<std::uint8_t> bytes = table.bytes(light, 1);
  ASSERT_EQ(bytes.size(), light.data.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], table(light.data[i]));
  EXPECT_EQ(table.bytes(light, 2), bytes);
}

}  // namespace
}  // namespace vegard::sim::display_table_test
