// Frames out of a tar of PNGs, written by Python's tarfile (tests/data/imagers/make.py).

#include <gtest/gtest.h>

#include <cstdio>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/frame_store.h"
#include "fit/photo/frames/picture_bytes.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_metadata.h"
#include "sim/base/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::tar_frames_test {
namespace {

using sim::ErrorKind;
using tests::expect_words;

const std::string kTar = tests::source_folder() + "/tests/data/imagers/minute.png.tar";

/// A ustar header (POSIX) of a regular file.
std::string header_of(const std::string& name, const std::string& octal_size, const std::string& kind = "0") {
  std::string head(512, '\0');
  const auto put = [&](std::size_t at, const std::string& text) { head.replace(at, text.size(), text); };
  put(0, name);
  put(100, "0000644");
  put(124, octal_size);
  put(136, "00000000000");
  put(148, "        ");
  put(156, kind);
  if (kind != "0") put(157, "other.png");
  put(257, std::string("ustar\0"
                       "00",
                       8));
  unsigned sum = 0;
  for (const char c : head) sum += static_cast<unsigned char>(c);
  char text[8];
  std::snprintf(text, sizeof text, "%06o", sum);
  put(148, std::string(text, 6) + '\0');
  return head;
}

TEST(TarFrames, AreInTheOrderOfTheirTimes) {
  ASSERT_TRUE(is_frame_file(kTar));
  const FrameIndex index = frame_index(kTar);
  ASSERT_EQ(index.frames.size(), 3u);
  for (int f = 0; f < 3; ++f) {
    EXPECT_EQ(index.frames[f].time->utc, "2021-10-30T06:05:0" + std::to_string(3 * f) + ".250000Z");
    EXPECT_EQ(index.frames[f].exposure_s, 0.32);
    const PictureBytes picture = read_picture_bytes(kTar + "#" + std::to_string(f));
    EXPECT_EQ(picture.bytes.substr(1, 3), "PNG");
    const Photo photo = read_photo_of(picture, Decoding::automatic);
    EXPECT_EQ(photo.linear.width, 5);
    EXPECT_EQ(photo.linear.height, 4);
  }
  // The darkest frame is the first by time, and the second in the tar.
  const auto red = [](int f) {
    return read_photo(kTar + "#" + std::to_string(f), Decoding::linear).linear.at(0, 0, 0);
  };
  EXPECT_EQ(red(0), 0.0f);
  EXPECT_FLOAT_EQ(red(1), 100.0f / 255.0f);
  EXPECT_FLOAT_EQ(red(2), 200.0f / 255.0f);
  const sim::PictureMetadata metadata = photo_metadata(kTar + "#2021-10-30T06:05:06Z");
  EXPECT_EQ(metadata.site, "gill");
  EXPECT_EQ(metadata.imager, "rgb-04");
  EXPECT_EQ(metadata.mode, "burst");
  EXPECT_TRUE(tests::has_facts(metadata.sources.header_time, "PNG's name"));
}

TEST(TarFrames, AreRefusedWhereTheTarIsDamaged) {
  tests::TemporaryFolder folder;
  const std::string whole = tests::bytes_of(kTar);
  tests::put(folder / "cut.png.tar", whole.substr(0, 1100));
  expect_words(ErrorKind::unreadable_input, {"cut.png.tar", "damaged"},
               [&] { frame_index(folder / "cut.png.tar"); });
  std::string other = whole;
  other[512 + 1] = 'X';
  expect_words(ErrorKind::unreadable_input, {"it", "is no PNG"}, [&] {
    FrameReader reader(other, "it");
    while (reader.next()) {
    }
  });
  const std::string nothing = header_of("readme.txt", "00000000000") + std::string(1024, '\0');
  expect_words(ErrorKind::unreadable_input, {"it", "no PNG"}, [&] { FrameReader(nothing, "it"); });
}

// A hard (1) or symbolic link (2) holds no picture, and a minute without one frame would look whole.
TEST(TarFrames, LinksAreRefused) {
  const std::string whole = tests::bytes_of(kTar);
  for (const char* kind : {"1", "2"}) {
    const std::string linked = header_of("linked.png", "00000000000", kind) + whole;
    expect_words(ErrorKind::unreadable_input, {"it", "linked.png", "link"},
                 [&] { FrameReader(linked, "it"); });
  }
  const std::string other = header_of("linked.txt", "00000000000", "2") + whole;
  EXPECT_NO_THROW(FrameReader(other, "it"));
}

TEST(TarFrames, MakeNoRoomForWhatAHeaderPromises) {
  const std::string bomb = header_of("a.png", "77777777777") + std::string(1024, '\0');
  expect_words(ErrorKind::unreadable_input, {"it", "claims 8589934591 bytes"},
               [&] { FrameReader(bomb, "it"); });
  const std::string short_one = header_of("a.png", "00100000000") + std::string(1024, '\0');
  expect_words(ErrorKind::unreadable_input, {"it", "damaged"}, [&] {
    FrameReader reader(short_one, "it");
    reader.next();
  });
}

}  // namespace
}  // namespace vegard::fit::tar_frames_test
