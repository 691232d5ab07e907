// Bins along a loop drawn by hand, and across it.
#include "fit/measure/profile_bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "fit/measure/guide_curve.h"
#include "sim/scene/structs/scene.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::loop_bins_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

sim::Scene scene_of(const std::vector<double>& x, const std::vector<double>& y, int bands) {
  sim::Scene scene;
  scene.camera.width = 200;
  scene.camera.height = 160;
  scene.fit.profile_along = sim::ProfileAlong::loop;
  scene.fit.bands = bands;
  scene.fit.guide_x_px = x;
  scene.fit.guide_y_px = y;
  scene.fit.guide_half_width_px = 10.0;
  scene.fit.guide_cell_px = 2.0;
  return scene;
}

const Region kAll{0, 0, 200, 160};

/// Bin of every pixel that is in one.
std::map<std::pair<int, int>, int> bin_of_pixels(const BinGrid& grid) {
  std::map<std::pair<int, int>, int> of;
  for (std::size_t b = 0; b < grid.bins(); ++b)
    for (std::size_t r = grid.first_run[b]; r < grid.first_run[b + 1]; ++r)
      for (int x = grid.runs[r].begin; x < grid.runs[r].end; ++x)
        EXPECT_TRUE(of.insert({{x, grid.runs[r].y}, static_cast<int>(b)}).second) << "in two bins";
  return of;
}

// A straight guide: distances along and across are coordinates turned by its angle.
TEST(LoopBins, OfAStraightGuideAreTurnedCoordinates) {
  const double angle = 0.4, c = std::cos(angle), s = std::sin(angle);
  std::vector<double> x, y;
  for (const double t : {0.0, 30.0, 75.0, 120.0}) {
    x.push_back(40.0 + t * c);
    y.push_back(50.0 + t * s);
  }
  const BinGrid grid = profile_bins(scene_of(x, y, 6), kAll);
  EXPECT_EQ(grid.groups, 6);
  EXPECT_EQ(grid.positions, 10);
  EXPECT_NEAR(grid.across.step, 20.0, 1e-9);
  const auto of = bin_of_pixels(grid);
  int inside = 0;
  for (int py = 0; py < kAll.height; ++py)
    for (int px = 0; px < kAll.width; ++px) {
      const double dx = px + 0.5 - 40.0, dy = py + 0.5 - 50.0;
      const double along = dx * c + dy * s, across = dy * c - dx * s;  // rows count downwards
      const auto found = of.find({px, py});
      if (along < -1e-6 || along > 120.0 + 1e-6 || std::abs(across) > 10.0 + 1e-6) {
        EXPECT_EQ(found, of.end()) << px << ", " << py;
        continue;
      }
      ++inside;
      ASSERT_NE(found, of.end()) << px << ", " << py;
      EXPECT_EQ(found->second / grid.positions, static_cast<int>(along / 20.0));
      EXPECT_EQ(found->second % grid.positions, static_cast<int>((across + 10.0) / 2.0));
    }
  EXPECT_NEAR(inside, 120 * 20, 100) << "about as many pixels as the strip has area";
}

// Ten points on a half circle: the spline through them leaves it by a hundredth of a pixel or less, inside of
// the ends, where a natural spline has no curvature.
TEST(LoopBins, OfAHalfCircleGoByTheRadius) {
  std::vector<double> x, y;
  for (int i = 0; i <= 10; ++i) {
    x.push_back(100.0 - 60.0 * std::cos(kPi * i / 10.0));
    y.push_back(120.0 - 60.0 * std::sin(kPi * i / 10.0));
  }
  const GuideCurve curve(x, y);
  EXPECT_NEAR(curve.length_px(), 60.0 * kPi, 0.3);
  const BinGrid grid = loop_bins(scene_of(x, y, 8), kAll);
  for (const auto& [pixel, bin] : bin_of_pixels(grid)) {
    const double radius = std::hypot(pixel.first + 0.5 - 100.0, pixel.second + 0.5 - 120.0);
    const double angle = std::atan2(120.0 - pixel.second - 0.5, 100.0 - pixel.first - 0.5) / kPi;
    if (angle < 0.12 || angle > 0.88) continue;
    // From the left foot over the top to the right one: the middle of the circle is on the right.
    const double across = grid.along.edge(bin % grid.positions);
    EXPECT_GE(60.0 - radius, across - 0.05);
    EXPECT_LE(60.0 - radius, across + 2.0 + 0.05);
    EXPECT_NEAR(bin / grid.positions + 0.5, 8.0 * angle, 0.52);
  }
}

TEST(LoopBins, SayWhatIsWrongWithTheGuide) {
  const std::vector<double> x = {20, 60, 100}, y = {20, 60, 90};
  const auto refused = [&](sim::Scene scene, const std::string& key) {
    const std::string text = tests::expect_error(sim::ErrorKind::scene, [&] { loop_bins(scene, kAll); });
    EXPECT_NE(text.find(key), std::string::npos) << text;
  };
  refused(scene_of({20, 60}, {20, 60}, 4), "fit.guide_x_px");
  refused(scene_of(x, {20, 60}, 4), "fit.guide_y_px");
  refused(scene_of({20, 60, 201}, y, 4), "fit.guide_x_px");
  refused(scene_of(x, {20, 60, 161}, 4), "fit.guide_y_px");
  refused(scene_of({20, 20, 100}, {20, 20, 90}, 4), "fit.guide_x_px");
  refused(scene_of(x, y, 500), "fit.bands");
  sim::Scene narrow = scene_of(x, y, 4);
  narrow.fit.guide_cell_px = 10.0;
  refused(narrow, "fit.guide_half_width_px");
  const std::string text = tests::expect_error(sim::ErrorKind::scene, [&] {
    loop_bins(scene_of(x, y, 4), {150, 0, 50, 50});
  });
  EXPECT_NE(text.find("fit.roi_px"), std::string::npos) << text;
}

}  // namespace
}  // namespace vegard::fit::loop_bins_test
