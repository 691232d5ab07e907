#include "sim/base/picture/fits_time.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "sim/base/picture/picture_metadata.h"
#include "sim/base/utc_time.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::fits_time_test {
namespace {

using tests::fits_card;

std::optional<FitsTime> time_of(const std::string& cards) {
  return fits_time(tests::fits_image(16, {2, 1}, {1, 2}, cards));
}

/// "time, by keys", or nothing, of an image whose header has these cards.
std::string told(const std::string& cards) {
  const auto time = time_of(cards);
  return time ? time->utc + ", by " + time->key : "";
}

/// The middle of the exposure; NaN if it is not known.
double middle_s(const std::string& cards) {
  const auto time = time_of(cards);
  return time && time->middle_after_s ? *utc_seconds(time->utc) + *time->middle_after_s : NAN;
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

// TAI - UTC was 36 s then (IERS Bulletin C 49), TT - TAI is 32.184 s, and GPS counts 19 s less than TAI.
TEST(FitsTime, OfOtherClocks) {
  const std::string date = fits_card("DATE-OBS", "'2015-10-07T08:23:51'");
  EXPECT_EQ(told(date + fits_card("TIMESYS", "'TAI'")), "2015-10-07T08:23:15Z, by DATE-OBS");
  EXPECT_EQ(told(date + fits_card("TIMESYS", "'TT'")), "2015-10-07T08:22:42.816Z, by DATE-OBS");
  EXPECT_EQ(told(date + fits_card("TIMESYS", "'GPS'")), "2015-10-07T08:23:34Z, by DATE-OBS");
}

TEST(FitsTime, WhatIsNoTimeIsNotTold) {
  EXPECT_EQ(told(""), "");
  EXPECT_EQ(told(fits_card("DATE-OBS", "'2015-10-07'")), "");
  EXPECT_EQ(told(fits_card("DATE-OBS", "'2015-02-30T08:23:51'")), "");
  EXPECT_EQ(told(fits_card("DATE-OBS", "'07/10/15'") + fits_card("TIME-OBS", "'08:23:51'")), "");
  EXPECT_EQ(told(fits_card("DATE-OBS", "'2015-10-07T08:23:51'") + fits_card("TIMESYS", "'LOCAL'")), "");
  EXPECT_EQ(told(fits_card("DATE", "'2015-10-07T08:23:51'")), "");  // when the file was written
  EXPECT_EQ(told(fits_card("OBSSTART", "'08:23:51'")), "");
  EXPECT_FALSE(fits_time("DATE-OBS= '2015-10-07T08:23:51'"));
}

TEST(FitsTime, TheMiddleOfTheExposure) {
  const double begin = *utc_seconds("2014-02-21T19:30:40Z");
  const std::string obs = fits_card("DATE-OBS", "'2014-02-21T19:30:40'"),
                    exposure = fits_card("EXPTIME", "60.0");
  EXPECT_EQ(middle_s(obs + exposure), begin + 30.0);
  EXPECT_EQ(middle_s(obs + fits_card("EXPOSURE", "60000 / [ms] exposure")), begin + 30.0);
  EXPECT_EQ(middle_s(fits_card("DATE-AVG", "'2014-02-21T19:31:10'") + exposure), begin + 30.0);
  EXPECT_EQ(middle_s(fits_card("DATE-END", "'2014-02-21T19:31:40'") + exposure), begin + 30.0);
  EXPECT_EQ(middle_s(fits_card("DATE-BEG", "'2014-02-21T19:30:40'") +
                     fits_card("DATE-END", "'2014-02-21T19:31:40'")),
            begin + 30.0);
  // A stack of exposures, and DATE-OBS that is not the beginning.
  EXPECT_EQ(middle_s(obs + fits_card("EXPTIME", "30.0") + fits_card("DATE-END", "'2014-02-21T19:31:40'")),
            begin + 30.0);
  EXPECT_EQ(middle_s(obs + exposure + fits_card("DATE-AVG", "'2014-02-21T19:30:40'")), begin);
  EXPECT_EQ(middle_s(obs + exposure + fits_card("DATE-END", "'2014-02-21T19:30:40'")), begin - 30.0);
  EXPECT_NEAR(middle_s(fits_card("MJD-OBS", "56709.812962963") + exposure), begin + 30.0, 1e-3);
  EXPECT_TRUE(std::isnan(middle_s(obs)));
}

TEST(FitsTime, WhatContradictsIsSaid) {
  const std::string obs = fits_card("DATE-OBS", "'2014-02-21T19:30:40'"),
                    exposure = fits_card("EXPTIME", "60.0");
  for (const std::string& other :
       {fits_card("DATE-END", "'2014-02-21T18:31:40'"), fits_card("DATE-AVG", "'2014-02-22T19:30:40'"),
        fits_card("MJD-OBS", "56709.85")}) {
    const auto time = time_of(obs + exposure + other);
    ASSERT_TRUE(time);
    EXPECT_NE(time->contradiction.find("DATE-OBS 2014-02-21T19:30:40Z"), std::string::npos)
        << time->contradiction;
    EXPECT_EQ(time->middle_after_s, 30.0);
  }
  EXPECT_EQ(time_of(obs + exposure + fits_card("MJD-OBS", "56709.8129"))->contradiction, "");
}

// The image in an extension, behind an empty first header, as fpack and writers of several extensions do.
TEST(FitsTime, OfAnExtension) {
  const std::string first =
      tests::fits_header(8, {}, fits_card("EXTEND", "T") + fits_card("EXPTIME", "10.0"));
  std::string cards = fits_card("XTENSION", "'IMAGE   '") + fits_card("BITPIX", "8") +
                      fits_card("NAXIS", "2") + fits_card("NAXIS1", "2") + fits_card("NAXIS2", "1") +
                      fits_card("PCOUNT", "0") + fits_card("GCOUNT", "1") +
                      fits_card("DATE-OBS", "'2014-02-21T19:30:40'") + "END";
  const auto time = fits_time(first + tests::fits_block(cards, ' ') + tests::fits_block("ab", '\0'));
  ASSERT_TRUE(time);
  EXPECT_EQ(time->utc, "2014-02-21T19:30:40Z");
  EXPECT_EQ(time->middle_after_s, 5.0);
}

// Thirty headers with random times, exposures and keywords. Seed 4503; to the millisecond of the text.
TEST(FitsTime, OfRandomHeaders) {
  std::mt19937 random(4503);
  const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  const auto text = [](double seconds) {
    std::string words = utc_text(seconds);
    words.pop_back();
    return "'" + words + "'";
  };
  for (int i = 0; i < 30; ++i) {
    const double begin = *utc_seconds("2001-01-01T00:00:00Z") + below(9000) * 86400.0 + below(86400);
    const double lasts = 1.0 + below(240) + 0.001 * below(1000);
    char number[40];
    std::snprintf(number, sizeof number, "%.3f", lasts);
    const std::string exposure = fits_card("EXPTIME", number);
    std::string cards;
    switch (i % 5) {
      case 0:
        cards = fits_card("DATE-OBS", text(begin)) + exposure;
        break;
      case 1:
        cards = fits_card("DATE-BEG", text(begin)) + fits_card("DATE-END", text(begin + lasts));
        break;
      case 2:
        cards = fits_card("DATE-AVG", text(begin + 0.5 * lasts)) + exposure;
        break;
      case 3:
        cards = fits_card("DATE-END", text(begin + lasts)) + exposure;
        break;
      default:
        cards =
            fits_card("DATE-OBS", text(begin)) + fits_card("DATE-AVG", text(begin + 0.5 * lasts)) + exposure;
    }
    EXPECT_NEAR(middle_s(cards), begin + 0.5 * lasts, 2e-3) << cards;
    EXPECT_EQ(time_of(cards)->contradiction, "") << cards;
  }
}

TEST(FitsTime, IsPartOfWhatAPictureSays) {
  const tests::TemporaryFolder folder;
  const std::string whole = tests::fits_image(
      16, {2, 1}, {1, 2}, fits_card("DATE-OBS", "'2015-10-07T08:23:51.743'") + fits_card("EXPTIME", "2.5"));
  tests::put(folder / "a.fits", whole);
  const PictureMetadata metadata = read_picture_metadata(folder / "a.fits");
  EXPECT_EQ(taken_utc(metadata), "2015-10-07T08:23:51.743Z");
  EXPECT_EQ(metadata.sources.header_time, "FITS DATE-OBS");
  EXPECT_EQ(metadata.exposure_s, 2.5);
  EXPECT_EQ(metadata.middle_after_s, 1.25);
  // Cut anywhere it tells the time or none, and never fails.
  for (std::size_t size = 0; size < 700; ++size) {
    const auto time = fits_time(std::string_view(whole).substr(0, size));
    EXPECT_TRUE(!time || time->utc == "2015-10-07T08:23:51.743Z") << size;
  }
}

}  // namespace
}  // namespace vegard::sim::fits_time_test
