// A small share of the calibration, so that all of it stays in order; figures come from the program.
#include <gtest/gtest.h>

#include "sim/base/parallel.h"
#include "tests/recovery/calibration/calibrated_case.h"
#include "tests/recovery/calibration/rank_statistic.h"

namespace vegard::calibration::calibration_test {
namespace {

// 40 truths of set 2. Flat ranks are less even than a probability of 0.001 once in a thousand such
// histograms; there are five. Of so few truths only error bars that are wrong by a factor of two are found.
TEST(ChainCalibration, RanksAreFlatWhereTheModelIsWhatItIsTakenFor) {
  constexpr std::size_t kScenes = 40;
  std::vector<Ranks> all(kScenes);
  sim::parallel_for(kScenes, 0, [&](std::size_t i, int) {
    all[i] = ranks_of_case(2, static_cast<int>(i), Photographs::as_assumed, 100);
  });
  const std::vector<std::string> names = free_numbers_of_calibration();
  for (std::size_t j = 0; j < names.size(); ++j) {
    std::vector<std::size_t> ranks;
    for (const Ranks& of_case : all) {
      ASSERT_EQ(of_case.rank.size(), names.size());
      ranks.push_back(of_case.rank[j]);
    }
    EXPECT_GT(probability_of(histogram_of(ranks)), 0.001) << names[j];
  }
}

}  // namespace
}  // namespace vegard::calibration::calibration_test
