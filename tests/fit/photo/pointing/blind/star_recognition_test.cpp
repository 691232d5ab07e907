#include "fit/photo/pointing/blind/star_recognition.h"

#include <gtest/gtest.h>

#include "sim/base/number/random.h"
#include "tests/support/blind_field.h"

namespace vegard::tests::star_recognition_test {
namespace {

/// Points strewn over the frame at random.
std::vector<fit::FoundStar> strewn(int count, std::uint64_t seed) {
  std::vector<fit::FoundStar> points;
  for (int i = 0; i < count; ++i) {
    const sim::Words words = sim::random_words(seed, sim::Stream::stars, i);
    fit::FoundStar point;
    point.x_px = 1200.0 * sim::uniform(words[0]);
    point.y_px = 800.0 * sim::uniform(words[1]);
    point.flux = 1.0 / (1.0 + i);
    points.push_back(point);
  }
  return points;
}

// Seed 2026; all 200 of tests/recovery/blind_stars_test.cpp are slow.
TEST(StarRecognition, FindsFieldsOfEveryLens) {
  for (std::uint32_t number = 0; number < 8; ++number) {
    const BlindField field = blind_field(2026, number);
    const fit::StarRecognition found = fit::recognise_stars(field.points, field.frame);
    EXPECT_TRUE(found.found) << number;
    EXPECT_TRUE(is_right(field, found)) << number;
  }
}

TEST(StarRecognition, ClaimsNothingOfPointsStrewnAtRandom) {
  fit::RecognitionSettings settings;
  settings.off_centre = false;
  for (const int count : {8, 25, 60}) {
    const fit::StarRecognition found =
        fit::recognise_stars(strewn(count, 5 + count), {1200, 800, true}, settings);
    EXPECT_FALSE(found.found) << count;
    EXPECT_NE(fit::words_of(found).find("What would help"), std::string::npos);
  }
}

TEST(StarRecognition, NeedsFivePoints) {
  const fit::StarRecognition found = fit::recognise_stars(strewn(4, 1), {1200, 800, true});
  EXPECT_FALSE(found.found);
  EXPECT_NE(fit::words_of(found).find("five at least"), std::string::npos);
}

TEST(StarRecognition, GivesTheSameAnswerAgain) {
  const BlindField field = blind_field(2026, 1);
  const fit::StarRecognition one = fit::recognise_stars(field.points, field.frame);
  const fit::StarRecognition other = fit::recognise_stars(field.points, field.frame);
  EXPECT_EQ(one.best.camera.numbers, other.best.camera.numbers);
  EXPECT_EQ(one.best.agreement.log10_false, other.best.agreement.log10_false);
}

}  // namespace
}  // namespace vegard::tests::star_recognition_test
