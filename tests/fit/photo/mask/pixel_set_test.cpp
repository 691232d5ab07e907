#include "fit/photo/mask/pixel_set.h"

#include <gtest/gtest.h>

#include "fit/photo/mask/faulty_pixels.h"
#include "fit/photo/mask/polygon.h"
#include "tests/support/made_sky.h"

namespace vegard::fit::pixel_set_test {
namespace {

TEST(PixelSet, GrowsByDiscsAndStaysInThePicture) {
  PixelSet set(20, 10);
  set.at(8, 5) = 1;
  EXPECT_EQ(grown(set, 0).count(), 1u);
  EXPECT_EQ(grown(set, 1).count(), 5u);
  EXPECT_EQ(grown(set, 2).count(), 13u);  // lattice points within 2 of the origin
  PixelSet corner(20, 10);
  corner.at(0, 0) = 1;
  EXPECT_EQ(grown(corner, 2).count(), 6u);  // the quarter of them with both signs not negative
}

TEST(PixelSet, DiscOfAPointHoldsItsPixel) {
  PixelSet set(20, 10);
  add_disc(set, 4.1, 3.9, 0.2);
  EXPECT_EQ(set.count(), 1u);
  EXPECT_EQ(set.at(4, 3), 1);
  PixelSet wide(20, 10);
  add_disc(wide, 8.5, 5.5, 2.0);
  EXPECT_EQ(wide.count(), 13u);
}

TEST(Polygon, HasThePixelsWhoseCentresAreInside) {
  const PixelSet square = polygon_inside({{2.0, 3.0}, {7.0, 3.0}, {7.0, 5.0}, {2.0, 5.0}}, 12, 9);
  EXPECT_EQ(square.count(), 10u);
  EXPECT_EQ(square.at(2, 3) + square.at(6, 4), 2);
  // A right triangle below the diagonal of 8 x 8: centres strictly below it, and those on it by half.
  const PixelSet triangle = polygon_inside({{0.0, 0.0}, {0.0, 8.1}, {8.1, 8.1}}, 9, 9);
  EXPECT_EQ(triangle.count(), 36u);
  // Reaching beyond the picture.
  EXPECT_EQ(polygon_inside({{-50.0, -50.0}, {50.0, -50.0}, {50.0, 50.0}, {-50.0, 50.0}}, 12, 9).count(),
            108u);
}

TEST(Saturated, TakesWhatAnyChannelCannotTellAndABorder) {
  Photo photo = tests::even_sky(30, 20, 0.2f);
  EXPECT_EQ(saturated_pixels(photo).count(), 0u);
  photo.usable[photo.linear.index(10, 10, 1)] = 0;
  EXPECT_EQ(saturated_pixels(photo, {0}).count(), 1u);
  EXPECT_EQ(saturated_pixels(photo, {2}).count(), 13u);
}

}  // namespace
}  // namespace vegard::fit::pixel_set_test
