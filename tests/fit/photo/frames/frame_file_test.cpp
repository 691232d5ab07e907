#include "fit/photo/frames/frame_file.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/frames/gzip_bytes.h"
#include "tests/support/frames/made_frames.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::frame_file_test {
namespace {

using tests::expect_words;
using tests::gzip_stored;
using tests::MadeFrames;

TEST(FrameReader, GivesOneFrameAfterAnother) {
  const MadeFrames made;
  const std::string file = frames_bytes(made);
  for (const std::string& bytes : {file, gzip_stored(file)}) {
    FrameReader reader(bytes, "it");
    EXPECT_EQ(reader.is_packed(), bytes != file);
    std::uint64_t offset = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_TRUE(reader.next());
      const std::string frame = frame_bytes(made, i);
      EXPECT_EQ(reader.head().number, static_cast<int>(i));
      EXPECT_EQ(reader.head().width_px, 4);
      EXPECT_EQ(reader.head().height_px, 2);
      EXPECT_EQ(reader.head().offset, offset);
      EXPECT_EQ(reader.head().bytes, frame.size());
      EXPECT_EQ(reader.head().exposure_s, 0.999);
      EXPECT_EQ(reader.head().time->utc, "2014-03-10T06:03:0" + std::to_string(3 * i) + ".250000Z");
      EXPECT_EQ(imager_metadata(reader.words(), 4, 2).imager, "themis19");
      // One that is not asked for is passed over.
      if (i != 1) {
        EXPECT_EQ(reader.take(), frame);
      }
      offset += frame.size();
    }
    EXPECT_FALSE(reader.next());
    EXPECT_FALSE(reader.next());
  }
}

TEST(FrameReader, TakesWhatIsNotAboveALimitOfHeaders) {
  const std::string remark = "#" + std::string(60000, 'x') + "\n";
  const std::string frame = "P5\n" + remark + "1 1\n255\na";
  FrameReader sound(frame, "it");
  EXPECT_TRUE(sound.next());
  const std::string longer = "P5\n" + remark + remark + "1 1\n255\na";
  expect_words(sim::ErrorKind::unreadable_input, {"it", "frame 0", "64 kB"}, [&] {
    FrameReader reader(longer, "it");
    reader.next();
  });
}

/// Goes through all of it.
void refused(const std::string& bytes, const std::vector<std::string>& words) {
  for (const bool takes : {false, true})
    expect_words(sim::ErrorKind::unreadable_input, words, [&] {
      FrameReader reader(bytes, "it");
      while (reader.next())
        if (takes) reader.take();
    });
}

TEST(FrameReader, RefusesWhatIsCutShort) {
  const MadeFrames made;
  const std::string file = frames_bytes(made);
  const std::size_t first = frame_bytes(made, 0).size();
  refused(file.substr(0, first - 1), {"it", "truncated", "16 bytes", "15 are there"});
  refused(file.substr(0, file.size() - 5), {"it", "truncated", "16 bytes", "11 are there", "frame 2"});
  refused(file.substr(0, first + 10), {"it#1", "truncated"});
  const std::string packed = gzip_stored(file);
  refused(packed.substr(0, packed.size() - 5), {"it", "truncated"});
}

TEST(FrameReader, RefusesWhatIsNoFrame) {
  const std::string file = tests::frames_bytes();
  refused("GIF89a", {"it", "no frames in it"});
  refused("", {"it", "no frames in it"});
  refused(gzip_stored("SIMPLE  ="), {"it", "no frames in it"});
  refused(file + "P7", {"it", "behind its frame 2", "something else"});
  const std::string one = frame_bytes(MadeFrames(), 0);
  refused(gzip_stored(one + "x"), {"it", "behind its frame 0"});
  // Behind the only picture of a plain file anything may stand.
  const std::string with_more = one + "x";
  FrameReader single(with_more, "it");
  EXPECT_TRUE(single.next());
  EXPECT_FALSE(single.next());
}

TEST(FrameReader, RefusesFramesOutOfOrder) {
  MadeFrames made;
  made.seconds = {0.0, 6.0, 3.0};
  refused(frames_bytes(made), {"it", "frame 2", "out of order", "06:03:03.000000Z", "frame 1", "06:03:06"});
  made.seconds = {0.0, 3.0, 3.0};
  const std::string alike = frames_bytes(made);
  FrameReader reader(alike, "it");
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(reader.next());
}

TEST(FrameReader, RefusesWordsOfAnotherPicture) {
  MadeFrames made;
  made.options = "WIDTH=512 HEIGHT=256 XBIN=2 YBIN=1";
  refused(frames_bytes(made), {"it", "frame 0", "4 x 2 pixels", "WIDTH=512"});
}

TEST(FrameReader, RefusesFramesOfAnotherSize) {
  const MadeFrames made;
  refused(frame_bytes(made, 0) + "P5 2 1 65535\nabcd", {"it", "frame 1", "2 x 1 pixels", "the first 4 x 2"});
  refused(frame_bytes(made, 0) + "P6 4 2 255\n" + std::string(24, 'a'), {"it", "frame 1", "colours"});
}

TEST(FrameReader, AsksForNoRoomByWhatAHeaderPromises) {
  refused("P5 16384 16385 255\n", {"it", "16384 x 16385", "2^28"});
  refused(gzip_stored("P5 8192 4097 255\n"), {"it", "8192 x 4097", "packed"});
  refused("P5 16384 16384 65535\nabc", {"it", "truncated", "3 are there"});
  std::string many;
  for (int i = 0; i <= kMaxFrames; ++i) many += "P5 1 1 255\na";
  refused(many, {"it", "more than 100000 frames"});
}

TEST(FrameIndex, HasAllFrames) {
  const tests::TemporaryFolder folder;
  const std::string file = tests::frames_bytes();
  for (const std::string& bytes : {file, gzip_stored(file)}) {
    tests::put(folder / "it", bytes);
    EXPECT_TRUE(is_frame_file(folder / "it"));
    const FrameIndex index = frame_index(folder / "it");
    ASSERT_EQ(index.frames.size(), 3u);
    EXPECT_EQ(index.is_packed, bytes != file);
    EXPECT_EQ(index.frames[2].time->utc, "2014-03-10T06:03:06.250000Z");
    EXPECT_EQ(index.frames[2].offset + index.frames[2].bytes, file.size());
    EXPECT_EQ(index.words.front().second, "themis19");
  }
  tests::put(folder / "it", "P2 1 1 255 7");
  EXPECT_FALSE(is_frame_file(folder / "it"));
  EXPECT_FALSE(is_frame_file(folder / "none"));
  tests::put(folder / "it", "P5 1 1 255 7P5 2 2 255\nabc");
  expect_words(sim::ErrorKind::unreadable_input, {"it"}, [&] { frame_index(folder / "it"); });
}

}  // namespace
}  // namespace vegard::fit::frame_file_test
