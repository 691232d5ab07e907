// Bins by the distance from the Sun's middle and by position angle.
#include "fit/measure/profile_bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "sim/scene/structs/scene.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::limb_bins_test {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
const Region kAll{0, 0, 240, 200};

/// The Sun in the middle of a picture two degrees wide, its north 30 degrees anticlockwise of upwards.
sim::Scene scene_of_sun() {
  sim::Scene scene;
  scene.camera.width = kAll.width;
  scene.camera.height = kAll.height;
  scene.camera.hfov_deg = 2.0;
  scene.camera.azimuth_deg = 180.0;
  scene.camera.elevation_deg = 40.0;
  scene.sun.shown = true;
  scene.sun.azimuth_deg = 180.0;
  scene.sun.elevation_deg = 40.0;
  scene.sun.position_angle_deg = 30.0;
  scene.fit.profile_along = sim::ProfileAlong::limb;
  scene.fit.bands = 12;
  scene.fit.limb_lowest = 1.1;
  scene.fit.limb_highest = 2.3;
  scene.fit.limb_step = 0.1;
  return scene;
}

// The apparent radius is asin(R / D), and one radius further out a line of sight passes at the distance 2 R:
// plane trigonometry of a picture whose middle is the Sun's.
TEST(LimbBins, AreRingsAboutTheSunAndSectorsOfPositionAngle) {
  const sim::Scene scene = scene_of_sun();
  const BinGrid grid = profile_bins(scene, kAll);
  EXPECT_EQ(grid.groups, 12);
  EXPECT_EQ(grid.positions, 12);
  const double focal_px = 120.0 / std::tan(kDegree), distance = scene.sun.distance_km / 695700.0;
  std::map<std::pair<int, int>, std::size_t> of;
  for (std::size_t b = 0; b < grid.bins(); ++b)
    for (std::size_t r = grid.first_run[b]; r < grid.first_run[b + 1]; ++r)
      for (int x = grid.runs[r].begin; x < grid.runs[r].end; ++x) of[{x, grid.runs[r].y}] = b;
  int inside = 0;
  for (int y = 0; y < kAll.height; ++y)
    for (int x = 0; x < kAll.width; ++x) {
      const double right = x + 0.5 - 120.0, up = 100.0 - y - 0.5;
      const double radii = distance * std::sin(std::atan(std::hypot(right, up) / focal_px));
      const auto found = of.find({x, y});
      if (radii < 1.1 - 1e-9 || radii > 2.3 + 1e-9) {
        EXPECT_EQ(found, of.end());
        continue;
      }
      ++inside;
      ASSERT_NE(found, of.end()) << x << ", " << y;
      EXPECT_EQ(found->second % grid.positions, static_cast<std::size_t>((radii - 1.1) / 0.1));
      // From the pole, 30 degrees anticlockwise of upwards, on anticlockwise.
      const double angle = std::fmod(std::atan2(-right, up) / kDegree - 30.0 + 720.0, 360.0);
      const double sector = angle / 30.0;
      if (std::abs(sector - std::round(sector)) > 1e-6) {
        EXPECT_EQ(found->second / grid.positions, static_cast<std::size_t>(sector));
      }
    }
  EXPECT_GT(inside, 10000);
  // A step of a tenth of the radius of 0.2666 degrees.
  EXPECT_NEAR(grid.position_px, 0.1 * 0.26657 * kDegree * focal_px, 0.01);
}

TEST(LimbBins, SayWhatIsWrong) {
  const auto refused = [&](const char* key, auto change) {
    sim::Scene scene = scene_of_sun();
    change(scene);
    const std::string text = tests::expect_error(sim::ErrorKind::scene, [&] { limb_bins(scene, kAll); });
    EXPECT_NE(text.find(key), std::string::npos) << text;
  };
  refused("sun.shown", [](sim::Scene& s) { s.sun.shown = false; });
  refused("fit.limb_lowest", [](sim::Scene& s) { s.fit.limb_lowest = 2.3; });
  refused("fit.limb_step", [](sim::Scene& s) { s.fit.limb_step = 1.0; });
  refused("sun.azimuth_deg", [](sim::Scene& s) { s.sun.azimuth_deg = 10.0; });
  refused("sun.azimuth_deg", [](sim::Scene& s) { s.sun.azimuth_deg = 0.0, s.sun.elevation_deg = -40.0; });
}

}  // namespace
}  // namespace vegard::fit::limb_bins_test
