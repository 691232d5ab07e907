#include "sim/base/error.h"

#include <gtest/gtest.h>

namespace vegard::sim::error_test {

TEST(Error, HasThePartsThatItWasGivenByName) {
  try {
    throw Error(ErrorKind::scene, "unknown key 'widht'")
        .file("scene.toml")
        .line(7)
        .key("camera")
        .expected("a key of the table")
        .hint("did you mean 'width'?");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_EQ(error.details().line, 7);
    EXPECT_STREQ(
        error.what(),
        "scene.toml:7: camera: unknown key 'widht' (expected a key of the table); did you mean 'width'?");
  }
}

TEST(Error, CanBeThrownAgainWithOtherParts) {
  const Error caught = Error(ErrorKind::scene, "is empty").file("scene.toml").key("fit.roi_px");
  const Error again = Error(caught).kind(ErrorKind::usage).problem("has nothing").key("--roi");
  EXPECT_EQ(again.kind(), ErrorKind::usage);
  EXPECT_STREQ(again.what(), "scene.toml: --roi: has nothing");
  EXPECT_EQ(caught.kind(), ErrorKind::scene);
  EXPECT_STREQ(caught.what(), "scene.toml: fit.roi_px: is empty");
}

TEST(Error, LeavesOutWhatNobodyKnows) {
  EXPECT_STREQ(Error(ErrorKind::usage, "too many files").what(), "too many files");
}

}  // namespace vegard::sim::error_test
