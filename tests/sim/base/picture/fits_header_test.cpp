
#include <gtest/gtest.h>

#include "sim/base/picture/fits_header.h"
#include "sim/base/picture/picture_metadata.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::fits_header_test {
namespace {

using tests::fits_card;

/// "time, by keys", or nothing, of an image whose header has these cards.
std::string told(const std::string& cards) {
  const auto time = fits_time(tests::fits_image(16, {2, 1}, {1, 2}, cards));
  return time ? time->utc + ", by " + time->key : "";
}

TEST(FitsTime, ByOneKeywordOrTwo) {
  EXPECT_EQ(told(fits_card("DATE-OBS", "'2015-10-07T08:23:51.743'")),
            "2015-10-07T08:23:51.743Z, by DATE-OBS");
  EXPECT_EQ(told(fits_card("TIME-OBS", "'08:23:51'") + fits_card("DATE-OBS", "'2015-10-07'")),
            "2015-10-07T08:23:51Z, by DATE-OBS and TIME-OBS");
  EXPECT_EQ(
      told(fits_card("OBSDATE", "'2015-10-07'  /UT Date") + fits_card("OBSSTART", "'08:23:51.743' /UT")),
      "2015-10-07T08:23:51.743Z, by OBSDATE and OBSSTART");
  EXPECT_EQ(told(fits_card("DATE-OBS", "'2015-10-07T08:23:51'") + fits_card("TIMESYS", "'UTC     '")),
            "2015-10-07T08:23:51Z, by DATE-OBS");
}

TEST(FitsTime, WhatIsNoTimeIsNotTold) {
  EXPECT_EQ(told(""), "");
  EXPECT_EQ(told(fits_card("DATE-OBS", "'2015-10-07'")), "");
  EXPECT_EQ(told(fits_card("DATE-OBS", "'2015-02-30T08:23:51'")), "");
  EXPECT_EQ(told(fits_card("DATE-OBS", "'07/10/15'") + fits_card("TIME-OBS", "'08:23:51'")), "");
  EXPECT_EQ(told(fits_card("DATE-OBS", "'2015-10-07T08:23:51'") + fits_card("TIMESYS", "'TAI'")), "");
  EXPECT_EQ(told(fits_card("DATE", "'2015-10-07T08:23:51'")), "");  // when the file was written
  EXPECT_EQ(told(fits_card("OBSSTART", "'08:23:51'")), "");
  EXPECT_FALSE(fits_time("DATE-OBS= '2015-10-07T08:23:51'"));
}

TEST(FitsTime, IsPartOfWhatAPictureSays) {
  const tests::TemporaryFolder folder;
  const std::string whole =
      tests::fits_image(16, {2, 1}, {1, 2}, fits_card("DATE-OBS", "'2015-10-07T08:23:51.743'"));
  tests::put(folder / "a.fits", whole);
  const PictureMetadata metadata = read_picture_metadata(folder / "a.fits");
  EXPECT_EQ(taken_utc(metadata), "2015-10-07T08:23:51.743Z");
  EXPECT_EQ(metadata.sources.header_time, "FITS DATE-OBS");
  // Cut anywhere it tells the time or none, and never fails.
  for (std::size_t size = 0; size < 700; ++size) {
    const auto time = fits_time(std::string_view(whole).substr(0, size));
    EXPECT_TRUE(!time || time->utc == "2015-10-07T08:23:51.743Z") << size;
  }
}

}  // namespace
}  // namespace vegard::sim::fits_header_test
