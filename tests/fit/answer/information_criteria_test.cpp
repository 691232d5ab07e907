#include "fit/answer/information_criteria.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/expect_error.h"

namespace vegard::fit::information_criteria_test {
namespace {

TEST(InformationCriteria, AreTheirDefinitions) {
  const InformationCriteria c = information_criteria({"x", 90.0, 100, 4, 1.0}, ChiSquareScaling{});
  EXPECT_DOUBLE_EQ(c.aic, 98.0);
  EXPECT_DOUBLE_EQ(c.aicc, 98.0 + 40.0 / 95.0);
  EXPECT_DOUBLE_EQ(c.bic, 90.0 + 4.0 * std::log(100.0));
  EXPECT_TRUE(std::isinf(information_criteria({"x", 90.0, 5, 4, 1.0}, ChiSquareScaling{}).aicc));
}

// Every value written down m times over: chi2 and the values are m-fold, and m of them are fully correlated.
// The criteria do not change.
TEST(InformationCriteria, AreNotMovedByValuesToldTwice) {
  const FittedModel once{"x", 96.0, 100, 4, 1.0}, often{"x", 96.0 * 9, 900, 4, 9.0};
  const InformationCriteria a = information_criteria(once, chi2_scaling_of(once));
  const InformationCriteria b = information_criteria(often, chi2_scaling_of(often));
  EXPECT_NEAR(b.values, a.values, 1e-9);
  EXPECT_NEAR(b.bic, a.bic, 1e-9);
  EXPECT_NEAR(b.aicc, a.aicc, 1e-9);
}

// Errors too small by a factor of two: chi2 four times too large, and no values correlated.
TEST(InformationCriteria, DoNotTakeSmallErrorsForFewValues) {
  const FittedModel model{"x", 4.0 * 96.0, 100, 4, 1.0};
  const ChiSquareScaling b = chi2_scaling_of(model);
  EXPECT_DOUBLE_EQ(b.chi2_divisor, 4.0);
  EXPECT_DOUBLE_EQ(b.correlated, 1.0);
  EXPECT_DOUBLE_EQ(information_criteria(model, b).chi2, 96.0);
}

// Of pure noise, a needless column lowers chi2 by a chi2 of one degree of freedom. BIC takes it where that
// exceeds ln 200 = 5.3, in 2.1 % of all sets, AIC where it exceeds 2, in 15.7 %. Binomial errors, four of
// them.
TEST(InformationCriteria, ErrAsOftenAsTheyShould) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  constexpr int kSets = 2000, kValues = 200;
  int bic = 0, aic = 0;
  for (int set = 0; set < kSets; ++set) {
    double gain = 0.0, all = 0.0;  // of a needless column, orthonormal to the rest
    for (int i = 0; i < kValues; ++i) {
      const double noise = normal(random);
      gain += noise * (i % 2 == 0 ? 1.0 : -1.0) / std::sqrt(kValues);
      all += noise * noise;
    }
    const FittedModel plain{"plain", all, kValues, 1, 1.0}, rich{"rich", all - gain * gain, kValues, 2, 1.0};
    const InformationCriteria p = information_criteria(plain, ChiSquareScaling{}),
                              r = information_criteria(rich, ChiSquareScaling{});
    bic += r.bic < p.bic;
    aic += r.aic < p.aic;
  }
  const auto expect_share = [](int count, double p) {
    EXPECT_NEAR(count, p * kSets, 4.0 * std::sqrt(p * (1.0 - p) * kSets));
  };
  expect_share(bic, std::erfc(std::sqrt(std::log(kValues) / 2.0)));
  expect_share(aic, std::erfc(1.0));
}

TEST(InformationCriteria, SpeakInWords) {
  // BIC: 500 + 10 ln 1000 = 569.1; 430 + 15 ln 1000 = 533.6.
  const FittedModel one{"one sheet", 500.0, 1000, 10, 1.0}, two{"two sheets", 430.0, 1000, 15, 1.0};
  const std::string expected =
      "two sheets explain it better than one sheet: BIC lower by 35 (very strong evidence)";
  EXPECT_EQ(compared_in_words(one, two), expected);
  EXPECT_EQ(compared_in_words(two, one), expected);
  // A gain of 20 for 5 parameters: AICc 10 less, BIC 14.5 more.
  EXPECT_TRUE(
      tests::has_facts(compared_in_words(one, {"two sheets", 480.0, 1000, 15, 1.0}),
                       "one sheet | better than two | BIC | 15 | very strong | AICc | prefers two | 9.7"));
  EXPECT_TRUE(tests::has_facts(compared_in_words(one, {"two sheets", 466.0, 1000, 15, 1.0}),
                               "one sheet | two sheets | equally | BIC | 0.54"));
  EXPECT_EQ(evidence_words(-5.0), "positive evidence");
  EXPECT_EQ(evidence_words(8.0), "strong evidence");
}

}  // namespace
}  // namespace vegard::fit::information_criteria_test
