#include "tests/recovery/calibration/rank_statistic.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::calibration::rank_statistic_test {
namespace {

// Of 198 values every second counts: 0, 2, 4, ... of them 25 are below 49.5.
TEST(RankStatistic, CountsThinnedSamplesBelowTheTruth) {
  std::vector<double> series;
  for (int i = 0; i < 198; ++i) series.push_back(i);
  EXPECT_EQ(rank_of(-1.0, series), 0u);
  EXPECT_EQ(rank_of(49.5, series), 25u);
  EXPECT_EQ(rank_of(1000.0, series), kSamples);
}

TEST(RankStatistic, HasTenRanksToABin) {
  const std::array<int, kBins> histogram = histogram_of({0, 9, 10, 55, 90, 99});
  EXPECT_EQ(histogram, (std::array<int, kBins>{2, 1, 0, 0, 0, 1, 0, 0, 0, 2}));
}

// Abramowitz and Stegun, table 26.8: 16.919 and 21.666 of nine degrees, 18.307 of ten.
TEST(RankStatistic, HasTheProbabilitiesOfTables) {
  EXPECT_NEAR(chi2_survival(16.9190, 9), 0.05, 1e-6);
  EXPECT_NEAR(chi2_survival(21.6660, 9), 0.01, 1e-6);
  EXPECT_NEAR(chi2_survival(18.3070, 10), 0.05, 1e-6);
  EXPECT_EQ(chi2_survival(0.0, 9), 1.0);
  EXPECT_EQ(probability_of({10, 10, 10, 10, 10, 10, 10, 10, 10, 10}), 1.0);
  // Bars two thirds as wide as they should be: 2 * 12² / 10 + 8 * 3² / 10 = 36.
  EXPECT_LT(probability_of({22, 7, 7, 7, 7, 7, 7, 7, 7, 22}), 1e-4);
}

}  // namespace
}  // namespace vegard::calibration::rank_statistic_test
