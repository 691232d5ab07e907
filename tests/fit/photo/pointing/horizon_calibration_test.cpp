#include "fit/photo/pointing/horizon_calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/photo/picture_field_of_view.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/scene/structs/body.h"
#include "sim/view/camera/camera.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::horizon_calibration_test {
namespace {

using sim::kRadiansPerDegree;

sim::Camera camera_of(double elevation_deg, double roll_deg, double hfov_deg = 70.0,
                      double azimuth_deg = 33.0) {
  sim::Camera camera;
  camera.width = 3000, camera.height = 2000;
  camera.azimuth_deg = azimuth_deg, camera.elevation_deg = elevation_deg, camera.roll_deg = roll_deg;
  camera.hfov_deg = hfov_deg;
  return camera;
}

/// Where the camera sees the direction, by the simulator's own matrix; nothing behind it or beside the
/// picture.
std::optional<PixelPoint> seen(const sim::Camera& camera, double azimuth_deg, double elevation_deg) {
  const sim::CameraView<double> view = sim::camera_view(camera);
  const double az = azimuth_deg * kRadiansPerDegree, el = elevation_deg * kRadiansPerDegree;
  const double enu[3] = {std::sin(az) * std::cos(el), std::cos(az) * std::cos(el), std::sin(el)};
  double in_camera[3] = {0.0, 0.0, 0.0};
  for (int r = 0; r < 3; ++r)
    for (int i = 0; i < 3; ++i) in_camera[r] += view.camera_from_enu[r][i] * enu[i];
  if (in_camera[2] <= 0.0) return std::nullopt;
  const PixelPoint point{0.5 * camera.width + view.lens.focal_px * in_camera[0] / in_camera[2],
                         0.5 * camera.height + view.lens.focal_px * in_camera[1] / in_camera[2]};
  const bool inside =
      point.x_px >= 0.0 && point.x_px <= camera.width && point.y_px >= 0.0 && point.y_px <= camera.height;
  return inside ? std::optional<PixelPoint>(point) : std::nullopt;
}

/// `count` points of the horizon, evenly spread over what the picture shows of it.
HorizonProblem photographed(const sim::Camera& camera, double dip_deg, int count) {
  std::vector<PixelPoint> all;
  for (double azimuth = -180.0; azimuth < 180.0; azimuth += 0.25)
    if (const auto point = seen(camera, camera.azimuth_deg + azimuth, -dip_deg)) all.push_back(*point);
  HorizonProblem problem;
  problem.width_px = camera.width, problem.height_px = camera.height;
  problem.hfov_deg = camera.hfov_deg;
  problem.dip_deg = dip_deg;
  for (int i = 0; i < count && all.size() > 1; ++i)
    problem.points.push_back(all[i * (all.size() - 1) / (count - 1)]);
  return problem;
}

std::string refusal(const HorizonProblem& problem) {
  return tests::expect_error(sim::ErrorKind::usage, [&] { calibrate_horizon(problem); });
}

bool says(const std::string& text, const std::string& words) {
  if (text.find(words) != std::string::npos) return true;
  ADD_FAILURE() << "'" << text << "' does not say '" << words << "'";
  return false;
}

/// Normal numbers of seed `seed`.
double normal(std::uint64_t seed, std::uint32_t i, std::uint32_t j) {
  const sim::Words words = sim::philox4x32({i, j, 0, 0}, sim::random_key(seed));
  return sim::normal_quantile(sim::fine_uniform(words[0], words[1]));
}

TEST(HorizonDip, IsThatOfTheSphere) {
  EXPECT_EQ(horizon_dip_deg(0.0), 0.0);
  EXPECT_EQ(horizon_dip_deg(10.0, 20.0), 0.0);
  // The tangent's length over the radius.
  EXPECT_NEAR(std::tan(horizon_dip_deg(390.0) * kRadiansPerDegree),
              std::sqrt(390.0 * (2.0 * 6371.0 + 390.0)) / 6371.0, 1e-12);
  EXPECT_NEAR(horizon_dip_deg(0.3), std::sqrt(2.0 * 0.3 / 6371.0) / kRadiansPerDegree, 1e-4);
  for (const double layer : {0.0, 97.0, 250.0})
    EXPECT_NEAR(layer_of_dip_km(horizon_dip_deg(390.0, layer), 390.0), layer, 1e-9);
}

// Two points and the field of view give elevation and roll, for a straight horizon and a bent one, whichever
// way the camera looks.
TEST(HorizonCalibration, RecoversElevationAndRollFromTwoPoints) {
  for (const double dip : {0.0, 0.6, 19.5})
    for (const double elevation : {-25.0, -3.0, 0.0, 12.0})
      for (const double roll : {-35.0, 0.0, 4.0, 60.0}) {
        const sim::Camera camera = camera_of(elevation - dip, roll);
        const HorizonProblem problem = photographed(camera, dip, 2);
        ASSERT_EQ(problem.points.size(), 2u);
        const HorizonCalibration found = calibrate_horizon(problem);
        EXPECT_NEAR(found.elevation_deg.value, camera.elevation_deg, 1e-6);
        EXPECT_NEAR(found.roll_deg.value, roll, 1e-6);
        EXPECT_LT(found.rms_px, 1e-6);
        EXPECT_EQ(found.dip_deg.sigma, 0.0);
        EXPECT_EQ(found.hfov_deg.sigma, 0.0);
      }
}

TEST(HorizonCalibration, OrderOfThePointsDoesNotMatter) {
  HorizonProblem problem = photographed(camera_of(-10.0, 20.0), 19.5, 5);
  const HorizonCalibration one = calibrate_horizon(problem);
  std::reverse(problem.points.begin(), problem.points.end());
  const HorizonCalibration other = calibrate_horizon(problem);
  EXPECT_NEAR(one.elevation_deg.value, other.elevation_deg.value, 1e-9);
  EXPECT_NEAR(one.roll_deg.value, other.roll_deg.value, 1e-9);
}

// The sky below: a camera that stands on its head.
TEST(HorizonCalibration, KnowsTheSkyByAPointInIt) {
  const sim::Camera camera = camera_of(-15.0, 170.0);
  HorizonProblem problem = photographed(camera, 19.5, 3);
  says(refusal(problem), "bends the other way");
  says(refusal(problem), "--sky");
  problem.sky = seen(camera, camera.azimuth_deg, -5.0);
  ASSERT_TRUE(problem.sky);
  EXPECT_NEAR(calibrate_horizon(problem).elevation_deg.value, -15.0, 1e-6);
  EXPECT_NEAR(calibrate_horizon(problem).roll_deg.value, 170.0, 1e-6);
  problem.sky = seen(camera, camera.azimuth_deg, -30.0);
  ASSERT_TRUE(problem.sky);
  says(refusal(problem), "bends the other way");
  // Between the chord and the horizon: on the sky's side of two points, yet below.
  problem = photographed(camera_of(-19.5, 0.0), 19.5, 2);
  problem.sky = seen(camera_of(-19.5, 0.0), 33.0, -19.6);
  says(refusal(problem), "below the horizon");
}

// A bent horizon tells the field of view, or its own dip.
TEST(HorizonCalibration, RecoversTheFieldOfViewOrTheDipFromOrbit) {
  const sim::Camera camera = camera_of(-24.0, 7.0, 93.0);
  HorizonProblem problem = photographed(camera, 19.5, 7);
  problem.hfov_deg.reset();
  HorizonCalibration found = calibrate_horizon(problem);
  EXPECT_NEAR(found.hfov_deg.value, 93.0, 1e-5);
  EXPECT_NEAR(found.elevation_deg.value, -24.0, 1e-5);
  EXPECT_NEAR(found.roll_deg.value, 7.0, 1e-5);
  EXPECT_GT(found.hfov_deg.sigma, 0.0);
  problem.hfov_deg = 93.0;
  problem.free_dip = true;
  problem.dip_deg = 15.0;
  found = calibrate_horizon(problem);
  EXPECT_NEAR(found.dip_deg.value, 19.5, 1e-5);
  EXPECT_NEAR(found.elevation_deg.value, -24.0, 1e-5);
  EXPECT_GT(found.dip_deg.sigma, 0.0);
}

// 150 samples of points moved by 1.5 px (seed 11): the spread of what is found, over its error bar, is 1 to
// within 1 / sqrt(300) = 0.058; three of these are allowed.
TEST(HorizonCalibration, ErrorBarsAreTheSpreadOfASample) {
  const sim::Camera camera = camera_of(-24.0, 7.0, 93.0);
  const HorizonProblem exact = photographed(camera, 19.5, 7);
  for (const bool free_field : {false, true}) {
    HorizonProblem problem = exact;
    problem.point_error_px = 1.5;
    if (free_field) problem.hfov_deg.reset();
    const HorizonCalibration stated = calibrate_horizon(problem);
    ASSERT_EQ(stated.used_error_px, 1.5);
    constexpr int kSamples = 150;
    double squares[3] = {0.0, 0.0, 0.0};
    for (int sample = 0; sample < kSamples; ++sample) {
      for (std::size_t i = 0; i < problem.points.size(); ++i) {
        problem.points[i].x_px = exact.points[i].x_px;
        problem.points[i].y_px =
            exact.points[i].y_px + 1.5 * normal(11, sample, static_cast<std::uint32_t>(i));
        // Across the horizon, as the error is meant.
        const PixelPoint before = exact.points[i == 0 ? 0 : i - 1],
                         after = exact.points[i + 1 == exact.points.size() ? i : i + 1];
        const double dx = after.x_px - before.x_px, dy = after.y_px - before.y_px,
                     length = std::hypot(dx, dy);
        const double by = problem.points[i].y_px - exact.points[i].y_px;
        problem.points[i].x_px = std::min(std::max(exact.points[i].x_px - by * dy / length, 0.0), 3000.0);
        problem.points[i].y_px = exact.points[i].y_px + by * dx / length;
      }
      const HorizonCalibration found = calibrate_horizon(problem);
      squares[0] +=
          std::pow((found.elevation_deg.value - camera.elevation_deg) / stated.elevation_deg.sigma, 2);
      squares[1] += std::pow((found.roll_deg.value - camera.roll_deg) / stated.roll_deg.sigma, 2);
      if (free_field) squares[2] += std::pow((found.hfov_deg.value - 93.0) / stated.hfov_deg.sigma, 2);
    }
    for (int i = 0; i < (free_field ? 3 : 2); ++i)
      EXPECT_NEAR(std::sqrt(squares[i] / kSamples), 1.0, 3.0 / std::sqrt(2.0 * kSamples)) << i << free_field;
  }
}

// Points that scatter by more than was stated say so, and their scatter is taken.
TEST(HorizonCalibration, ScatterOfThePointsWidensTheErrorBars) {
  HorizonProblem problem = photographed(camera_of(5.0, 3.0), 0.0, 9);
  const HorizonCalibration exact = calibrate_horizon(problem);
  EXPECT_EQ(exact.used_error_px, 1.0);
  for (std::size_t i = 0; i < problem.points.size(); ++i) problem.points[i].y_px += i % 2 == 0 ? 8.0 : -8.0;
  const HorizonCalibration scattered = calibrate_horizon(problem);
  double squares = 0.0;
  for (const double residual : scattered.residual_px) squares += residual * residual;
  EXPECT_NEAR(scattered.used_error_px, std::sqrt(squares / 7.0), 1e-12);
  EXPECT_GT(scattered.used_error_px, 7.0);
  EXPECT_NEAR(scattered.elevation_deg.sigma / exact.elevation_deg.sigma, scattered.used_error_px, 0.05);
  // Above the horizon is positive, and rows count downwards.
  EXPECT_LT(scattered.residual_px[4], 0.0);
  EXPECT_GT(scattered.residual_px[3], 0.0);
}

TEST(HorizonCalibration, RefusesPointsThatTellNothing) {
  const HorizonProblem good = photographed(camera_of(5.0, 3.0), 0.0, 4);
  HorizonProblem bad = good;
  bad.points.resize(1);
  says(refusal(bad), "at least two points");
  bad.points = {good.points[1], good.points[1]};
  says(refusal(bad), "all one");
  bad = good;
  bad.points[0].x_px = -1.0;
  says(refusal(bad), "outside of the picture");
  bad = good;
  bad.points = {{1500.0, 100.0}, {1500.0, 1900.0}};
  says(refusal(bad), "is vertical");
  bad = good;
  bad.hfov_deg.reset();
  says(refusal(bad), "straight horizon says nothing");
  // Two points from orbit: not enough for the field of view.
  bad = photographed(camera_of(-20.0, 0.0), 19.5, 2);
  bad.hfov_deg.reset();
  says(refusal(bad), "2 points cannot determine the field of view");
  bad.hfov_deg = 70.0;
  bad.free_dip = true;
  says(refusal(bad), "2 points cannot determine the dip");
}

// Of a few hundredths of a degree of bending nothing is left above the error of a point.
TEST(HorizonCalibration, RefusesToTellAFieldOfViewFromALittleBending) {
  HorizonProblem problem = photographed(camera_of(-2.0, 0.0), 1.0, 4);
  problem.hfov_deg.reset();
  problem.point_error_px = 3.0;
  says(refusal(problem), "not bent enough");
}

// A skyline of hills that rise by 2 degrees more or less, independently at its ends: over 60 draws the
// deviations are as large as the error bars say. The mean of 60 squares of a normal deviation has a standard
// deviation of 0.18; three of those, and the roll's bar is for ends where the fit's line goes through all
// points.
TEST(HorizonCalibration, KnowsThatASkylineIsNoHorizon) {
  double elevation = 0.0, roll = 0.0;
  constexpr int kDraws = 60;
  for (std::uint32_t draw = 0; draw < kDraws; ++draw) {
    const sim::Camera camera = camera_of(10.0, 0.0);
    HorizonProblem problem = photographed(camera, 0.0, 9);
    const sim::Words words = sim::random_words(77, sim::Stream::stars, draw);
    const double focal_px = focal_of_hfov_px(camera.hfov_deg, camera.width);
    const double left_deg = kSkylineRelief_deg * sim::normal_quantile(sim::fine_uniform(words[0], words[1]));
    const double right_deg = kSkylineRelief_deg * sim::normal_quantile(sim::fine_uniform(words[2], words[3]));
    for (PixelPoint& point : problem.points) {
      const double share = point.x_px / camera.width;
      point.y_px -= focal_px * kRadiansPerDegree * (left_deg + share * (right_deg - left_deg));
    }
    const HorizonCalibration sharp = calibrate_horizon(problem);
    EXPECT_LT(sharp.elevation_deg.sigma, 0.1);
    problem.relief_deg = kSkylineRelief_deg;
    const HorizonCalibration found = calibrate_horizon(problem);
    EXPECT_EQ(found.elevation_deg.value, sharp.elevation_deg.value);
    EXPECT_GE(found.elevation_deg.sigma, kSkylineRelief_deg);
    elevation += std::pow((found.elevation_deg.value - 10.0) / found.elevation_deg.sigma, 2);
    roll += std::pow(found.roll_deg.value / found.roll_deg.sigma, 2);
  }
  // The mean of two independent ends has half of the variance; hills that are as high all along have all.
  EXPECT_GT(elevation / kDraws, 0.5 - 0.27);
  EXPECT_LT(elevation / kDraws, 1.0 + 0.54);
  EXPECT_NEAR(roll / kDraws, 1.0, 0.54 + 0.2);
}

}  // namespace
}  // namespace vegard::fit::horizon_calibration_test
