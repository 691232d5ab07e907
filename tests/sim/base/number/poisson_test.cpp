// Seed 7 throughout; tolerances are four standard errors of what is measured.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "sim/base/number/distributions.h"

namespace vegard::sim::poisson_test {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr int kNumbers = 200000;

std::vector<double> numbers(double mean, std::uint32_t k = 0) {
  std::vector<double> result(kNumbers);
  for (int i = 0; i < kNumbers; ++i) result[i] = poisson(mean, kSeed, Stream::photon_noise, i, 3, k);
  return result;
}

double probability(double mean, double k) {
  return std::exp(k * std::log(mean) - mean - std::lgamma(k + 1.0));
}

class PoissonOfMean : public ::testing::TestWithParam<double> {};

TEST_P(PoissonOfMean, HasItsMomentsAndItsHistogram) {
  const double mean = GetParam();
  const std::vector<double> drawn = numbers(mean);
  double sum = 0.0, squares = 0.0;
  std::map<double, int> histogram;
  for (const double number : drawn) {
    ASSERT_EQ(number, std::floor(number));
    ASSERT_GE(number, 0.0);
    sum += number - mean;
    squares += (number - mean) * (number - mean);
    ++histogram[number];
  }
  EXPECT_NEAR(sum / kNumbers, 0.0, 4.0 * std::sqrt(mean / kNumbers));
  // Fourth central moment 3 m^2 + m, so the variance's own variance is (2 m^2 + m) / n.
  EXPECT_NEAR(squares / kNumbers, mean, 4.0 * std::sqrt((2.0 * mean * mean + mean) / kNumbers));

  // Bins of at least 20 expected numbers; what lies in the tails is one bin more.
  double chi2 = 0.0, expected_in_bin = 0.0, expected_so_far = 0.0;
  int found_in_bin = 0, found_so_far = 0, bins = 0;
  const double last = mean + 12.0 * std::sqrt(mean) + 20.0;
  for (double k = 0.0; k <= last; k += 1.0) {
    const auto found = histogram.find(k);
    expected_in_bin += kNumbers * probability(mean, k);
    found_in_bin += found == histogram.end() ? 0 : found->second;
    if (expected_in_bin < 20.0) continue;
    chi2 += (found_in_bin - expected_in_bin) * (found_in_bin - expected_in_bin) / expected_in_bin;
    expected_so_far += expected_in_bin, found_so_far += found_in_bin;
    expected_in_bin = 0.0, found_in_bin = 0, ++bins;
  }
  const double tail = kNumbers - expected_so_far, in_tail = kNumbers - found_so_far;
  if (tail > 5.0) chi2 += (in_tail - tail) * (in_tail - tail) / tail, ++bins;
  const double freedom = bins - 1;
  ASSERT_GE(freedom, 1.0);
  EXPECT_NEAR(chi2, freedom, 4.0 * std::sqrt(2.0 * freedom));
}

// Both sides of 10, where one way of drawing gives place to the other.
INSTANTIATE_TEST_SUITE_P(Means, PoissonOfMean,
                         ::testing::Values(0.05, 0.7, 4.0, 9.99, 10.0, 13.5, 80.0, 3000.0));

TEST(Poisson, LargeMeansHaveTheirSpread) {
  for (const double mean : {2e5, 3e7}) {
    double sum = 0.0, squares = 0.0;
    for (const double number : numbers(mean)) {
      sum += number - mean;
      squares += (number - mean) * (number - mean);
    }
    EXPECT_NEAR(sum / kNumbers, 0.0, 4.0 * std::sqrt(mean / kNumbers));
    EXPECT_NEAR(squares / kNumbers / mean, 1.0, 4.0 * std::sqrt(2.0 / kNumbers));
  }
}

TEST(Poisson, NothingGivesNothing) { EXPECT_EQ(poisson(0.0, kSeed, Stream::photon_noise, 1, 2, 3), 0.0); }

TEST(Poisson, NumbersOfOnePlaceAreIndependent) {
  const double mean = 50.0;
  const std::vector<double> a = numbers(mean, 0), b = numbers(mean, 1);
  double sum = 0.0;
  for (int i = 0; i < kNumbers; ++i) sum += (a[i] - mean) * (b[i] - mean);
  EXPECT_NEAR(sum / kNumbers / mean, 0.0, 4.0 / std::sqrt(kNumbers));
}

}  // namespace
}  // namespace vegard::sim::poisson_test
