#include "sim/view/film/depth_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vegard::sim::depth_image_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Image values(int width, int height, const std::vector<float>& of) {
  Image image(width, height, {"Z"});
  image.data = of;
  return image;
}

TEST(DepthImage, OfDistancesStopsRaysThere) {
  March march;
  march.depth_gain = 2.5;
  const DepthImage depth = depth_image(march, values(2, 1, {4.0f, 8.0f}));
  EXPECT_EQ(depth.end_km(0.5, 0.5, 0.3), 10.0);
  EXPECT_EQ(depth.end_km(1.5, 0.5, -0.3), 20.0) << "a distance needs no axis";
}

TEST(DepthImage, IsThatOfTheNearestPixelAndOfTheEdgeBeyondIt) {
  const DepthImage depth = depth_image(March(), values(2, 2, {1.0f, 2.0f, 3.0f, 4.0f}));
  EXPECT_EQ(depth.end_km(0.99, 0.99, 1.0), 1.0);
  EXPECT_EQ(depth.end_km(1.01, 0.99, 1.0), 2.0) << "no mean of a near and a far thing";
  EXPECT_EQ(depth.end_km(-1e12, 1.5, 1.0), 3.0);
  EXPECT_EQ(depth.end_km(1e12, 1e12, 1.0), 4.0);
}

TEST(DepthImage, AlongTheAxisIsLongerAlongTheRay) {
  March march;
  march.depth_is = DepthMeaning::forward;
  march.depth_gain = 10.0;
  const DepthImage depth = depth_image(march, values(1, 1, {3.0f}));
  // The ray (x, y, 1) whose forward component is 1 has the length 1 / cosine.
  const double length = std::sqrt(0.4 * 0.4 + 0.7 * 0.7 + 1.0);
  EXPECT_NEAR(depth.end_km(0.5, 0.5, 1.0 / length), 30.0 * length, 1e-12 * 30.0);
  EXPECT_EQ(depth.end_km(0.5, 0.5, -0.1), kInfinity) << "it says nothing of what is behind the camera";
}

TEST(DepthImage, UndoesTheLogarithmOfADepthBuffer) {
  March march;
  march.depth_is = DepthMeaning::log;
  march.depth_gain = 0.5;
  march.depth_far_km = 1e5;
  const double c = 1.0 / march.depth_gain;
  std::vector<float> coded;
  const std::vector<double> depths_km = {0.0, 1.0, 300.0, 9e4};
  for (const double w : depths_km)
    coded.push_back(static_cast<float>(std::log(c * w + 1.0) / std::log(c * march.depth_far_km + 1.0)));
  const DepthImage depth = depth_image(march, values(4, 1, coded));
  for (int x = 0; x < 4; ++x)
    // A float of about 1 in the exponent ln(2e5) = 12.2: 12.2 x 6e-8 of the depth, and 0.5 km of it near 0.
    EXPECT_NEAR(depth.end_km(x + 0.5, 0.5, 1.0), depths_km[x], 1e-6 * (depths_km[x] + 0.5));
  EXPECT_NEAR(depth.end_km(2.5, 0.5, 0.8), 300.0 / 0.8, 1e-3) << "along the axis, too";
}

TEST(DepthImage, OfAClearedBufferIsNothing) {
  March march;
  march.depth_is = DepthMeaning::log;
  EXPECT_EQ(depth_image(march, values(1, 1, {1.0f})).end_km(0.5, 0.5, 0.9), kInfinity);
  EXPECT_EQ(DepthImage().end_km(0.5, 0.5, 0.9), kInfinity) << "no picture at all";
}

}  // namespace
}  // namespace vegard::sim::depth_image_test
