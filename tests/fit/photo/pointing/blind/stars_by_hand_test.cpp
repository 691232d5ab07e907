#include "fit/photo/pointing/blind/stars_by_hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"

namespace vegard::fit::stars_by_hand_test {
namespace {

constexpr double kJulianDate = 2456710.3;
const sim::Observer kObserver{67.0, 20.0, 0.0, true};
const Frame kFrame{900, 600, true};

SkyOfPicture sky() {
  SkyOfPicture sky;
  sky.julian_date = kJulianDate;
  sky.observer = kObserver;
  return sky;
}

SkyCamera true_camera(bool mirrored) {
  SkyCamera camera;
  camera.model = sim::LensModel::stereographic;
  camera.mirrored = mirrored;
  camera.camera_from_enu = rotation_of(200.0, 50.0, 12.0);
  camera.numbers[focal_px_number] = 420.0;
  camera.numbers[centre_x_number] = 450.0;
  camera.numbers[centre_y_number] = 300.0;
  return camera;
}

/// The brightest stars in the picture, that are at least 150 px apart.
std::vector<StarSighting> marked(const SkyCamera& camera, std::size_t count) {
  std::vector<StarSighting> found;
  for (StarSighting star : catalogue_sky(kObserver, kJulianDate, 4.0)) {
    if (found.size() == count || !place_of_star(camera, star.enu, star.x_px, star.y_px)) continue;
    if (star.x_px < 0.0 || star.x_px > 900.0 || star.y_px < 0.0 || star.y_px > 600.0) continue;
    if (std::all_of(found.begin(), found.end(), [&](const StarSighting& other) {
          return std::hypot(star.x_px - other.x_px, star.y_px - other.y_px) > 150.0;
        }))
      found.push_back(star);
  }
  return found;
}

double degrees_apart(const SkyCamera& a, const SkyCamera& b) {
  const double trace = (a.camera_from_enu * b.camera_from_enu.transpose()).trace();
  return std::acos(std::clamp(0.5 * (trace - 1.0), -1.0, 1.0)) / sim::kRadiansPerDegree;
}

TEST(StarsByHand, TwoOfThemAreACameraForEachLens) {
  for (const bool mirrored : {false, true}) {
    const SkyCamera truth = true_camera(mirrored);
    const std::vector<StarSighting> two = marked(truth, 2);
    ASSERT_EQ(two.size(), 2u);
    const std::vector<SkyCamera> cameras = cameras_by_hand(two, kFrame, {});
    ASSERT_GE(cameras.size(), 4u);
    int right = 0;
    for (const SkyCamera& camera : cameras) {
      if (camera.model != truth.model || camera.mirrored != mirrored) continue;
      ++right;
      EXPECT_LT(degrees_apart(camera, truth), 0.01);
      EXPECT_NEAR(camera.numbers[focal_px_number], 420.0, 0.05);
    }
    EXPECT_EQ(right, 1);
  }
}

TEST(StarsByHand, FourTellTheLensAndTheSide) {
  for (const bool mirrored : {false, true}) {
    const SkyCamera truth = true_camera(mirrored);
    const std::vector<SkyCamera> cameras = cameras_by_hand(marked(truth, 4), kFrame, {});
    ASSERT_FALSE(cameras.empty());
    EXPECT_EQ(cameras.front().model, truth.model);
    EXPECT_EQ(cameras.front().mirrored, mirrored);
    EXPECT_LT(degrees_apart(cameras.front(), truth), 0.01);
  }
}

TEST(StarsByHand, OfAKnownLensTellTheRotation) {
  const SkyCamera truth = true_camera(false);
  SkyCamera known = truth;
  known.camera_from_enu = rotation_of(0.0, 90.0, 0.0);
  const std::vector<SkyCamera> cameras = cameras_by_hand(marked(truth, 2), kFrame, known);
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_LT(degrees_apart(cameras[0], truth), 1e-4);
  EXPECT_EQ(cameras[0].numbers, known.numbers);
}

TEST(StarsByHand, ThatAreMistakenAreNoCamera) {
  std::vector<StarSighting> four = marked(true_camera(false), 4);
  std::swap(four[0].enu, four[1].enu);
  std::swap(four[2].enu, four[0].enu);
  EXPECT_TRUE(cameras_by_hand(four, kFrame, {}).empty());
}

TEST(StarsByHand, AreRead) {
  const std::vector<StarSighting> stars = stars_by_hand({"Vega=812,344.5", "alf Cyg=10,20"}, sky(), "--star");
  ASSERT_EQ(stars.size(), 2u);
  EXPECT_EQ(stars[0].x_px, 812.0);
  EXPECT_EQ(stars[0].y_px, 344.5);
  for (const std::vector<std::string>& bad :
       std::vector<std::vector<std::string>>{{"Vega=1,2"},
                                             {"Vega=1,2", "Deneb"},
                                             {"Vega=1,2", "Deneb=3"},
                                             {"Vega=1,2", "=3,4"},
                                             {"Vega=1,2", "alf Lyr=30,4"},
                                             {"Vega=1,2", "Deneb=1,2"}}) {
    try {
      stars_by_hand(bad, sky(), "--star");
      FAIL() << bad.back();
    } catch (const sim::Error& error) {
      EXPECT_EQ(error.kind(), sim::ErrorKind::usage) << error.what();
    }
  }
  try {
    stars_by_hand({"Vega=1,2", "Denebb=3,4"}, sky(), "--star");
    FAIL();
  } catch (const sim::Error& error) {
    EXPECT_NE(std::string(error.what()).find("Deneb'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vegard::fit::stars_by_hand_test
