// Cameras of AIDA_tools.
#include "fit/photo/pointing/exchange/aida_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::aida_camera_test {
namespace {

constexpr const char* kLine =
    "  3 330 37 2456946.5 2457250.5 3 -1.0087953 1.0104560 -15.583283 33.403315 -9.1459435 -0.026772156 "
    "0.04297166 "
    "0.32419134 0\n";

std::array<double, 3> enu_of(double azimuth_deg, double zenith_deg) {
  const double azimuth = azimuth_deg * sim::kRadiansPerDegree, zenith = zenith_deg * sim::kRadiansPerDegree;
  return {std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth), std::cos(zenith)};
}

TEST(AidaCamera, ReadsFifteenNumbersALine) {
  const std::vector<AidaCamera> cameras =
      read_aida_cameras(std::string("\n% a remark\n") + kLine + kLine, "a.acc");
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].line, 3);
  EXPECT_EQ(cameras[1].line, 4);
  EXPECT_EQ(cameras[0].model, 3);
  EXPECT_EQ(cameras[0].station, 3.0);
  EXPECT_EQ(cameras[0].numbers[0], -1.0087953);
  EXPECT_EQ(cameras[0].numbers[7], 0.32419134);
  const std::vector<AidaCamera> again = read_aida_cameras(encode_aida(cameras[0]), "b.acc");
  EXPECT_EQ(again[0].numbers, cameras[0].numbers);
  EXPECT_EQ(again[0].until_jd, cameras[0].until_jd);
}

TEST(AidaCamera, RefusesWhatIsNone) {
  const auto refused = [](const std::string& text) {
    return tests::expect_error(sim::ErrorKind::unreadable_input, [&] { read_aida_cameras(text, "a.acc"); });
  };
  EXPECT_NE(refused("").find("no camera"), std::string::npos);
  EXPECT_NE(refused("1 2 3\n").find("a.acc:1"), std::string::npos);
  EXPECT_NE(refused("1 0 0 0 0 3 1 1 0 0 0 0 0 soon 0").find("soon"), std::string::npos);
  EXPECT_NE(refused("1 0 0 0 0 11 1 1 0 0 0 0 0 0.5 0").find("model 11"), std::string::npos);
  EXPECT_NE(refused("1 0 0 0 0 3.5 1 1 0 0 0 0 0 0.5 0").find("model 3.5"), std::string::npos);
  EXPECT_NE(refused("1 0 0 0 0 3 0 1 0 0 0 0 0 0.5 0").find("focal"), std::string::npos);
  EXPECT_NE(refused("1 0 0 0 0 2 1 1 0 0 0 0 0 0 0").find("model's"), std::string::npos);
  EXPECT_NE(refused("1 0 0 0 0 3 1 1 0 0 0 0 0 nan 0").find("nan"), std::string::npos);
}

// A camera to the zenith without turns, of the definition: e1 east, e2 north, e3 up.
TEST(AidaCamera, LooksUpWithoutTurns) {
  AidaCamera camera;
  for (const auto& [model, a] : {std::pair<int, double>{1, 0.0},
                                 {2, 0.5},
                                 {3, 0.35},
                                 {4, 1.0},
                                 {5, 0.5},
                                 {12, 0.4},
                                 {12, -0.4},
                                 {12, 0.0}}) {
    camera.model = model;
    camera.numbers = {0.8, -0.6, 0.0, 0.0, 0.0, 0.01, -0.02, a};
    constexpr double kZenith = 30.0 * sim::kRadiansPerDegree;
    const double radius = model == 1   ? std::tan(kZenith)
                          : model == 2 ? std::sin(a * kZenith)
                          : model == 3 ? a * kZenith + (1.0 - a) * std::tan(kZenith)
                          : model == 4 ? kZenith
                          : model == 5 ? std::tan(a * kZenith)
                          : a > 0.0    ? std::tan(a * kZenith) / a
                          : a < 0.0    ? std::sin(a * kZenith) / a
                                       : kZenith;
    double x = 0.0, y = 0.0;
    ASSERT_TRUE(aida_place(camera, 400, 300, enu_of(90.0, 30.0), x, y));  // in the east
    EXPECT_NEAR(x, 400.0 * (0.8 * radius + 0.51) - 0.5, 1e-9) << model;
    EXPECT_NEAR(y, 300.0 * 0.48 - 0.5, 1e-9) << model;
    ASSERT_TRUE(aida_place(camera, 400, 300, enu_of(0.0, 30.0), x, y));  // in the north
    EXPECT_NEAR(x, 400.0 * 0.51 - 0.5, 1e-9) << model;
    EXPECT_NEAR(y, 300.0 * (-0.6 * radius + 0.48) - 0.5, 1e-9) << model;
  }
}

