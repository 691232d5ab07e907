#include "sim/view/sensor/tone_curve.h"
#include "sim/scene/structs/scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/scene/structs/scene.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::tone_curve_test {
namespace {

Scene with_curve(const std::string& text) {
  Scene scene;
  scene.sensor.tone = ToneKind::file;
  scene.sensor.tone_file = "curve.csv";
  scene.tables["sensor.tone_file"] = text;
  return scene;
}

const char* const kCurve = "linear,encoded\n0,0.02\n0.1,0.4\n0.5,0.8\n1,1\n";

TEST(ToneCurve, ComesBack) {
  std::vector<Scene> scenes(4);
  scenes[1].sensor.tone = ToneKind::linear;
  scenes[2].sensor.tone = ToneKind::gamma;
  scenes[2].sensor.gamma = 1.8;
  scenes[3] = with_curve(kCurve);
  for (const Scene& scene : scenes) {
    const ToneCurve curve(scene);
    for (double linear = 0.0; linear <= 1.0; linear += 1.0 / 64.0)
      EXPECT_NEAR(curve.decode(curve.encode(linear)), linear, 1e-7) << curve.name();
    EXPECT_NEAR(curve.encode(1.0), 1.0, 1e-12) << curve.name();
  }
}

TEST(ToneCurve, IsWhatTheSceneSays) {
  Scene scene;
  EXPECT_EQ(ToneCurve(scene).encode(0.3), srgb_encode(0.3));
  scene.sensor.tone = ToneKind::gamma;
  scene.sensor.gamma = 2.0;
  EXPECT_NEAR(ToneCurve(scene).encode(0.25), 0.5, 1e-15);
  const ToneCurve measured(with_curve(kCurve));
  EXPECT_NEAR(measured.encode(0.3), 0.6, 1e-12);
  EXPECT_NEAR(measured.decode(0.6), 0.3, 1e-12);
  EXPECT_EQ(measured.encode(0.0), 0.02);
  EXPECT_EQ(measured.decode(0.01), 0.0);
  EXPECT_EQ(measured.name(), "curve.csv");
}

TEST(ToneCurve, NeedsNoScene) {
  EXPECT_NEAR(ToneCurve::of_gamma(2.0).encode(0.25), 0.5, 1e-15);
  EXPECT_EQ(ToneCurve::of_gamma(2.2).name(), "gamma 2.2");
  const ToneCurve measured = ToneCurve::of_table(kCurve, "folder/curve.csv"), of_scene(with_curve(kCurve));
  for (const double x : {0.0, 0.03, 0.3, 0.77, 1.0}) EXPECT_EQ(measured.encode(x), of_scene.encode(x));
  EXPECT_EQ(measured.name(), "curve.csv");
  const ToneCurve bent = ToneCurve::of_bent({1.3, 0.8});
  EXPECT_EQ(bent.name(), "sRGB^1.3 to 0.8");
  EXPECT_EQ(ToneCurve::of_bent({1.3, 1.3}).name(), "sRGB^1.3");
  EXPECT_NEAR(bent.encode(bent.decode(0.4)), 0.4, 1e-9);
}

TEST(ToneCurve, RefusesWhatHasNoInverse) {
  for (const char* text :
       {"linear,encoded\n0,0\n", "linear,encoded\n-0.1,0\n1,1\n", "linear,encoded\n0,0\n0.5,0.7\n1,0.7\n",
        "linear,encoded\n0,0\n0.9,1\n", "linear,encoded\n0,0\n1,1.5\n", "linear,wrong\n0,0\n1,1\n"}) {
    const std::string message =
        tests::expect_error(ErrorKind::unreadable_input, [&] { ToneCurve curve(with_curve(text)); });
    EXPECT_NE(message.find("curve.csv"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace vegard::sim::tone_curve_test
