#include "fit/measurement/together/measure_together.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "sim/base/error.h"

namespace vegard::fit::measure_together_test {
namespace {

PairHeight height(double km, double error_km) { return {km, error_km, true, 20, {}, false}; }

TEST(MeasureTogether, DoubtsPairsThatContradictEachOther) {
  EXPECT_FALSE(contradict({}));
  EXPECT_FALSE(contradict({height(105.0, 2.0)}));
  // Three standard deviations of the difference: 3 · hypot(3, 4) = 15 km.
  EXPECT_FALSE(contradict({height(105.0, 3.0), height(119.9, 4.0)}));
  EXPECT_TRUE(contradict({height(105.0, 3.0), height(120.1, 4.0)}));
  EXPECT_TRUE(contradict({height(105.0, 3.0), height(110.0, 3.0), height(88.0, 3.0)}));
}

TEST(MeasureTogether, TellsOfFilesThatAreNotThereBeforeItWrites) {
  TogetherRequest request;
  request.out = testing::TempDir() + "/measure_together_test";
  std::filesystem::remove_all(request.out);
  request.pictures.resize(2);
  for (MeasureRequest& picture : request.pictures) {
    picture.photo = testing::TempDir() + "/no_such_picture.png";
    picture.time = "2014-02-21T19:30:40Z";
  }
  try {
    measure_together(request);
    FAIL() << "there is no picture";
  } catch (const sim::Error& error) {
    EXPECT_EQ(error.kind(), sim::ErrorKind::unreadable_input);
    EXPECT_NE(std::string(error.what()).find("no_such_picture.png"), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::exists(request.out));
}

}  // namespace
}  // namespace vegard::fit::measure_together_test
