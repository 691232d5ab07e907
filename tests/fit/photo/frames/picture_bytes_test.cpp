// A picture by its name: a file, or a frame of one.
#include "fit/photo/frames/picture_bytes.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "fit/photo/frames/frame_name.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_defaults.h"
#include "fit/photo/photo_metadata.h"
#include "sim/base/file/sha256.h"
#include "sim/base/utc_time.h"
#include "tests/support/expect_error.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/frames/gzip_bytes.h"
#include "tests/support/frames/made_frames.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::picture_bytes_test {
namespace {

using sim::ErrorKind;
using tests::expect_words;
using tests::MadeFrames;

class FileOfFrames : public testing::Test {
 protected:
  void SetUp() override {
    tests::put(plain_, tests::frames_bytes());
    tests::put(packed_, tests::gzip_stored(tests::frames_bytes()));
    tests::put(one_, tests::gzip_stored(frame_bytes(MadeFrames(), 0)));
  }
  tests::TemporaryFolder folder_;
  const std::string plain_ = folder_ / "a.pgm", packed_ = folder_ / "a.pgm.gz", one_ = folder_ / "one.pgm.gz";
};

TEST_F(FileOfFrames, HasFramesByNumberAndByTime) {
  for (const std::string& file : {plain_, packed_})
    for (int i = 0; i < 3; ++i) {
      const std::string frame = frame_bytes(MadeFrames(), i);
      const PictureBytes by_number = read_picture_bytes(file + "#" + std::to_string(i));
      EXPECT_EQ(by_number.bytes, frame);
      EXPECT_EQ(by_number.name, name_of_frame(file, i));
      EXPECT_EQ(by_number.frame->number, i);
      const std::string seconds = std::to_string(3 * i + 1);
      const PictureBytes by_time = read_picture_bytes(file + "#2014-03-10T06:03:0" + seconds + "Z");
      EXPECT_EQ(by_time.bytes, frame);
      EXPECT_EQ(by_time.name, by_number.name);
      const Photo photo = read_photo(by_number.name, Decoding::automatic);
      EXPECT_EQ(photo.file_name, std::filesystem::path(by_number.name).filename());
      EXPECT_EQ(photo.sha256, sim::sha256(frame));
      EXPECT_EQ(photo.linear.at(3, 1, 0), static_cast<float>((256 * (i + 1) + 7) / 65535.0));
    }
}

TEST_F(FileOfFrames, IsNoPictureWithoutAFrameChosen) {
  expect_words(ErrorKind::usage, {"a.pgm.gz", "3 frames", "06:03:00.25", "06:03:06.25", "#0 to #2", "--at"},
               [&] { read_photo(packed_, Decoding::automatic); });
  expect_words(ErrorKind::usage, {"no frame 3", "#0 to #2"}, [&] { read_picture_bytes(plain_ + "#3"); });
  expect_words(ErrorKind::unreadable_input, {"2014-03-10T06:04:00Z", "3 frames"},
               [&] { read_picture_bytes(plain_ + "#2014-03-10T06:04:00Z"); });
}

TEST_F(FileOfFrames, WithOneFrameIsAPicture) {
  const Photo photo = read_photo(one_, Decoding::automatic);
  EXPECT_EQ(photo.file_name, "one.pgm.gz");
  EXPECT_EQ(photo.sha256, sim::sha256(tests::bytes_of(one_)));
  EXPECT_EQ(read_picture_bytes(one_ + "#0").name, one_);
  EXPECT_EQ(read_picture_bytes(one_ + "#2014-03-10T06:03:01Z").name, one_);
  expect_words(ErrorKind::unreadable_input, {"no frame"},
               [&] { read_picture_bytes(one_ + "#2014-03-10T06:03:02Z"); });
  expect_words(ErrorKind::usage, {"no frame 1", "#0"}, [&] { read_picture_bytes(one_ + "#1"); });
}

TEST_F(FileOfFrames, IsReadOnceInASeries) {
  PictureSeries series;
  for (const std::string& name :
       {packed_ + "#0", packed_ + "#2", plain_ + "#1", packed_ + "#1", packed_ + "#1", plain_ + "#0",
        plain_ + "#0", one_ + "#0", one_ + "#0", one_}) {
    const PictureBytes one_by_one = read_picture_bytes(name), in_series = series.read(name);
    EXPECT_EQ(in_series.bytes, one_by_one.bytes) << name;
    EXPECT_EQ(in_series.name, one_by_one.name);
    EXPECT_EQ(in_series.words, one_by_one.words);
    EXPECT_EQ(in_series.file_sha256, one_by_one.file_sha256);
  }
  expect_words(ErrorKind::usage, {"no frame 9"}, [&] { series.read(packed_ + "#9"); });
  // What is behind the damage is refused whatever was asked before.
  const std::string cut = folder_ / "cut.pgm", whole = tests::frames_bytes();
  tests::put(cut, whole.substr(0, whole.size() / 2));
  EXPECT_EQ(series.read(cut + "#0").bytes, frame_bytes(MadeFrames(), 0));
  for (const char* frame : {"#1", "#2", "#1"}) EXPECT_THROW(series.read(cut + frame), sim::Error) << frame;
}

TEST_F(FileOfFrames, NamesItsPictures) {
  const std::vector<NamedPicture> all = pictures_in(packed_);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].name, packed_ + "#1");
  EXPECT_EQ(all[1].time->utc, "2014-03-10T06:03:03.250000Z");
  const std::vector<NamedPicture> chosen = pictures_in(packed_ + "#2014-03-10T06:03:03Z");
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0].name, packed_ + "#1");
  EXPECT_EQ(pictures_in(one_)[0].name, one_);
  EXPECT_EQ(pictures_in("nowhere.jpg")[0].name, "nowhere.jpg");
  EXPECT_EQ(stem_of_picture(packed_ + "#1"), "a_0001");
  EXPECT_EQ(stem_of_picture("folder/night.01.fits"), "night.01");
}

