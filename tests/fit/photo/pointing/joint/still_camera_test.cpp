#include "fit/photo/pointing/joint/still_camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "tests/support/expect_error.h"
#include "tests/support/star_field.h"

namespace vegard::tests::still_camera_test {
namespace {

constexpr double kLatitude_deg = 69.0;

sim::Camera camera_to(double azimuth_deg, double elevation_deg) {
  sim::Camera camera;
  camera.model = sim::LensModel::pinhole;
  camera.width = 600;
  camera.height = 400;
  camera.hfov_deg = 70.0;
  camera.azimuth_deg = azimuth_deg;
  camera.elevation_deg = elevation_deg;
  return camera;
}

/// Numbers of one stream.
struct Numbers {
  std::uint64_t seed;
  mutable std::uint32_t next = 0;

  double normal() const { return tests::normal(seed, next++, 0); }
  double uniform() const { return sim::uniform(sim::random_words(seed, sim::Stream::stars, next++)[0]); }
};

/// What the frames of a made sky have beside its stars.
struct Frames {
  std::uint64_t seed = 1;
  int stars = 1500;  ///< in the whole sky: some 60 in the picture
  int others = 15;   ///< points at random in each frame
  int lamps = 0;     ///< at the same pixels of all frames
  double brightness = 1.0;
};

/// A frame of this sky as the camera sees it after `time_s`: two thirds of the stars, each 0.3 px off.
fit::FramePoints frame(const sim::Camera& camera, double time_s, const Frames& made, std::uint64_t number) {
  const Numbers sky{made.seed}, noise{1000 * made.seed + number}, lamps{77 * made.seed};
  const double latitude = kLatitude_deg * sim::kRadiansPerDegree;
  const Eigen::AngleAxisd turn(-2.0 * sim::kPi * 1.00273791 * time_s / 86400.0,
                               Eigen::Vector3d(0.0, std::cos(latitude), std::sin(latitude)));
  const sim::CameraView<double> view = sim::camera_view(camera);
  fit::FramePoints points{"frame " + std::to_string(number), time_s, {}};
  for (int i = 0; i < made.stars; ++i) {
    const double east = sky.normal(), north = sky.normal(), up = sky.normal();
    const Eigen::Vector3d star = turn * Eigen::Vector3d(east, north, up).normalized();
    const double flux = made.brightness * std::exp(sky.normal()), enu[3] = {star.x(), star.y(), star.z()};
    double x = 0.0, y = 0.0;
    const bool kept = noise.uniform() < 2.0 / 3.0;
    const double dx = 0.3 * noise.normal(), dy = 0.3 * noise.normal(), scatter = 0.1 * noise.normal();
    if (!kept || !sim::pixel_of_enu(view, enu, x, y) || x < 0.0 || y < 0.0 || x > 600.0 || y > 400.0)
      continue;
    points.points.push_back({x + dx, y + dy, 0.3, flux * (1.0 + scatter), 10.0});
  }
  const auto add = [&](const Numbers& places, int count, double brightness) {
    for (int i = 0; i < count; ++i) {
      const double x = 600.0 * places.uniform(), y = 400.0 * places.uniform();
      points.points.push_back({x, y, 0.3, brightness, 10.0});
    }
  };
  add(noise, made.others, 1.0);
  add(lamps, made.lamps, 5.0);
  std::sort(points.points.begin(), points.points.end(),
            [](const fit::FoundStar& a, const fit::FoundStar& b) { return a.flux > b.flux; });
  return points;
}

fit::StarsOfTwoFrames said(const sim::Camera& first, const sim::Camera& second, double seconds,
                           const Frames& made) {
  return fit::stars_of_two_frames(first, kLatitude_deg, frame(first, 0.0, made, 1),
                                  frame(second, seconds, made, 2));
}

// Seeds 1 to 10. Both frames have (2/3)^2 of the stars, so that some 27 of 60 agree.
TEST(StillCamera, StoodStill) {
  const sim::Camera camera = camera_to(120.0, 40.0);
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const double seconds : {1.0, 60.0, 600.0}) {
      Frames made;
      made.seed = seed;
      const fit::StarsOfTwoFrames two = said(camera, camera, seconds, made);
      EXPECT_TRUE(two.stood_still) << seed << " " << seconds;
      EXPECT_FALSE(two.move) << seed << " " << seconds;
      EXPECT_NEAR(two.brightness, 1.0, 5.0 * two.brightness_error);
    }
}

// Seeds 1 to 10. With n = 20 and more stars of 0.3 px at 8.6 px a degree a turn's error is below 0.02
// degrees.
TEST(StillCamera, WasMoved) {
  const sim::Camera camera = camera_to(120.0, 40.0);
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const double angle_deg : {0.5, 3.0, 12.0}) {
      Frames made;
      made.seed = seed;
      const fit::StarsOfTwoFrames two = said(camera, camera_to(120.0, 40.0 + angle_deg), 20.0, made);
      ASSERT_TRUE(two.move) << seed << " " << angle_deg;
      EXPECT_NEAR(two.move->angle_deg, angle_deg, 0.1);
      EXPECT_GE(two.move->stars, 12);
    }
}

// Seeds 1 to 20: another sky, as in a film that was cut, or points of cloud and trees. Nothing is said.
TEST(StillCamera, SaysNothingOfPointsByChance) {
  const sim::Camera camera = camera_to(120.0, 40.0);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Frames made;
    made.seed = seed;
    made.stars = 0;
    made.others = 60;
    const fit::StarsOfTwoFrames two = said(camera, camera, 20.0, made);
    EXPECT_FALSE(two.stood_still) << seed;
    EXPECT_FALSE(two.move) << seed;
  }
}

