#include "sim/scene/file/closing_line.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::sim::closing_line_test {
namespace {

// A file that is cut after any line is refused, wherever that is; one that somebody has written himself is
// not.
TEST(ClosingLine, OfASceneThatIsCut) {
  Scene scene;
  scene.sheets.emplace_back();
  const std::string whole = write_scene(scene, "a comment\nof two lines");
  EXPECT_NO_THROW(parse_scene(whole, "a.toml"));
  EXPECT_EQ(whole.find("# a comment\n"), whole.find('\n') + 1);
  int cuts = 0;
  for (std::size_t at = whole.find('\n'); at + 1 < whole.size(); at = whole.find('\n', at + 1)) {
    const std::string cut = whole.substr(0, at + 1);
    // The end of the last line may be missing.
    if (at + 6 >= whole.size()) continue;
    ++cuts;
    EXPECT_THROW(parse_scene(cut, "a.toml"), Error)
        << cut.substr(cut.size() - std::min<std::size_t>(80, cut.size()));
  }
  EXPECT_GT(cuts, 100);
  EXPECT_NO_THROW(parse_scene(whole.substr(0, whole.size() - 1), "a.toml"));
  EXPECT_NO_THROW(parse_scene("[camera]\nhfov_deg = 40\n", "a.toml"));
  // Keys may be added behind it.
  EXPECT_NO_THROW(parse_scene(with_closing_line("seed = 2\n") + "[camera]\nhfov_deg = 40\n", "a.toml"));
}

}  // namespace
}  // namespace vegard::sim::closing_line_test
