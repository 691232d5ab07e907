// What a scene may not ask of a loop.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/bad_scene.h"

namespace vegard::sim::loop_check_test {
namespace {

std::string loop(const std::string& more) {
  return "[emission]\nlines = [17.1]\n[sun]\nshown = true\n[[loop]]\nname = \"a\"\nrayleigh = "
         "[1]\n" +
         more;
}

TEST(LoopCheck, AGoodLoopIsRead) {
  const Scene scene = parse_scene(loop("voxel = 0.5\nblur = 1\nsharpen = 2\n"), "a.toml");
  EXPECT_EQ(scene.loops.at(0).voxel, 0.5);
}

TEST(LoopCheck, RefusesFeetOffTheSun) {
  EXPECT_EQ(error_of(loop("width = 1400\n")).key, "loop.a.width");
  EXPECT_EQ(error_of(loop("width = 1000\nspread = 600\n")).key, "loop.a.width");
}

TEST(LoopCheck, RefusesVoxelsThatMissStrands) {
  EXPECT_EQ(error_of(loop("voxel = 1.01\n")).key, "loop.a.voxel");
}

TEST(LoopCheck, RefusesFiltersWithoutAGrid) {
  EXPECT_EQ(error_of(loop("blur = 1\n")).key, "loop.a.blur");
  EXPECT_EQ(error_of(loop("sharpen = 1\n")).key, "loop.a.sharpen");
}

TEST(LoopCheck, RefusesHeatingThatNobodyCouldShow) {
  EXPECT_EQ(parse_scene(loop("heating_interval_s = 500\n"), "a.toml").loops.at(0).heating_interval_s, 500.0);
  EXPECT_EQ(error_of(loop("heating_interval_s = 0.5\n")).key, "loop.a.heating_interval_s");
  EXPECT_EQ(error_of(loop("heating_interval_s = 500\nvoxel = 0.5\n")).key, "loop.a.heating_interval_s");
}

}  // namespace
}  // namespace vegard::sim::loop_check_test