// Lamps stay at their pixels, and stars do not: after 20 s by 0.7 px, after 50 s by 1.8, after 600 s by 21.
TEST(StillCamera, IsNotJudgedByLamps) {
  const sim::Camera camera = camera_to(120.0, 40.0), moved = camera_to(122.0, 40.0);
  for (const double seconds : {2.0, 20.0, 50.0, 100.0, 600.0}) {
    Frames made;
    made.lamps = 12;
    EXPECT_TRUE(said(camera, camera, seconds, made).stood_still) << seconds;
    EXPECT_TRUE(said(camera, moved, seconds, made).move) << seconds;
    made.lamps = 40;
    made.stars = 0;
    EXPECT_FALSE(said(camera, camera, seconds, made).move) << seconds;
  }
  Frames made;
  made.lamps = 40;
  made.stars = 0;
  EXPECT_FALSE(said(camera, camera, 600.0, made).stood_still);
}

/// What a watch says of the frames `number` of one camera, and from frame `move_at` on of another.
fit::CameraWatch watched(int number, double step_s, const Frames& made, int move_at,
                         const sim::Camera& moved) {
  const sim::Camera camera = camera_to(10.0, 50.0);
  fit::CameraWatch watch(camera, kLatitude_deg);
  for (int i = 0; i < number; ++i)
    watch.add(frame(i < move_at ? camera : moved, step_s * i, made, static_cast<std::uint64_t>(i)));
  return watch;
}

TEST(StillCamera, IsWatchedThroughItsFrames) {
  const sim::Camera camera = camera_to(10.0, 50.0), turned = camera_to(11.5, 50.0);
  fit::CameraWatch watch(camera, kLatitude_deg);
  Frames made, none;
  none.stars = none.others = 0;
  for (std::uint64_t i = 0; i < 6; ++i)
    watch.add(frame(camera, 30.0 * static_cast<double>(i), i == 3 ? none : made, i));
  EXPECT_EQ(watch.frames(), 6);
  EXPECT_EQ(watch.told(), 4);
  ASSERT_EQ(watch.words().size(), 1u);
  EXPECT_TRUE(has_facts(watch.words()[0], "5 of the 6 frames | not known"));
  made.brightness = 0.5;
  for (std::uint64_t i = 6; i < 9; ++i) watch.add(frame(camera, 30.0 * static_cast<double>(i), made, i));
  ASSERT_EQ(watch.other_brightness().size(), 1u);  // one change
  EXPECT_EQ(watch.other_brightness()[0].name, "frame 6");
  EXPECT_NEAR(watch.other_brightness()[0].brightness, 0.5, 0.05);
  watch.add(frame(turned, 270.0, made, 9));
  EXPECT_EQ(watch.words().size(), 3u);  // perhaps
  const std::string words =
      expect_error(sim::ErrorKind::unreadable_input, [&] { watch.add(frame(turned, 300.0, made, 10)); });
  EXPECT_TRUE(has_facts(words, "frame 9: | was turned by 1. | after frame 8"));
}

TEST(StillCamera, IsFoundOutAfterACloudyFrame) {
  const sim::Camera camera = camera_to(10.0, 50.0), turned = camera_to(20.0, 50.0);
  fit::CameraWatch watch(camera, kLatitude_deg);
  Frames made, cloud;
  cloud.stars = 0;
  cloud.others = 20;
  for (std::uint64_t i = 0; i < 5; ++i)
    watch.add(frame(camera, 10.0 * static_cast<double>(i), i == 0 ? cloud : made, i));
  EXPECT_EQ(watch.told(), 3);
  watch.add(frame(turned, 50.0, made, 5));
  expect_error(sim::ErrorKind::unreadable_input, [&] { watch.add(frame(turned, 60.0, made, 6)); });
}

// Points of a cloud that drift as a whole, by 1 px/s: they move on, as no camera does that was moved once.
TEST(StillCamera, IsNotJudgedByClouds) {
  const sim::Camera camera = camera_to(10.0, 50.0);
  fit::CameraWatch watch(camera, kLatitude_deg);
  Frames made;
  made.stars = 0;
  made.others = 10;
  made.lamps = 40;
  for (std::uint64_t i = 0; i < 8; ++i) {
    fit::FramePoints points = frame(camera, 10.0 * static_cast<double>(i), made, i);
    for (fit::FoundStar& point : points.points) point.x_px += 10.0 * static_cast<double>(i);
    EXPECT_NO_THROW(watch.add(points)) << i;
  }
}

// Times that are half of the true ones, as with a wrong --step, and a wrong site: told, and not refused.
TEST(StillCamera, MayHaveStoodStillWhereTimesAreWrong) {
  const sim::Camera camera = camera_to(100.0, 45.0);
  fit::CameraWatch late(camera, kLatitude_deg), elsewhere(camera, kLatitude_deg - 90.0);
  const Frames made;
  for (std::uint64_t i = 0; i < 4; ++i) {
    fit::FramePoints points = frame(camera, 300.0 * static_cast<double>(i), made, i);
    elsewhere.add(points);
    points.time_s = 150.0 * static_cast<double>(i);
    late.add(points);
  }
  ASSERT_TRUE(late.drift());
  ASSERT_TRUE(elsewhere.drift());
  EXPECT_NEAR(late.drift()->angle_deg, 0.63, 0.1);  // what the sky turned by in the 150 s that are missing
}

TEST(StillCamera, IsNotKnownOfFramesFarApart) {
  const fit::CameraWatch watch = watched(4, 700.0, Frames(), 2, camera_to(20.0, 50.0));
  EXPECT_EQ(watch.told(), 0);
  ASSERT_EQ(watch.words().size(), 1u);
  EXPECT_TRUE(has_facts(watch.words()[0], "not known | ten minutes"));
}

}  // namespace
}  // namespace vegard::tests::still_camera_test