// "a#3" is a frame of "a" unless there is a file of that name.
TEST_F(FileOfFrames, GivesWayToAFileOfTheWholeName) {
  const std::string other = plain_ + "#1";
  tests::put(other, "P5 1 1 255\nx");
  EXPECT_EQ(read_picture_bytes(other).bytes, "P5 1 1 255\nx");
  EXPECT_EQ(frame_name(folder_ / "photo#of me.jpg").file, folder_ / "photo#of me.jpg");
  tests::put(folder_ / "b.png", "no PNG");
  expect_words(ErrorKind::usage, {"b.png", "no frames"}, [&] { read_picture_bytes(folder_ / "b.png#0"); });
}

TEST_F(FileOfFrames, TellsOfItselfAsAPhotographDoes) {
  const sim::PictureMetadata metadata = photo_metadata(packed_ + "#1");
  EXPECT_EQ(metadata.header_time_utc, "2014-03-10T06:03:03.250000Z");
  sim::Scene scene;
  const PhotoDefaults taken = with_photo_defaults(scene, metadata);
  EXPECT_EQ(taken.scene.site.time_utc, "2014-03-10T06:03:03.250000Z");
  EXPECT_EQ(taken.scene.site.latitude_deg, 56.3539);
  EXPECT_NEAR(taken.scene.site.longitude_deg, -94.6557, 1e-6);
  EXPECT_EQ(taken.scene.site.altitude_m, 12.5);
  EXPECT_EQ(taken.scene.time.exposure_s, 0.999);
  EXPECT_EQ(taken.scene.camera.width, 4);
}

TEST_F(FileOfFrames, SaysWhereTimesContradictEachOther) {
  const std::string named = folder_ / "20140310_0703_gill_themis19_full.pgm";
  tests::put(named, tests::frames_bytes());
  const sim::PictureMetadata metadata = photo_metadata(named + "#0");
  sim::Scene scene;
  scene.site.time_utc = "2014-03-10T06:03:05Z";
  const auto notes_of = [&](const std::string& of_scene) {
    scene.site.time_utc = of_scene;
    std::string all;
    for (const std::string& note : with_photo_defaults(scene, metadata, {"site.time_utc"}).notes)
      all += note + "\n";
    return all;
  };
  EXPECT_NE(notes_of("2014-03-10T06:03:05Z").find("2014-03-10T07:03:00Z"), std::string::npos);
  EXPECT_NE(notes_of("2014-03-10T06:03:05Z").find("the scene's site.time_utc is 2014-03-10T06:03:05Z"),
            std::string::npos);
  // Within the exposure and a second it is the same moment.
  EXPECT_EQ(notes_of("2014-03-10T06:03:02Z").find("the scene's site.time_utc"), std::string::npos);
}

TEST_F(FileOfFrames, IsNotTheOnlyFileThatIsUnpacked) {
  const std::string fits =
      tests::fits_image(16, {2, 1}, {1, 2}, tests::fits_card("DATE-OBS", "'2015-10-07T08:23:51.743'"));
  tests::put(folder_ / "a.fits", fits);
  tests::put(folder_ / "a.fits.gz", tests::gzip_stored(fits));
  const Photo plain = read_photo(folder_ / "a.fits", Decoding::automatic);
  const Photo packed = read_photo(folder_ / "a.fits.gz", Decoding::automatic);
  EXPECT_EQ(packed.linear.data, plain.linear.data);
  EXPECT_EQ(packed.file_name, "a.fits.gz");
  EXPECT_EQ(packed.sha256, sim::sha256(tests::gzip_stored(fits)));
  EXPECT_EQ(photo_metadata(folder_ / "a.fits.gz").header_time_utc, "2015-10-07T08:23:51.743Z");
  tests::put(folder_ / "cut.fits.gz", tests::gzip_stored(fits).substr(0, 1000));
  expect_words(ErrorKind::unreadable_input, {"cut.fits.gz", "truncated"},
               [&] { read_photo(folder_ / "cut.fits.gz", Decoding::automatic); });
  tests::put(folder_ / "long.fits.gz", tests::gzip_stored(fits + std::string(kMaxUnpackedFits, '\0')));
  expect_words(ErrorKind::unreadable_input, {"long.fits.gz", "larger than 128 MB"},
               [&] { read_photo(folder_ / "long.fits.gz", Decoding::automatic); });
  tests::put(folder_ / "a.jpg.gz", tests::gzip_stored("\xff\xd8"));
  expect_words(ErrorKind::unreadable_input, {"a.jpg.gz", "unpack it"},
               [&] { read_photo(folder_ / "a.jpg.gz", Decoding::automatic); });
}

