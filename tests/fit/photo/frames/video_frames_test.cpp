// Frames of films that FFmpeg's encoders have made (tests/support/frames/made_video.h).

#include <gtest/gtest.h>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/frame_store.h"
#include "fit/photo/frames/picture_bytes.h"
#include "fit/photo/light_declarations.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_facts.h"
#include "fit/photo/photo_metadata.h"
#include "sim/base/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/frames/made_video.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::video_frames_test {
namespace {

using sim::ErrorKind;
using tests::MadeVideo;

/// Greys that differ from frame to frame by more than any of the codecs errs.
int grey_of(int frame) { return 60 + 9 * frame; }

MadeVideo film(int frames = 12) {
  MadeVideo made;
  for (int i = 0; i < frames; ++i) made.times_ms.push_back(40 * i);
  made.codes = [](int frame) { return std::array<int, 3>{grey_of(frame), 128, 128}; };
  return made;
}

class VideoFrames : public testing::Test {
 protected:
  std::string put(const MadeVideo& made, const std::string& name = "film.mp4") const {
    tests::put(folder_ / name, tests::video_bytes(made));
    return folder_ / name;
  }
  tests::TemporaryFolder folder_;
};

/// The code of the last pixel, in which there is no mark.
int last_code(const PictureBytes& picture) { return static_cast<unsigned char>(picture.bytes.back()); }

TEST_F(VideoFrames, AreTheSamePicturesInWhateverOrderTheyAreRead) {
  struct Kind {
    const char *container, *encoder, *pixels;
    std::map<std::string, std::string> options;
  };
  const std::vector<Kind> kinds = {{"mp4", "mpeg4", "yuv420p", {{"bf", "2"}}},
                                   {"avi", "mpeg4", "yuv420p", {}},
                                   {"avi", "mjpeg", "yuvj420p", {}},
                                   {"matroska", "ffv1", "yuv422p10le", {}},
                                   {"mov", "libx264", "yuv420p", {{"bf", "2"}, {"keyint", "4"}}}};
  for (const Kind& kind : kinds) {
    if (!tests::is_encoder_there(kind.encoder)) continue;
    SCOPED_TRACE(std::string(kind.container) + " " + kind.encoder);
    MadeVideo made = film();
    made.container = kind.container;
    made.encoder = kind.encoder;
    made.pixels = kind.pixels;
    made.options = kind.options;
    const bool is_deep = made.pixels == "yuv422p10le";
    if (is_deep) made.codes = [](int frame) { return std::array<int, 3>{4 * grey_of(frame), 512, 512}; };
    const std::string file = put(made, std::string("film.") + kind.container);
    ASSERT_TRUE(is_frame_file(file));
    const FrameIndex index = frame_index(file);
    ASSERT_EQ(index.frames.size(), 12u);
    std::vector<std::string> one_by_one;
    PictureSeries series;
    for (int f = 0; f < 12; ++f) {
      EXPECT_NEAR(*index.frames[f].stream.seconds, 0.04 * f, 1e-9);
      const PictureBytes picture = series.read(name_of_frame(file, f));
      one_by_one.push_back(picture.bytes);
      if (is_deep) continue;
      // Limited range: 16 is black and 235 white; a JPEG's is full.
      const double grey =
          kind.encoder == std::string("mjpeg") ? grey_of(f) : (grey_of(f) - 16.0) * 255.0 / 219.0;
      EXPECT_NEAR(last_code(picture), grey, 2.0) << f;
    }
    for (const int f : {11, 3, 9, 0, 6, 5})
      EXPECT_EQ(read_picture_bytes(name_of_frame(file, f)).bytes, one_by_one[f]) << f;
    const std::unique_ptr<FrameStore> store = frame_store(file);
    for (const int f : {10, 1, 8, 2}) EXPECT_EQ(store->picture(f), one_by_one[f]) << f;
  }
}

TEST_F(VideoFrames, HaveTheStreamsOwnTimesWhereTheirRateVaries) {
  MadeVideo made = film(0);
  made.times_ms = {100, 140, 640, 700, 2700};
  const FrameIndex index = frame_index(put(made));
  const std::vector<double> expected = {0.0, 0.04, 0.54, 0.6, 2.6};
  ASSERT_EQ(index.frames.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(*index.frames[i].stream.seconds, expected[i], 1e-9);
  EXPECT_FALSE(index.frames[0].time);
}

TEST_F(VideoFrames, TakeTheirTimeFromANameWithAZoneButNotFromTheContainersClock) {
  MadeVideo made = film(30);
  made.words = {{"creation_time", "2021-03-05T22:10:00Z"}};
  const std::string plain = put(made, "film.mp4");
  const sim::PictureMetadata of_clock = photo_metadata(plain + "#25");
  EXPECT_FALSE(of_clock.header_time_utc);
  EXPECT_EQ(of_clock.taken_local, "2021-03-05T22:10:01");
  const std::string note = photo_facts(of_clock).notes.front();
  EXPECT_TRUE(tests::has_facts(note, "creation_time | 2021-03-05T22:10:01"));

  const std::string named = put(made, "sky_20210305_231000+0100.mp4");
  EXPECT_EQ(*photo_metadata(named + "#25").header_time_utc, "2021-03-05T22:10:01Z");
  EXPECT_EQ(read_picture_bytes(named + "#2021-03-05T22:10:01Z").name, named + "#25");
}

TEST_F(VideoFrames, TakeQuickTimesDateAndPlace) {
  MadeVideo made = film(3);
  made.container = "mov";
  made.words = {{"com.apple.quicktime.creationdate", "2021-03-05T23:10:00+0100"},
                {"com.apple.quicktime.location.ISO6709", "+69.6492-018.9553+010.0/"}};
  const std::string file = put(made, "film.mov");
  const sim::PictureMetadata metadata = photo_metadata(file + "#2");
  EXPECT_EQ(*metadata.header_time_utc, "2021-03-05T22:10:00.08Z");
  EXPECT_EQ(metadata.latitude_deg, 69.6492);
  EXPECT_EQ(metadata.longitude_deg, -18.9553);
  EXPECT_EQ(metadata.altitude_m, 10.0);
}

/// Linear light of the last pixel's red, green and blue.
std::array<float, 3> light_of(const std::string& file) {
  const Photo photo = read_photo(file + "#0", Decoding::automatic);
  const int x = photo.linear.width - 1, y = photo.linear.height - 1;
  return {photo.linear.at(x, y, 0), photo.linear.at(x, y, 1), photo.linear.at(x, y, 2)};
}

TEST_F(VideoFrames, AreBt709WhereTheyDeclareNothing) {
  // ITU-R BT.709-6: E' = (Y - 16) / 219; light of E' = 0.5 is ((0.5 + 0.099) / 1.099)^(1 / 0.45) = 0.2595.
  MadeVideo made = film(2);
  made.codes = [](int) { return std::array<int, 3>{126, 128, 128}; };
  made.encoder = "ffv1";
  made.container = "matroska";
  const std::string file = put(made, "film.mkv");
  constexpr double kStep = 1.0 / 255.0;  // of the code, at a slope of less than one
  for (const float light : light_of(file)) EXPECT_NEAR(light, 0.2595, kStep);
  const std::vector<std::string> declared = light_declarations(file + "#0");
  ASSERT_EQ(declared.size(), 1u);
  EXPECT_TRUE(tests::has_facts(declared[0], "limited range | assumed: matrix | transfer (BT.709)"));
}

TEST_F(VideoFrames, FollowWhatTheyDeclare) {
  MadeVideo made = film(2);
  made.encoder = "ffv1";
  made.container = "matroska";
  made.transfer = 8;  // linear
  made.primaries = made.matrix = 1;
  made.says_full_range = true;
  // Y, Cb and Cr of BT.709 for red 0.6, green 0.4, blue 0.2: Y = 0.2126 R + 0.7152 G + 0.0722 B,
  // Cb = (B - Y) / 1.8556, Cr = (R - Y) / 1.5748.
  const double y = 0.2126 * 0.6 + 0.7152 * 0.4 + 0.0722 * 0.2;
  made.codes = [y](int) {
    return std::array<int, 3>{static_cast<int>(std::lround(255 * y)),
                              static_cast<int>(std::lround(128 + 255 * (0.2 - y) / 1.8556)),
                              static_cast<int>(std::lround(128 + 255 * (0.6 - y) / 1.5748))};
  };
  const std::array<float, 3> light = light_of(put(made, "film.mkv"));
  constexpr double kSteps = 2.5 / 255.0;  // of rounding Y, Cb and Cr
  EXPECT_NEAR(light[0], 0.6, kSteps);
  EXPECT_NEAR(light[1], 0.4, kSteps);
  EXPECT_NEAR(light[2], 0.2, kSteps);
}

TEST_F(VideoFrames, StandUpright) {
  MadeVideo made = film(2);
  made.container = "mov";
  made.quarter_turns = 1;
  const std::string file = put(made, "film.mov");
  const Photo photo = read_photo(file + "#1", Decoding::automatic);
  ASSERT_EQ(photo.linear.width, 48);
  ASSERT_EQ(photo.linear.height, 64);
  // The bright mark of the upper left is at the upper right of a picture that was turned clockwise.
  EXPECT_GT(photo.linear.at(44, 4, 1), 1.2f * photo.linear.at(4, 4, 1));
  EXPECT_NEAR(photo.linear.at(4, 4, 1), photo.linear.at(4, 60, 1), 0.01);
}

void expect_refused(const std::string& file, const std::string& name, const std::string& facts) {
  const std::string text =
      tests::expect_error(ErrorKind::unreadable_input, [&] { read_picture_bytes(name); });
  EXPECT_TRUE(tests::has_facts(text, file)) << name;
  EXPECT_TRUE(tests::has_facts(text, facts));
}

TEST_F(VideoFrames, AreRefusedWhereThereAreNone) {
  MadeVideo sound;
  sound.container = "mov";
  sound.has_sound = true;
  const std::string only_sound = put(sound, "sound.mov");
  expect_refused(only_sound, only_sound, "sound");
  MadeVideo none = film(0);
  const std::string empty = put(none, "empty.mp4");
  expect_refused(empty, empty, "");
  MadeVideo oblong = film(2);
  oblong.pixel_aspect = {4, 3};
  const std::string wide = put(oblong, "wide.mp4");
  expect_refused(wide, wide + "#0", "square");
  tests::put(folder_ / "rubbish.mp4", std::string("\0\0\0\x18", 4) + "ftypisom" + std::string(500, 'x'));
  expect_refused(folder_ / "rubbish.mp4", folder_ / "rubbish.mp4", "");
}

TEST_F(VideoFrames, AreReadUpToWhereTheFileIsCutOff) {
  for (const char* container : {"mp4", "avi", "matroska"}) {
    SCOPED_TRACE(container);
    MadeVideo made = film(40);
    made.container = container;
    const std::string whole = tests::video_bytes(made);
    const std::string file = folder_ / ("cut." + std::string(container));
    tests::put(file, whole.substr(0, whole.size() * 3 / 5));
    if (container == std::string("mp4")) {
      // Its index is at its end.
      expect_refused(file, file + "#1", "cut");
      continue;
    }
    FrameReader reader(file);
    int frames = 0;
    const std::string text = tests::expect_error(ErrorKind::unreadable_input, [&] {
      while (reader.next()) ++frames;
    });
    EXPECT_TRUE(tests::has_facts(text, "frame " + std::to_string(frames - 1)));
    EXPECT_GT(frames, 0);
    EXPECT_LT(frames, 40);
    expect_refused(file, file + "#1", "frame");
  }
}

}  // namespace
}  // namespace vegard::fit::video_frames_test
