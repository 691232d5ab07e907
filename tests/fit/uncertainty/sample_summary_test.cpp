#include "fit/uncertainty/band_bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::fit::sample_summary_test {
namespace {

// 0, 1, ..., 1000, and a falling line of them.
TEST(SampleSummary, OfAnEvenSpread) {
  std::vector<double> samples;
  for (int i = 0; i <= 1000; ++i) {
    samples.push_back((i * 10) % 1001);  // every place once, out of order: 10 and 1001 share no factor
    samples.push_back(-2.0 * samples.back() + 3.0);
  }
  const SampleSummary s = summary_of_samples(samples, 2);
  EXPECT_NEAR(s.mean[0], 500.0, 1e-9);
  EXPECT_NEAR(s.median[0], 500.0, 1e-9);
  EXPECT_NEAR(s.mean[1], -997.0, 1e-9);
  EXPECT_NEAR(s.sigma[0], std::sqrt(1001.0 * 1002.0 / 12.0), 1e-9);  // of n whole numbers: n (n + 1) / 12
  EXPECT_NEAR(s.correlation[0][1], -1.0, 1e-12);
  EXPECT_NEAR(s.interval68[0].first, 158.655, 1e-3);
  EXPECT_NEAR(s.interval68[0].second, 841.345, 1e-3);
  EXPECT_NEAR(s.interval95[1].first, 3.0 - 2.0 * 977.250, 2e-3);
}

TEST(SampleSummary, PercentilesLieBetweenNeighbours) {
  EXPECT_DOUBLE_EQ(percentile({1.0, 2.0, 4.0}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(percentile({1.0, 2.0, 4.0}, 0.75), 3.0);
  EXPECT_DOUBLE_EQ(percentile({1.0, 2.0, 4.0}, 1.0), 4.0);
}

TEST(SampleSummary, OfTooFewIsEmpty) {
  EXPECT_TRUE(summary_of_samples({1.0, 2.0}, 2).mean.empty());
  EXPECT_TRUE(summary_of_samples({}, 0).mean.empty());
  EXPECT_EQ(summary_of_samples({1.0, 1.0}, 1).correlation[0][0], 0.0);
}

}  // namespace
}  // namespace vegard::fit::sample_summary_test
