#include "sim/emit/sun/chromosphere_density.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::latitude_map_test {
namespace {

constexpr double kRadian = 3.14159265358979323846 / 180.0;

double texel_at(const LatitudeMap& map, double latitude_deg, double longitude_deg, double r = 3.0) {
  const double b = latitude_deg * kRadian, l = longitude_deg * kRadian;
  const double place[3] = {r * std::cos(b) * std::cos(l), r * std::cos(b) * std::sin(l), r * std::sin(b)};
  return map.at(place);
}

/// 8 by 4, a number each: 45° apart.
Image numbered() {
  Image picture(8, 4, {"Y"});
  for (std::size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = static_cast<float>(i * i % 13);
  return picture;
}

TEST(LatitudeMap, HasRowsFromTheNorthAndColumnsToTheWest) {
  const Image picture = numbered();
  const LatitudeMap map(picture);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_NEAR(texel_at(map, 67.5 - 45.0 * y, -157.5 + 45.0 * x), picture.at(x, y, 0), 1e-5);
  EXPECT_NEAR(texel_at(map, 67.5, -157.5, 99.0), picture.at(0, 0, 0), 1e-5) << "at any height";
}

TEST(LatitudeMap, IsLinearInBetweenAndRoundTheBack) {
  const Image picture = numbered();
  const LatitudeMap map(picture);
  EXPECT_NEAR(texel_at(map, 22.5, 45.0), 0.5 * (picture.at(4, 1, 0) + picture.at(5, 1, 0)), 1e-5);
  EXPECT_NEAR(texel_at(map, 0.0, 22.5), 0.5 * (picture.at(4, 1, 0) + picture.at(4, 2, 0)), 1e-5);
  const double back = 0.5 * (picture.at(7, 2, 0) + picture.at(0, 2, 0));
  EXPECT_NEAR(texel_at(map, -22.5, 180.0), back, 1e-5);
  EXPECT_NEAR(texel_at(map, -22.5, -180.0), back, 1e-5);
  EXPECT_NEAR(texel_at(map, -22.5, 179.9999), texel_at(map, -22.5, -179.9999), 1e-4);
}

TEST(LatitudeMap, HasItsFirstAndLastRowsValuesUpToThePoles) {
  const Image picture = numbered();
  const LatitudeMap map(picture);
  EXPECT_NEAR(texel_at(map, 89.0, 22.5), picture.at(4, 0, 0), 1e-5);
  EXPECT_NEAR(texel_at(map, -80.0, 22.5), picture.at(4, 3, 0), 1e-5);
  const double pole[3] = {0.0, 0.0, 2.0};
  EXPECT_EQ(map.at(pole), static_cast<double>(picture.at(0, 0, 0)));
}

}  // namespace
}  // namespace vegard::sim::latitude_map_test
