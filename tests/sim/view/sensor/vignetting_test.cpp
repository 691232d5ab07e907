#include "sim/view/sensor/sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/scene/table/parameter_table.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::vignetting_test {
namespace {

TEST(Vignetting, IsNoneUnlessAskedFor) {
  const Vignetting vignetting(tests::small_scene());
  EXPECT_TRUE(vignetting.none());
  EXPECT_EQ(vignetting.at(3.0, 4.0), 1.0);
}

// A pinhole's angle off the axis: tan = distance over focal length.
TEST(Vignetting, NaturalFallOffOfAPinhole) {
  Scene scene = tests::small_scene();
  scene.sensor.vignetting_cos_power = 4.0;
  const Vignetting vignetting(scene);
  const double focal_px = 80.0 / std::tan(M_PI / 6.0);
  for (const auto& [x, y] : {std::pair{80.0, 60.0}, {160.0, 60.0}, {0.0, 0.0}, {31.5, 97.25}}) {
    const double square = ((x - 80.0) * (x - 80.0) + (y - 60.0) * (y - 60.0)) / (focal_px * focal_px);
    EXPECT_NEAR(vignetting.at(x, y), 1.0 / ((1.0 + square) * (1.0 + square)), 1e-9);
  }
}

TEST(Vignetting, PolynomialIsOneInTheMiddleAndItsSumInTheCorners) {
  Scene scene = tests::small_scene();
  scene.sensor.vignetting = {-0.4, 0.2, -0.1};
  const Vignetting vignetting(scene);
  EXPECT_DOUBLE_EQ(vignetting.at(80.0, 60.0), 1.0);
  EXPECT_NEAR(vignetting.at(160.0, 0.0), 0.7, 1e-12);
  EXPECT_NEAR(vignetting.at(120.0, 60.0), 1.0 - 0.4 * 0.16 + 0.2 * 0.16 * 0.16 - 0.1 * 0.16 * 0.16 * 0.16,
              1e-12);
}

TEST(Vignetting, ALensMustGiveLight) {
  Scene scene = tests::small_scene();
  scene.sensor.vignetting = {-1.2, 0.0, 0.0};
  const std::string message = tests::expect_error(ErrorKind::scene, [&] { validate(scene); });
  EXPECT_NE(message.find("sensor.vignetting"), std::string::npos) << message;
}

}  // namespace
}  // namespace vegard::sim::vignetting_test