TEST(FilesOfOtherWriters, AreReadAsTheyWereWritten) {
  // tests/data/imagers/make.py: pixel (x, y) of frame f has 100 f + 10 y + x.
  const std::string folder = tests::source_folder() + "/tests/data/imagers/";
  for (const char* name : {"minute.pgm.gz#1", "frame.fits.gz"}) {
    SCOPED_TRACE(name);
    const Photo photo = read_photo(folder + name, Decoding::automatic);
    ASSERT_EQ(photo.linear.width, 5);
    ASSERT_EQ(photo.linear.height, 4);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 5; ++x)
        EXPECT_NEAR(65535.0 * photo.linear.at(x, y, 0), 100 + 10 * y + x, 1e-2) << x << " " << y;
    EXPECT_EQ(photo_metadata(folder + name).header_time_utc.value_or("").substr(0, 22),
              "2021-10-30T06:05:03.25");
  }
}

/// Where pictures to try the program on are; they are no part of it.
std::string imagers_folder() {
  const char* named = std::getenv("VEGARD_PHOTOS");
  return (named != nullptr ? named : tests::source_folder() + "/../shared/photos") + "/formats/";
}

TEST(FilesOfImagers, AreReadAsTheyAre) {
  const std::string folder = imagers_folder();
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "there are no pictures in " << folder;
  struct Known {
    const char *file, *first, *last, *imager;
    std::size_t frames;
    int width, height;
    double exposure_s, longitude_deg;
  };
  for (const Known& known :
       {Known{"20140310_0603_gill_themis19_full.pgm.gz", "2014-03-10T06:03:00.031212Z",
              "2014-03-10T06:03:57.034815Z", "themis19", 20, 256, 256, 0.999, -94.6557},
        Known{"20140310_0605_gill_themis19_full.pgm", "2014-03-10T06:05:00.058114Z",
              "2014-03-10T06:05:57.063061Z", "themis19", 20, 256, 256, 0.999, -94.6557},
        Known{"20220307_0604_gill_nir-216_8446.pgm.gz", "2022-03-07T06:04:00.000000Z",
              "2022-03-07T06:04:54.000000Z", "nir-216", 10, 256, 256, 5.0, -94.643664},
        Known{"20220308_0604_gill_blue-814_full.pgm.gz", "2022-03-08T06:04:00.193161Z",
              "2022-03-08T06:04:57.182095Z", "blue-814", 20, 320, 270, 2.98952, -94.643664}}) {
    SCOPED_TRACE(known.file);
    const std::string file = folder + known.file;
    const FrameIndex index = frame_index(file);
    ASSERT_EQ(index.frames.size(), known.frames);
    EXPECT_EQ(index.frames.front().time->utc, known.first);
    EXPECT_EQ(index.frames.back().time->utc, known.last);
    const int last = static_cast<int>(known.frames) - 1;
    const sim::PictureMetadata metadata = photo_metadata(name_of_frame(file, last));
    EXPECT_EQ(metadata.imager, known.imager);
    EXPECT_EQ(metadata.site, "gill");
    EXPECT_EQ(metadata.longitude_deg, known.longitude_deg);
    EXPECT_EQ(metadata.exposure_s, known.exposure_s);
    EXPECT_TRUE(metadata.contradictions.empty());
    const Photo photo = read_photo(file + "#" + known.last, Decoding::automatic);
    EXPECT_EQ(photo.file_name, name_of_frame(known.file, last));
    EXPECT_EQ(photo.linear.width, known.width);
    EXPECT_EQ(photo.linear.height, known.height);
  }
}

// The numbers are those of another reader: the mean of the counts, and one pixel.
TEST(FilesOfImagers, HaveThePixelsThatOthersRead) {
  const std::string file = imagers_folder() + "20140310_0604_gill_themis19_full.pgm.gz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "there is no " << file;
  const Photo photo = read_photo(file + "#7", Decoding::automatic);
  double sum = 0.0;
  for (std::size_t i = 0; i < photo.linear.data.size(); i += 3) sum += photo.linear.data[i] * 65535.0;
  EXPECT_NEAR(sum / (256 * 256), 5939.022796630859, 1e-3);
  EXPECT_NEAR(photo.linear.at(100, 50, 1) * 65535.0, 7117, 1e-2);
}

}  // namespace
}  // namespace vegard::fit::picture_bytes_test
