// Stars recognised without a guess: 200 fields of the table under cameras drawn at random.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "tests/support/blind_field.h"

namespace vegard::tests::blind_stars_test {
namespace {

// Seed 2026. What is drawn: tests/support/blind_field.h. At least 95 % are to be right and none wrong and
// claimed: a claim is made at an expected 1e-8 false ones a search, so that one would be a mistake of the
// test of chance.
TEST(BlindStarsRecovery, TwoHundredFields) {
  constexpr int kFields = 200;
  int right = 0, wrong = 0;
  double longest_s = 0.0, total_s = 0.0;
  for (std::uint32_t number = 0; number < kFields; ++number) {
    const BlindField field = blind_field(2026, number);
    const auto begin = std::chrono::steady_clock::now();
    const fit::StarRecognition found = fit::recognise_stars(field.points, field.frame);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    longest_s = std::max(longest_s, seconds);
    total_s += seconds;
    if (found.found && is_right(field, found))
      ++right;
    else
      std::printf("field %u: %d stars, %.0f degrees: %s\n", number, field.stars, field.fov_deg,
                  fit::words_of(found).c_str());
    wrong += found.found && !is_right(field, found);
  }
  std::printf("%d of %d right, %d wrong and claimed; %.2f s each, the longest %.2f s\n", right, kFields,
              wrong, total_s / kFields, longest_s);
  EXPECT_GE(right, kFields * 95 / 100);
  EXPECT_EQ(wrong, 0);
  // On a machine that does nothing else; ten times as long for one that does.
  EXPECT_LT(total_s / kFields, 10.0);
}

// Seed 77: points without any sky behind them.
TEST(BlindStarsRecovery, NothingIsClaimedOfChance) {
  for (std::uint32_t number = 0; number < 6; ++number) {
    std::vector<fit::FoundStar> points;
    for (std::uint32_t i = 0; i < 10 + 30 * number; ++i) {
      const sim::Words words = sim::random_words(77, sim::Stream::stars, number, i);
      fit::FoundStar point;
      point.x_px = 1200.0 * sim::uniform(words[0]);
      point.y_px = 800.0 * sim::uniform(words[1]);
      point.flux = 1.0 / (1.0 + i);
      points.push_back(point);
    }
    EXPECT_FALSE(fit::recognise_stars(points, {1200, 800, true}).found) << number;
  }
}

}  // namespace
}  // namespace vegard::tests::blind_stars_test
