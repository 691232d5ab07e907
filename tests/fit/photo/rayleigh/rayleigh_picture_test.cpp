// Counts to rayleighs, of FITS files whose every number is known.

#include <gtest/gtest.h>

#include <cmath>

#include "fit/photo/rayleigh/count_picture.h"
#include "sim/base/error.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"
#include "tests/support/expect_error.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::rayleigh_picture_test {
namespace {

using sim::ErrorKind;
using tests::expect_words;

/// 13 x 12 pixels of 1000 counts, 11 of the first row's more by their number, the last of them full.
class Counted : public ::testing::Test {
 protected:
  Counted() {
    std::vector<double> counts(156, 1000.0);
    for (int i = 0; i < 11; ++i) counts[i] += i;
    counts[12] = 32767.0;
    const std::string top = tests::fits_card("ROWORDER", "'TOP-DOWN'");
    tests::put(folder_ / "p.fits", tests::fits_image(16, {13, 12}, counts, top));
    tests::put(folder_ / "dark.fits", tests::fits_image(16, {13, 12}, std::vector<double>(156, 200.0), top));
    std::vector<double> flat(156, 20000.0);
    flat[5] = 10000.0;
    flat[6] = 0.0;
    tests::put(folder_ / "flat.fits", tests::fits_image(16, {13, 12}, flat, top));
    filter_.name = "green";
    filter_.band.line_nm = 557.7;
    filter_.factor = RayleighFactor{25.0, 1.0};
    filter_.dark_counts = 200.0;
  }

  tests::TemporaryFolder folder_;
  RayleighFilter filter_;
};

TEST_F(Counted, AreRatesAndRayleighs) {
  filter_.gain_e_per_count = 2.0;
  filter_.read_noise_counts = 3.0;
  filter_.dark_error_counts = 4.0;
  const CountPicture counts = count_picture(folder_ / "p.fits", filter_, 2.0);
  EXPECT_EQ(counts.rate.at(3, 0, 0), 401.5f);
  EXPECT_EQ(counts.usable[12], 0);
  EXPECT_NEAR(counts.variance[3], (803.0 / 2.0 + 9.0 + 1.0 / 12.0) / 4.0, 1e-3);
  const RayleighPicture picture = rayleigh_picture(counts, filter_);
  EXPECT_EQ(picture.image.channel_names, (std::vector<std::string>{"rayleigh.5577", "error.5577"}));
  EXPECT_NEAR(picture.image.at(3, 0, 0), 25.0 * 401.5, 1e-2);
  EXPECT_NEAR(picture.image.at(3, 0, 1), 25.0 * std::sqrt(counts.variance[3] + 4.0), 1e-2);
  EXPECT_TRUE(std::isnan(picture.image.at(12, 0, 0)));
  EXPECT_EQ(picture.unknown, 1u);
  EXPECT_DOUBLE_EQ(picture.scale_error, 0.04);
  EXPECT_EQ(picture.median, 10000.0);
}

TEST_F(Counted, HaveADarkPictureAndAFlatField) {
  filter_.dark_file = folder_ / "dark.fits";
  filter_.flat_file = folder_ / "flat.fits";
  filter_.flat_error = 0.03;
  const CountPicture counts = count_picture(folder_ / "p.fits", filter_, 1.0);
  EXPECT_NEAR(counts.rate.at(4, 0, 0), 804.0, 1e-2);
  EXPECT_NEAR(counts.rate.at(5, 0, 0), 1610.0, 1e-2);  // half as sensitive
  EXPECT_EQ(counts.usable[6], 0);
  EXPECT_DOUBLE_EQ(rayleigh_picture(counts, filter_).scale_error, 0.05);
}

TEST_F(Counted, AreWrittenAsFitsAndExr) {
  const CountPicture counts = count_picture(folder_ / "p.fits", filter_, 2.0);
  const RayleighPicture picture = rayleigh_picture(counts, filter_);
  RayleighCamera camera;
  camera.name = "a camera";
  const sim::FitsImage fits =
      sim::read_fits_image(encode_rayleigh_fits(picture, filter_, camera, "p.fits", 2.0, "out"), "out");
  EXPECT_EQ(fits.image.at(3, 0, 0), picture.image.at(3, 0, 0));
  EXPECT_EQ(fits.image.at(3, 0, 1), picture.image.at(3, 0, 1));
  EXPECT_EQ(fits.known[2 * 12], 0);
  EXPECT_EQ(fits.keywords.at("BUNIT"), "R");
  EXPECT_NEAR(std::stod(fits.keywords.at("SCALEERR")), 0.04, 1e-12);
  const sim::ExrFile exr =
      sim::read_exr_bytes(encode_rayleigh_exr(picture, filter_, camera, "p.fits", 2.0, "out"), "out");
  EXPECT_EQ(exr.attributes.at("scale_error"), "0.04");
  EXPECT_NE(exr.attributes.at("units").find("without a gain"), std::string::npos);
}

TEST_F(Counted, AreRefusedWhereTheyAreNone) {
  expect_words(ErrorKind::unreadable_input, {"p.fits", "how long", "--exposure"},
               [&] { count_picture(folder_ / "p.fits", filter_); });
  filter_.exposure_s = 4.0;
  EXPECT_EQ(count_picture(folder_ / "p.fits", filter_).exposure_s, 4.0);
  tests::put(folder_ / "timed.fits",
             tests::fits_image(16, {2, 1}, {1, 2}, tests::fits_card("EXPTIME", "1.5")));
  EXPECT_EQ(count_picture(folder_ / "timed.fits", filter_).exposure_s, 1.5);
  EXPECT_EQ(count_picture(folder_ / "timed.fits", filter_, 3.0).exposure_s, 3.0);
  tests::put(folder_ / "small.fits", tests::fits_image(16, {2, 2}, {1, 2, 3, 4}));
  filter_.flat_file = folder_ / "small.fits";
  expect_words(ErrorKind::unreadable_input, {"small.fits", "flat field", "2 x 2", "13 x 12"},
               [&] { count_picture(folder_ / "p.fits", filter_); });
  filter_.flat_file.clear();
  tests::put(folder_ / "c.ppm", "P6 2 1 255\nabcdef");
  expect_words(ErrorKind::usage, {"c.ppm", "three colours", "channel"},
               [&] { count_picture(folder_ / "c.ppm", filter_); });
  filter_.channel = "blue";
  EXPECT_EQ(count_picture(folder_ / "c.ppm", filter_).rate.at(1, 0, 0), ('f' - 200.0f) / 4.0f);
}

}  // namespace
}  // namespace vegard::fit::rayleigh_picture_test
