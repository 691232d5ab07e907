#include "sim/base/utc_time.h"

#include <gtest/gtest.h>

namespace vegard::sim::utc_seconds_test {
namespace {

TEST(UtcSeconds, KnownMoments) {
  EXPECT_EQ(utc_seconds("1970-01-01T00:00:00Z"), 0.0);
  EXPECT_EQ(utc_seconds("2000-01-01T00:00:00Z"), 946684800.0);
  EXPECT_EQ(utc_seconds("2001-09-09T01:46:40"), 1e9);
  EXPECT_EQ(utc_seconds("1969-12-31 23:59:59.5"), -0.5);
  EXPECT_EQ(utc_text(0.0), "1970-01-01T00:00:00Z");
  EXPECT_EQ(utc_text(1e9), "2001-09-09T01:46:40Z");
  EXPECT_EQ(utc_text(-0.5), "1969-12-31T23:59:59.5Z");
}

// Every day of nine years and more, over a leap year that is a century's: text and number agree, and the days
// follow each other.
TEST(UtcSeconds, TextAndNumberAreInverses) {
  double before = *utc_seconds("1995-12-31T12:34:56.250Z");
  for (int day = 1; day < 3500; ++day) {
    const double now = before + 86400.0;
    const std::string text = utc_text(now);
    ASSERT_EQ(utc_seconds(text), now) << text;
    before = now;
  }
  EXPECT_EQ(utc_seconds("2000-03-01T00:00:00").value() - utc_seconds("2000-02-28T00:00:00").value(),
            2 * 86400.0);
  EXPECT_EQ(utc_seconds("2100-03-01T00:00:00").value() - utc_seconds("2100-02-28T00:00:00").value(), 86400.0);
}

TEST(UtcSeconds, AZoneIsTakenOff) {
  const double utc = utc_seconds("2019-03-01T21:10:00Z").value();
  for (const char* text : {"2019-03-01T22:10:00+01:00", "2019-03-01T22:10+01", "2019-03-01 22:10:00+0100",
                           "2019-03-02T02:40:00.0+05:30", "2019-03-01T14:10:00-07:00"})
    EXPECT_EQ(utc_seconds(text), utc) << text;
  EXPECT_EQ(in_utc("2019-03-01T22:10:00+01:00"), "2019-03-01T21:10:00Z");
  for (const char* text : {"2019-03-01T22:10:00.5Z", "2019-03-01", "", "yesterday-T-noon"})
    EXPECT_EQ(in_utc(text), text);
}

TEST(UtcSeconds, RefusesWhatNoCalendarHas) {
  for (const char* text :
       {"", "2015-10-07", "2015-02-29T00:00:00", "2015-13-01T00:00:00", "2015-10-07T24:00:00",
        "2015-10-07T08:23:51+1:00", "2015-10-07T08:23:51 ", "2015-10-07T08:23:51+15:00",
        "2015-10-07T08:23:51Z+01:00", "20151007T082351", "soon"})
    EXPECT_FALSE(utc_seconds(text)) << text;
}

std::optional<double> in_name(const char* name) {
  const auto time = time_in_name(name);
  return time && time->unclear.empty() ? std::optional<double>(time->utc_s()) : std::nullopt;
}

TEST(TimeInName, OfPictures) {
  EXPECT_EQ(in_name("PKR_DASC_0558_20151007_082351.743.FITS"),
            utc_seconds("2015-10-07T08:23:51").value() + 0.743);
  EXPECT_EQ(in_name("kho_nipr_20140221193040.jpg"), utc_seconds("2014-02-21T19:30:40"));
  EXPECT_EQ(in_name("trex_rgb_gill_20211030_060500.png"), utc_seconds("2021-10-30T06:05:00"));
  EXPECT_EQ(in_name("sky-2015-10-07T08-23-51.png"), utc_seconds("2015-10-07T08:23:51"));
  EXPECT_EQ(in_name("20151007T082351Z.jpg"), utc_seconds("2015-10-07T08:23:51"));
  for (const char* name : {"IMG_0001.jpg", "frame_000123.png", "x_20151399_082351.png", "20151007.png",
                           "1234567890123456.png", "120151007_082351.png", ""})
    EXPECT_FALSE(time_in_name(name)) << name;
}

TEST(TimeInName, AZoneIsTakenOff) {
  const auto utc = utc_seconds("2019-03-01T22:10:03Z");
  for (const char* name :
       {"2019-03-01T23-10-03+0100.png", "2019-03-01T23:10:03+01:00.png", "20190301T231003+0100.png",
        "20190301_171003_-0500.png", "20190301_171003-0500.png", "20190301T171003-05.png",
        "20190302T034003+05-30.png", "sky_20190301_231003_UTC+1.jpg", "20190301_231003_GMT+01:00.jpg",
        "20190301_221003_UTC.fits", "20190301_221003Z_0001.png", "20190301_221003.000Z.png",
        "2019-03-01_10-10-03_PM.png", "2019-03-01 10-10-03 PM UTC.png", "UTC_20190301_221003.png",
        "20190301_221003-0001.png", "20190301_221003-01.png"}) {
    EXPECT_EQ(in_name(name), utc) << name;
    const auto time = time_in_name(name);
    ASSERT_TRUE(time);
    // A number of a picture is no zone.
    const bool is_number = std::string(name).find("-000") != std::string::npos ||
                           std::string(name).find("3-01.") != std::string::npos;
    const bool is_half_alone = std::string(name).find("_PM.") != std::string::npos;
    EXPECT_EQ(time->offset_minutes.has_value(), !is_number && !is_half_alone) << name;
  }
  EXPECT_EQ(in_name("2019-03-01_12-10-03_AM.png"), utc_seconds("2019-03-01T00:10:03Z"));
  EXPECT_EQ(in_name("2019-03-01_12-10-03_PM.png"), utc_seconds("2019-03-01T12:10:03Z"));
  EXPECT_EQ(in_name("2019-03-01_22-10-03_PM.png"), utc);
}

TEST(TimeInName, WhatIsNotClearIsSaid) {
  const std::pair<const char*, const char*> kNames[] = {
      {"20190301_231003_CET.png", "CET"},     {"2019-03-01T23-10-03 EST.png", "EST"},
      {"20190301_231003+0107.png", "+0107"},  {"20190301_231003+1500.png", "+1500"},
      {"20190301_231003_local.png", "local"}, {"CET_20190301_231003.png", "CET"},
      {"20190301_221003_AM.png", "22 h AM"}};
  for (const auto& [name, unclear] : kNames) {
    const auto time = time_in_name(name);
    ASSERT_TRUE(time) << name;
    EXPECT_EQ(time->unclear, unclear) << name;
  }
}

TEST(UtcTime, ResolutionIsTheUnitOfTheLastDigit) {
  EXPECT_EQ(resolution_s("2015-10-07T08:23Z"), 60.0);
  EXPECT_EQ(resolution_s("2015-10-07 08:23:51+01:00"), 1.0);
  EXPECT_NEAR(resolution_s("2015-10-07T08:23:51.743Z"), 1e-3, 1e-15);
}

}  // namespace
}  // namespace vegard::sim::utc_seconds_test
