// Factors and extinctions out of stars that were made with both.
#include "fit/photo/rayleigh/factor_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "tests/support/star_field.h"

namespace vegard::fit::factor_fit_test {
namespace {

constexpr double kFactor = 25.0, kDepth = 0.25;

/// `count` stars between 20 degrees and the zenith, some with a signal of 5, some of 200; each is off by a
/// scatter of 6 % of its own.
std::vector<FactorDatum> made_stars(int count, std::uint64_t seed, double scatter = 0.06) {
  std::vector<FactorDatum> stars;
  for (int i = 0; i < count; ++i) {
    const double airmass = 1.0 + 1.9 * (i % 7) / 6.0;
    const double truth = std::exp(-kDepth * airmass) / kFactor;
    const double sigma = truth / (5.0 * std::pow(40.0, (i * 5 % count) / (count - 1.0)));
    const auto number = static_cast<std::uint32_t>(i);
    stars.push_back(
        {truth * (1.0 + scatter * tests::normal(seed, number, 1)) + sigma * tests::normal(seed, number, 2),
         sigma, airmass});
  }
  return stars;
}

TEST(FactorFit, FindsWhatWasMade) {
  const auto fit = fit_factor(made_stars(30, 1, 0.0), std::nullopt);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->ln_factor, std::log(kFactor), 4.0 * fit->ln_factor_error);
  EXPECT_NEAR(fit->depth, kDepth, 4.0 * fit->depth_error);
  EXPECT_LT(fit->ln_factor_error, 0.03);
  EXPECT_LT(fit->correlation, -0.5);  // a smaller factor with more air
  EXPECT_EQ(fit->degrees_of_freedom, 28);
  const auto held = fit_factor(made_stars(30, 1, 0.0), kDepth);
  ASSERT_TRUE(held);
  EXPECT_EQ(held->depth, kDepth);
  EXPECT_LT(held->ln_factor_error, 0.5 * fit->ln_factor_error);
}

/// How often the truth lies within the 68 % interval, how far the answers lie off on average in their errors,
/// and how far off the scatter is.
struct Coverage {
  int within = 0, depth_within = 0;
  double mean_off = 0.0, scatter = 0.0;
};
Coverage coverage(int stars, int seeds, std::optional<double> depth) {
  Coverage found;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto fit = fit_factor(made_stars(stars, 100 + static_cast<std::uint64_t>(seed)), depth);
    if (!fit) continue;
    const double interval = student_68(fit->degrees_of_freedom);
    const double off = (fit->ln_factor - std::log(kFactor)) / fit->ln_factor_error;
    found.within += std::abs(off) < interval ? 1 : 0;
    if (!depth) found.depth_within += std::abs(fit->depth - kDepth) < interval * fit->depth_error ? 1 : 0;
    found.mean_off += off / seeds;
    found.scatter += fit->scatter / seeds;
  }
  return found;
}

TEST(FactorFit, HasIntervalsThatHold) {
  // Seeds 100 to 499. Of 400 independent answers 273 ± 9.3 lie within a true 68.3 % interval; three
  // deviations, and two of 100 for what weights that were found themselves and an outlier's limit do. The
  // mean is off by at most three times 1 / sqrt(400).
  for (const bool is_held : {false, true}) {
    const Coverage found = coverage(25, 400, is_held ? std::optional<double>(kDepth) : std::nullopt);
    EXPECT_NEAR(found.within, 273, 36) << is_held;
    if (!is_held) {
      EXPECT_NEAR(found.depth_within, 273, 36);
    }
    EXPECT_NEAR(found.mean_off, 0.0, 0.15) << is_held;
    EXPECT_NEAR(found.scatter, 0.06, 0.012) << is_held;
  }
}

TEST(FactorFit, LeavesOutWhatIsNoSuchStar) {
  std::vector<FactorDatum> stars = made_stars(30, 3);
  const double sound = fit_factor(stars, std::nullopt)->ln_factor;
  stars[4].rate_per_rayleigh *= 3.0;    // a planet beside it
  stars[11].rate_per_rayleigh *= 0.05;  // a cloud
  const auto fit = fit_factor(stars, std::nullopt);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->used[4], 0);
  EXPECT_EQ(fit->used[11], 0);
  EXPECT_EQ(fit->degrees_of_freedom, 26);
  EXPECT_NEAR(fit->ln_factor, sound, fit->ln_factor_error);
}

TEST(FactorFit, SaysNothingOfFewStars) {
  EXPECT_FALSE(fit_factor({}, std::nullopt));
  EXPECT_FALSE(fit_factor(made_stars(4, 1), std::nullopt));
  EXPECT_TRUE(fit_factor(made_stars(4, 1), kDepth));
  std::vector<FactorDatum> dark = made_stars(10, 1);
  for (FactorDatum& star : dark) star.rate_per_rayleigh = -1e-3;
  EXPECT_FALSE(fit_factor(dark, std::nullopt));
}

TEST(FactorFit, KnowsStudentsInterval) {
  // The two-sided 68.27 % points of Student's t (tables).
  EXPECT_NEAR(student_68(4), 1.142, 0.012);
  EXPECT_NEAR(student_68(10), 1.053, 0.003);
  EXPECT_NEAR(student_68(30), 1.017, 0.002);
}

}  // namespace
}  // namespace vegard::fit::factor_fit_test