// Places and directions, worked out by two ways of their own, belong together.
TEST(AidaCamera, SeesWhereItLooks) {
  AidaCamera camera = read_aida_cameras(kLine, "a.acc")[0];
  for (const auto& [model, a] :
       {std::pair<int, double>{1, 0.3}, {2, 0.6}, {3, 0.32}, {4, 0.9}, {5, 0.45}, {12, 0.5}, {12, -0.5}}) {
    camera.model = model;
    camera.numbers[7] = a;
    const sim::DirectionMap map = directions_of_aida(camera, 64, 48);
    int places = 0;
    for (int y = 0; y < 48; y += 5)
      for (int x = 0; x < 64; x += 5) {
        const std::size_t i = map.index(x, y);
        if (!std::isfinite(map.elevation_deg[i])) continue;
        double x_px = 0.0, y_px = 0.0;
        ASSERT_TRUE(
            aida_place(camera, 64, 48, enu_of(map.azimuth_deg[i], 90.0 - map.elevation_deg[i]), x_px, y_px));
        // Maps are floats: 3e-5 degrees, of which a pixel has one.
        EXPECT_NEAR(x_px, x + 0.5, 1e-3) << model;
        EXPECT_NEAR(y_px, y + 0.5, 1e-3) << model;
        ++places;
      }
    EXPECT_GT(places, 60) << model;
  }
}

// A camera of the scene's as AIDA has it: a pinhole and an equidistant fisheye are exact, and so is a
// mirrored one.
TEST(AidaCamera, TakesOverACameraOfOurs) {
  for (const auto lens : {sim::LensModel::pinhole, sim::LensModel::equidistant, sim::LensModel::equisolid,
                          sim::LensModel::stereographic})
    for (const bool mirrored : {false, true}) {
      if (mirrored && lens != sim::LensModel::equidistant)
        continue;  // a mirror is of the axes, whatever the lens
      sim::Camera camera;
      camera.model = lens;
      camera.mirrored = mirrored;
      camera.width = 300;
      camera.height = 200;
      camera.azimuth_deg = 332.0;
      camera.elevation_deg = 55.0;
      camera.roll_deg = 8.0;
      camera.focal_px = 150.0;
      camera.hfov_deg = 80.0;
      const AidaFit fit = aida_of_camera(camera, 2456946.5);
      EXPECT_LT(fit.rms_px, 1e-5) << static_cast<int>(lens) << mirrored;
      EXPECT_NEAR(fit.camera.azimuth_deg, 332.0, 1e-9);
      EXPECT_NEAR(fit.camera.zenith_deg, 35.0, 1e-9);
      const sim::DirectionMap map = directions_of_aida(fit.camera, 300, 200);
      const sim::Direction wanted = sim::direction_of_pixel(camera, 60.5, 150.5);
      EXPECT_NEAR(map.azimuth_deg[map.index(60, 150)], wanted.azimuth_deg, 1e-3);
      EXPECT_NEAR(map.elevation_deg[map.index(60, 150)], wanted.elevation_deg, 1e-3);
      // 2014-10-16 at 0 h: four months before is 2014-06-16, six after 2015-04-16.
      EXPECT_EQ(fit.camera.from_jd, 2456946.5 - 122.0);
      EXPECT_EQ(fit.camera.until_jd, 2456946.5 + 182.0);
    }
}

}  // namespace
}  // namespace vegard::fit::aida_camera_test
