#include "fit/photo/frames/imager_words.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace vegard::fit::imager_words_test {
namespace {

TEST(ImagerWords, AreTheCommentsWithAKey) {
  const ImagerWords words = imager_words(
      "P5\n#\"Site unique ID\" gill\r\n# a remark\n#\"open\n#\"Filter Serial Number\" \n#\"NTP delay\"   0.9 "
      "\n"
      "2 1\n65535\n");
  const ImagerWords expected = {
      {"Site unique ID", "gill"}, {"Filter Serial Number", ""}, {"NTP delay", "0.9"}};
  EXPECT_EQ(words, expected);
}

TEST(ImagerWords, OfTheFirstFrameHoldUntilAnotherSaysElse) {
  const ImagerWords first = {{"Site unique ID", "gill"}, {"Mode unique ID", "full"}};
  const ImagerWords both = with_words_of_file({{"mode unique id", "thumb"}}, first);
  const ImagerWords expected = {{"Site unique ID", "gill"}, {"mode unique id", "thumb"}};
  EXPECT_EQ(both, expected);
}

TEST(ImagerWords, TellTheTimeToTheMicrosecond) {
  const auto time = imager_time({{"Image request start", "2014-03-10 06:05:33.029314 UTC"}});
  ASSERT_TRUE(time);
  EXPECT_EQ(time->utc, "2014-03-10T06:05:33.029314Z");
  EXPECT_NEAR(time->seconds, 1394431533.029314, 1e-6);
  EXPECT_FALSE(imager_time({{"Image request start", "2014-02-30 06:05:33 UTC"}}));
  EXPECT_FALSE(imager_time({{"Image request start", ""}}));
  EXPECT_FALSE(imager_time({{"Image readout start", "2014-03-10 06:05:33 UTC"}}));
}

TEST(ImagerWords, TellTheExposure) {
  EXPECT_EQ(imager_exposure_s({{"exposure Options", "WIDTH=256 MSEC=5000.00"}}), 5.0);
  EXPECT_EQ(imager_exposure_s({{"subframe_requested_exposure", "320.0 ms"}}), 0.32);
  EXPECT_FALSE(imager_exposure_s({{"Exposure options", "XMSEC=5 MSEC=-1"}}));
}

TEST(ImagerWords, TellPlaceAndCamera) {
  const sim::PictureMetadata metadata = imager_metadata({{"Geographic latitude", "56.376723"},
                                                         {"Geographic longitude", "265.356336"},
                                                         {"Camera Model", "Andor"},
                                                         {"Imager unique ID", "nir-216"}},
                                                        256, 270);
  EXPECT_EQ(metadata.latitude_deg, 56.376723);
  EXPECT_NEAR(*metadata.longitude_deg, -94.643664, 1e-9);
  EXPECT_EQ(metadata.sources.longitude, "PGM comment \"Geographic longitude\"");
  EXPECT_FALSE(metadata.altitude_m);
  EXPECT_EQ(metadata.model, "Andor");
  EXPECT_EQ(metadata.imager, "nir-216");
  EXPECT_EQ(metadata.height_px, 270);
  const auto nowhere = imager_metadata({{"Geodetic latitude", "95"}, {"Geodetic longitude", "0"}}, 1, 1);
  EXPECT_FALSE(nowhere.latitude_deg || nowhere.longitude_deg);
}

TEST(ImagerWords, CannotBeOfAnotherSize) {
  const auto told = [](const std::string& options, int width, int height) {
    return contradicted_size({{"Exposure options", options}}, width, height).empty();
  };
  EXPECT_TRUE(told("WIDTH=512 HEIGHT=256 XBIN=2 YBIN=1", 256, 256));    // THEMIS
  EXPECT_TRUE(told("WIDTH=512 HEIGHT=256 XBIN=2 YBIN=1", 32, 32));      // its small pictures
  EXPECT_TRUE(told("WIDTH=256 HEIGHT=256 XBIN=8 YBIN=8", 256, 256));    // TREx near infrared
  EXPECT_TRUE(told("WIDTH=2560 HEIGHT=2160 XBIN=8 YBIN=8", 320, 270));  // TREx blue
  EXPECT_TRUE(told("MSEC=999", 3, 5));
  EXPECT_FALSE(told("WIDTH=512 HEIGHT=256 XBIN=2 YBIN=1", 256, 128));
  EXPECT_FALSE(told("WIDTH=512 HEIGHT=256 XBIN=2 YBIN=1", 512, 512));
  EXPECT_FALSE(told("WIDTH=0 HEIGHT=0", 256, 256));
}

TEST(ImagerName, OfAPictureTellsAllOfIt) {
  const auto name = imager_name("20211030_060500_149606_gill_rgb-04_320ms_burst.png");
  ASSERT_TRUE(name);
  EXPECT_EQ(name->utc, "2021-10-30T06:05:00.149606Z");
  EXPECT_EQ(name->site, "gill");
  EXPECT_EQ(name->imager, "rgb-04");
  EXPECT_EQ(name->mode, "burst");
  EXPECT_EQ(name->exposure_s, 0.32);
  EXPECT_EQ(name->lasts_s, 0.0);
}

TEST(ImagerName, OfFramesTellsTheMinuteOrTheHour) {
  for (const char* file : {"20140310_0603_gill_themis19_full.pgm.gz", "20140310_0603_gill_themis19_full.pgm"})
    EXPECT_EQ(imager_name(file)->lasts_s, 60.0);
  const auto hour = imager_name("20140310_06_gill_themis19_thumb32.pgm.gz");
  EXPECT_EQ(hour->lasts_s, 3600.0);
  EXPECT_EQ(hour->begin_s, 1394431200.0);
  for (const char* file : {"20140310_060_gill_themis19_full.pgm", "20141310_0603_gill_themis19_full.pgm",
                           "photo.png", "20211030_060500_149606_gill_rgb-04_320ms_burst.jpg", ""})
    EXPECT_FALSE(imager_name(file)) << file;
}

TEST(ImagerName, IsTakenForWhatTheFileLeavesOut) {
  const std::string name = "20211030_060500_149606_gill_rgb-04_320ms_burst.png";
  sim::PictureMetadata metadata;
  metadata.exposure_s = 1.0;
  add_imager_name(name, metadata);
  EXPECT_EQ(metadata.header_time_utc, "2021-10-30T06:05:00.149606Z");
  EXPECT_EQ(metadata.sources.header_time, "the file's name");
  EXPECT_EQ(metadata.exposure_s, 1.0);
  EXPECT_EQ(metadata.site, "gill");
  metadata = {};
  metadata.taken_local = "2021-10-30T00:05:00";
  add_imager_name(name, metadata);
  EXPECT_FALSE(metadata.header_time_utc);
}

TEST(ImagerName, IsContradictedByATimeOutsideOfItsMinute) {
  const auto told = [](const char* utc) {
    sim::PictureMetadata metadata;
    metadata.header_time_utc = utc;
    return contradicted_time("20140310_0603_gill_themis19_full.pgm.gz", metadata);
  };
  EXPECT_EQ(told("2014-03-10T06:03:57.5Z"), "");
  EXPECT_EQ(told("2014-03-10T06:02:59.9Z"), "");
  EXPECT_TRUE(tests::has_facts(told("2014-03-10T06:04:30Z"), "2014-03-10T06:03:00Z | 2014-03-10T06:04:30Z"));
}

}  // namespace
}  // namespace vegard::fit::imager_words_test
