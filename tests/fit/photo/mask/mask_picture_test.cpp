#include "fit/photo/mask/mask_picture.h"

#include <gtest/gtest.h>

#include "fit/photo/mask/polygon.h"
#include "tests/support/made_sky.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::mask_picture_test {
namespace {

TEST(MaskPicture, IsReadAsTheMaskThatItWas) {
  const tests::TemporaryFolder folder;
  PixelSet out(31, 17);
  for (std::size_t i = 0; i < out.in.size(); ++i) out.in[i] = i % 7 == 3;
  const std::string file = folder / "mask.png";
  tests::put(file, mask_png(out));
  const Photo photo = tests::even_sky(31, 17, 0.2f);
  EXPECT_EQ(drawn_out(photo, file).in, out.in);
}

TEST(MaskPicture, ShowsTheFirstReasonOfEachPixel) {
  const tests::TemporaryFolder folder;
  Photo photo = tests::even_sky(12, 8, 0.0f);
  photo.floating = false;
  MaskPart first{"a", "red", {200, 0, 0}, PixelSet(12, 8)}, second{"b", "blue", {0, 0, 100}, PixelSet(12, 8)};
  first.out.at(3, 2) = second.out.at(3, 2) = second.out.at(4, 2) = 1;
  EXPECT_EQ(left_out({first, second}, 12, 8).count(), 2u);
  const std::string file = folder / "shown.png";
  tests::put(file, shown_mask_png(photo, {first, second}));
  const Photo shown = read_photo(file, Decoding::linear);
  EXPECT_FLOAT_EQ(shown.linear.at(3, 2, 0), 100.0f / 255.0f);
  EXPECT_FLOAT_EQ(shown.linear.at(3, 2, 2), 0.0f);
  EXPECT_FLOAT_EQ(shown.linear.at(4, 2, 2), 50.0f / 255.0f);
  EXPECT_FLOAT_EQ(shown.linear.at(5, 2, 2), 0.0f);
}

}  // namespace
}  // namespace vegard::fit::mask_picture_test
