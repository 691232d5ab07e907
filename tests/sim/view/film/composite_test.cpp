#include "sim/view/film/composite.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/view/sensor/tone_curve.h"

namespace vegard::sim::composite_test {
namespace {

Image filled_with(int width, int height, const std::vector<float>& pixel, std::vector<std::string> names) {
  Image image(width, height, std::move(names));
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = pixel[i % pixel.size()];
  return image;
}

double sum_of(const Image& image, int channel) {
  double sum = 0.0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y, channel);
  return sum;
}

TEST(Composite, IntegersAreDecodedBeforeAlphaIsApplied) {
  PictureFile file;
  file.image = filled_with(1, 1, {0.5f, 0.25f, 1.0f, 0.4f}, {"R", "G", "B", "A"});
  const Image linear = linear_picture(file);
  EXPECT_NEAR(linear.at(0, 0, 0), 0.4 * srgb_decode(0.5), 1e-6);
  EXPECT_NEAR(linear.at(0, 0, 2), 0.4, 1e-6);
  EXPECT_FLOAT_EQ(linear.at(0, 0, 3), 0.4f);
  // The same picture from a file that has colour times alpha.
  file.image = filled_with(1, 1, {0.2f, 0.1f, 0.4f, 0.4f}, {"R", "G", "B", "A"});
  file.colour_times_alpha = true;
  const Image same = linear_picture(file);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(same.at(0, 0, c), linear.at(0, 0, c), 1e-6);
}

TEST(Composite, FloatsAreLinearAndGreyIsGrey) {
  PictureFile file;
  file.floating = true;
  file.image = filled_with(1, 1, {7.5f}, {"Y"});
  const Image linear = linear_picture(file);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(linear.at(0, 0, c), 7.5f);
  EXPECT_EQ(linear.at(0, 0, 3), 1.0f);
}

TEST(Composite, AMaskIsAreaAndNotLight) {
  PictureFile file;
  file.image = filled_with(1, 1, {0.5f, 0.5f, 0.5f, 0.5f}, {"R", "G", "B", "A"});
  EXPECT_FLOAT_EQ(coverage_of(file).at(0, 0, 0), 0.25f) << "neither decoded nor without its alpha";
}

TEST(Composite, ShrinkingKeepsTheMeanLight) {
  Image picture(12, 8, {"Y"});
  for (std::size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = static_cast<float>(i * i % 37);
  const double mean = sum_of(picture, 0) / 96.0;
  for (const auto& [width, height] : {std::pair{6, 4}, {3, 2}, {9, 6}, {5, 3}}) {
    const Image small = fill_frame(picture, width, height);
    if (width * 8 != height * 12) continue;  // a part is cut off
    EXPECT_NEAR(sum_of(small, 0) / (width * height), mean, 1e-4) << width;
  }
  const Image half = fill_frame(picture, 6, 4);
  EXPECT_FLOAT_EQ(half.at(1, 1, 0), 0.25f * (picture.at(2, 2, 0) + picture.at(3, 2, 0) + picture.at(2, 3, 0) +
                                             picture.at(3, 3, 0)));
}

TEST(Composite, EnlargingKeepsAStraightSlopeStraight) {
  Image picture(4, 4, {"Y"});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      picture.at(x, y, 0) = static_cast<float>(x + 0.5) + 10.0f * static_cast<float>(y + 0.5);
  const Image large = fill_frame(picture, 12, 12);
  for (int y = 2; y < 10; ++y)
    for (int x = 2; x < 10; ++x)
      EXPECT_NEAR(large.at(x, y, 0), (x + 0.5) / 3.0 + 10.0 * (y + 0.5) / 3.0, 1e-5);
}

TEST(Composite, TheFrameIsCoveredAndTheRestCutOffEvenly) {
  // Columns 0 … 11 of a wide picture; a square frame keeps 4 … 7.
  Image picture(12, 4, {"Y"});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 12; ++x) picture.at(x, y, 0) = static_cast<float>(x);
  const Image square = fill_frame(picture, 4, 4);
  for (int x = 0; x < 4; ++x) EXPECT_FLOAT_EQ(square.at(x, 1, 0), static_cast<float>(4 + x));
  const Image same = fill_frame(picture, 12, 4);
  EXPECT_EQ(same.data, picture.data) << "its own size changes nothing";
}

TEST(Composite, WhatCannotBeSeenDoesNotBleedIntoTheEdge) {
  // Black trees to the left; to the right nothing, which the file happens to store as white.
  PictureFile file;
  file.image = Image(10, 2, {"R", "G", "B", "A"});
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 10; ++x)
      for (int c = 0; c < 4; ++c)
        file.image.at(x, y, c) = c == 3 ? (x < 5 ? 1.0f : 0.0f) : (x < 5 ? 0.0f : 1.0f);
  for (const int width : {4, 10, 35}) {
    const Image foreground = fill_frame(linear_picture(file), width, 2);
    Image rgb = filled_with(width, 2, {0.3f, 0.2f, 0.1f}, {"R", "G", "B"});
    cover(foreground, rgb);
    for (int x = 0; x < width; ++x) {
      EXPECT_LE(rgb.at(x, 0, 0), 0.3f + 1e-7f) << "a bright fringe at " << x;
      EXPECT_NEAR(rgb.at(x, 0, 0) / rgb.at(0 + width - 1, 0, 0), rgb.at(x, 0, 2) / rgb.at(width - 1, 0, 2),
                  1e-6);
    }
    EXPECT_EQ(rgb.at(0, 0, 0), 0.0f);
    EXPECT_FLOAT_EQ(rgb.at(width - 1, 0, 0), 0.3f);
  }
}

TEST(Composite, AMaskTakesTheAlphasPlace) {
  Image picture = filled_with(4, 4, {0.5f, 0.5f, 0.5f, 0.5f}, {"R", "G", "B", "A"});
  Image coverage(2, 2, {"A"});
  coverage.data = {1.0f, 0.0f, 1.0f, 0.0f};
  const Image covered = with_coverage(picture, coverage);
  EXPECT_FLOAT_EQ(covered.at(0, 0, 0), 1.0f) << "the colour itself, without its own alpha";
  EXPECT_FLOAT_EQ(covered.at(0, 0, 3), 1.0f);
  EXPECT_FLOAT_EQ(covered.at(3, 3, 0), 0.0f);
  EXPECT_FLOAT_EQ(covered.at(3, 3, 3), 0.0f);
}

TEST(Composite, CoverIsTheSourcesFormula) {
  const Image foreground = filled_with(1, 1, {0.06f, 0.03f, 0.0f, 0.3f}, {"R", "G", "B", "A"});
  Image rgb = filled_with(1, 1, {1.0f, -0.5f, 0.25f}, {"R", "G", "B"});
  cover(foreground, rgb);
  EXPECT_NEAR(rgb.at(0, 0, 0), 0.3 * 0.2 + 0.7 * 1.0, 1e-6);
  EXPECT_NEAR(rgb.at(0, 0, 1), 0.3 * 0.1 - 0.7 * 0.5, 1e-6) << "signed light stays signed";
  EXPECT_NEAR(rgb.at(0, 0, 2), 0.7 * 0.25, 1e-6);
}

}  // namespace
}  // namespace vegard::sim::composite_test
