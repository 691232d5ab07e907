#include "apps/output/animation/animation_frames.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace vegard::apps::animation_frames_test {
namespace {

TEST(FrameNames, PutTheNumberWhereTheSignsAre) {
  const FrameNames names("frames/a_####.exr");
  EXPECT_EQ(names.file(7), "frames/a_0007.exr");
  EXPECT_EQ(names.file(9999), "frames/a_9999.exr");
  EXPECT_EQ(names.folder(), "frames");
  EXPECT_EQ(names.pattern(), "a_####.exr");
  EXPECT_EQ(names.companion("animation.json"), "frames/a.animation.json");
  EXPECT_EQ(FrameNames("/####.png").file(3), "/0003.png");
  EXPECT_EQ(FrameNames("##.png").file(3), "03.png");
  EXPECT_EQ(FrameNames("##.png").folder(), ".");
  EXPECT_EQ(FrameNames("in #1/##.png").companion("camera.json"), "in #1/camera.json");
}

TEST(FrameNames, KnowTheirOwnFrames) {
  const FrameNames names("frames/a_####.exr");
  EXPECT_EQ(names.frame_of("a_0012.exr"), 12);
  for (const char* other :
       {"a_012.exr", "a_00012.exr", "a_0012.png", "b_0012.exr", "a_00-1.exr", "a_00 1.exr", "", ".exr"})
    EXPECT_FALSE(names.frame_of(other)) << other;
}

TEST(FrameNames, AreRefusedWithoutExactlyOneRun) {
  for (const char* bad : {"a.exr", "a#/b.exr", "#a#.exr", "#########.exr", ""})
    tests::expect_words(sim::ErrorKind::usage, {"--output", "####"}, [&] { FrameNames names(bad); });
  tests::expect_words(sim::ErrorKind::usage, {"10000", "more #"},
                      [&] { FrameNames("####.exr").check_room_for(10000); });
  EXPECT_NO_THROW(FrameNames("####.exr").check_room_for(9999));
}

TEST(FramesFromWords, AreARangeWithBothEnds) {
  EXPECT_EQ(frames_from_words("3:6"), (std::vector<int>{3, 4, 5, 6}));
  EXPECT_EQ(frames_from_words("0:10:4"), (std::vector<int>{0, 4, 8}));
  EXPECT_EQ(frames_from_words("1200:1200"), (std::vector<int>{1200}));
  for (const char* bad : {"", ":", "3", "3:", ":3", "6:3", "-1:3", "0:3:0", "0:3:-1", "0:3:1:1", "a:b",
                          "0:3 ", "0:1e3", "0:999999999"})
    tests::expect_words(sim::ErrorKind::usage, {"--frames"}, [&] { frames_from_words(bad); });
}

TEST(SceneOfFrame, HasItsTimeInTimeLapseToo) {
  sim::Scene scene;
  scene.time.start_s = 10.0;
  EXPECT_EQ(scene_of_frame(scene, 48, 24.0).time.start_s, 12.0);
  scene.time.lapse = 900.0;
  EXPECT_EQ(scene_of_frame(scene, 48, 24.0).time.start_s, 1810.0);
  EXPECT_EQ(scene_of_frame(scene, 0, 24.0).time.start_s, 10.0);
}

}  // namespace
}  // namespace vegard::apps::animation_frames_test
