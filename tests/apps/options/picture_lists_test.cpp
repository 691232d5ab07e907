// Where a keogram's times come from.
#include "apps/options/picture_lists.h"

#include <gtest/gtest.h>

#include "tests/support/exif_bytes.h"
#include "tests/support/expect_error.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/frames/gzip_bytes.h"
#include "tests/support/frames/made_frames.h"
#include "tests/support/frames/made_video.h"
#include "tests/support/temporary_folder.h"

namespace vegard::apps::picture_lists_test {
namespace {

using M = tests::ExifMaker;
using Kind = fit::PictureTimes::Kind;

std::string jpeg_taken(const std::string& clock, const std::string& offset = {}) {
  M maker;
  maker.text(M::kExif, 36867, clock);
  if (!offset.empty()) maker.text(M::kExif, 36881, offset);
  return tests::jpeg_with_exif(1, 1, maker.bytes());
}

std::string fits_taken(const std::string& time) {
  return tests::fits_image(16, {2, 1}, {1, 2}, tests::fits_card("DATE-OBS", "'" + time + "'"));
}

class PictureTimesOf : public testing::Test {
 protected:
  TimedPictures of(const std::vector<std::pair<std::string, std::string>>& pictures) const {
    std::vector<std::string> files;
    for (const auto& [name, bytes] : pictures) {
      tests::put(folder_ / name, bytes);
      files.push_back(folder_ / name);
    }
    return timed_pictures(files, {});
  }
  tests::TemporaryFolder folder_;
};

TEST_F(PictureTimesOf, FilesThatTellThemInUtcAreBelievedBeforeTheirNames) {
  const TimedPictures found = of({{"sky_20140221_193000.jpg", jpeg_taken("2014:02:21 21:00:10", "+01:00")},
                                  {"sky_20140221_193010.fits", fits_taken("2014-02-21T20:00:00.5")}});
  EXPECT_EQ(found.times.kind, Kind::utc);
  EXPECT_EQ(found.times.source, "the files' own (EXIF; FITS DATE-OBS)");
  EXPECT_EQ(found.times.seconds, (std::vector<double>{1393012800.5, 1393012810.0}));
  EXPECT_EQ(found.files[0], folder_ / "sky_20140221_193010.fits");
}

TEST_F(PictureTimesOf, NamesAreTakenWhereNotAllFilesTell) {
  const TimedPictures found = of({{"sky_20140221_193000.jpg", jpeg_taken("2014:02:21 21:00:10", "+01:00")},
                                  {"sky_20140221_193010.jpg", jpeg_taken("2014:02:21 21:00:20")}});
  EXPECT_EQ(found.times.source, "the files' names, taken for UTC");
  EXPECT_EQ(found.times.seconds, (std::vector<double>{1393011000.0, 1393011010.0}));
}

// A burst within a second of the clock: the names have more of it.
TEST_F(PictureTimesOf, NamesAreTakenWhereTwoFilesTellTheSame) {
  const TimedPictures found =
      of({{"sky_20140221_193000.25.jpg", jpeg_taken("2014:02:21 19:30:00", "+00:00")},
          {"sky_20140221_193000.75.jpg", jpeg_taken("2014:02:21 19:30:00", "+00:00")}});
  EXPECT_EQ(found.times.seconds, (std::vector<double>{1393011000.25, 1393011000.75}));
}

TEST_F(PictureTimesOf, AClockOfNoZoneCountsFromTheFirst) {
  const TimedPictures found =
      of({{"b.jpg", jpeg_taken("2014:03:01 00:00:02")}, {"a.jpg", jpeg_taken("2014:02:28 23:59:57")}});
  EXPECT_EQ(found.times.kind, Kind::clock);
  EXPECT_EQ(found.times.seconds, (std::vector<double>{0.0, 5.0}));
  EXPECT_EQ(found.files[0], folder_ / "a.jpg");
  EXPECT_NE(found.times.source.find("from 2014-02-28T23:59:57 on"), std::string::npos) << found.times.source;
}

TEST_F(PictureTimesOf, NumbersWhereSomeTellNothing) {
  const TimedPictures found = of(
      {{"b.jpg", jpeg_taken("2014:03:01 00:00:02", "+00:00")}, {"a.jpg", tests::jpeg_of_blocks(1, 1, {90})}});
  EXPECT_EQ(found.times.kind, Kind::number);
  EXPECT_EQ(found.files[0], folder_ / "b.jpg");
}

TEST_F(PictureTimesOf, ATableGoesBeforeAll) {
  of({{"b.jpg", jpeg_taken("2014:03:01 00:00:02", "+00:00")},
      {"a.jpg", jpeg_taken("2014:03:01 00:00:01", "+00:00")}});
  tests::put(folder_ / "times.csv", "b.jpg,1\na.jpg,2\n");
  const TimedPictures found =
      timed_pictures({folder_ / "a.jpg", folder_ / "b.jpg"}, {folder_ / "times.csv", {}, {}});
  EXPECT_EQ(found.times.seconds, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(found.files[0], folder_ / "b.jpg");
}

// A file of frames is all of them, and one of them where it is chosen.
TEST_F(PictureTimesOf, FramesTellTheirOwn) {
  const TimedPictures all = of({{"a.pgm.gz", tests::gzip_stored(tests::frames_bytes())}});
  const std::string file = folder_ / "a.pgm.gz";
  EXPECT_EQ(all.files, (std::vector<std::string>{file + "#0", file + "#1", file + "#2"}));
  EXPECT_EQ(all.times.kind, Kind::utc);
  EXPECT_EQ(all.times.source, "the files' own (PGM comment \"Image request start\")");
  EXPECT_NEAR(all.times.seconds[0], 1394431380.25, 1e-6);
  EXPECT_EQ(all.times.seconds[2] - all.times.seconds[0], 6.0);
  const TimedPictures two = timed_pictures({file + "#2", file + "#2014-03-10T06:03:01Z"}, {});
  EXPECT_EQ(two.files, (std::vector<std::string>{file + "#0", file + "#2"}));
  EXPECT_EQ(two.times.seconds[1] - two.times.seconds[0], 6.0);
  tests::put(folder_ / "list.txt", "a.pgm.gz 5\n");
  tests::expect_error(sim::ErrorKind::usage, [&] { listed_photos({folder_ / "list.txt"}, "--photos"); });
}

TEST_F(PictureTimesOf, FramesOfASequenceAreAtTheirSeconds) {
  of({{"a.pgm.gz", tests::gzip_stored(tests::frames_bytes())}});
  tests::put(folder_ / "b.pgm", "P5 1 1 255\nx");
  const std::string file = folder_ / "a.pgm.gz";
  sim::Scene scene;
  scene.time.start_s = 10.0;
  scene.time.frames_per_second = 2.0;
  const std::vector<SequencePhoto> frames = sequence_photos({file}, scene);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1].name, "a_0001");
  EXPECT_EQ(frames[1].time_s, 13.0);
  // With a picture among them that tells no time, they follow each other as the scene has it.
  const std::vector<SequencePhoto> mixed = sequence_photos({file, folder_ / "b.pgm"}, scene);
  EXPECT_EQ(mixed[1].time_s, 10.5);
  EXPECT_EQ(mixed[3].name, "b");
}

TEST_F(PictureTimesOf, AFilmAreByItsClockFromAStartItsNameOrItsFirstFrame) {
  tests::MadeVideo made;
  made.times_ms = {0, 500, 2000};
  made.codes = [](int) { return std::array<int, 3>{100, 128, 128}; };
  const std::string bytes = tests::video_bytes(made);
  const TimedPictures plain = of({{"film.mp4", bytes}});
  EXPECT_EQ(plain.times.kind, Kind::clock);
  EXPECT_EQ(plain.files[1], folder_ / "film.mp4#1");
  const std::vector<double> seconds = {0.0, 0.5, 2.0};
  EXPECT_EQ(plain.times.seconds, seconds);
  const TimedPictures named = of({{"sky_20140221_193000.mp4", bytes}});
  EXPECT_EQ(named.times.kind, Kind::utc);
  EXPECT_EQ(named.times.seconds, (std::vector<double>{1393011000.0, 1393011000.5, 1393011002.0}));
  const TimedPictures started = timed_pictures({folder_ / "film.mp4"}, {"", 1393011000.0, {}});
  EXPECT_EQ(started.times.seconds, named.times.seconds);
  made.words = {{"creation_time", "2014-02-21T19:30:00Z"}};
  const TimedPictures clocked = of({{"film.mp4", tests::video_bytes(made)}});
  EXPECT_EQ(clocked.times.kind, Kind::clock);
  EXPECT_EQ(clocked.times.seconds, seconds);
  EXPECT_TRUE(tests::has_facts(clocked.times.source, "creation_time | 2014-02-21T19:30:00"));
}

TEST_F(PictureTimesOf, AFolderAreByStartAndStep) {
  for (const char* name : {"b.png", "a.png", "c.PNG", "notes.txt"}) tests::put(folder_ / name, "");
  const std::string folder =
      std::string(folder_ / "a.png").substr(0, std::string(folder_ / "a.png").rfind('/'));
  const TimedPictures found = timed_pictures({folder}, {"", 1393011000.0, 10.0});
  EXPECT_EQ(found.files.size(), 3u);
  EXPECT_EQ(found.files[0], folder_ / "a.png");
  EXPECT_EQ(found.times.seconds, (std::vector<double>{1393011000.0, 1393011010.0, 1393011020.0}));
  tests::expect_error(sim::ErrorKind::usage, [&] { timed_pictures({folder}, {"", 1393011000.0, {}}); });
  tests::expect_error(sim::ErrorKind::usage, [&] { timed_pictures({folder}, {"t.csv", {}, 10.0}); });
}

}  // namespace
}  // namespace vegard::apps::picture_lists_test
