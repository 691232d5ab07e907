#include "fit/answer/trust.h"

#include <gtest/gtest.h>

#include <limits>

#include "fit/answer/verdict.h"
#include "sim/base/number/constants.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::trust_test {
namespace {

DerivedNumber number(const std::string& name, Quantity kind, double value, std::optional<double> sigma) {
  DerivedNumber d;
  d.name = name;
  d.value = value;
  d.sigma = sigma;
  d.unit = kind == Quantity::energy ? "keV" : "km";
  d.quantity = kind;
  if (!sigma) d.why_no_sigma = "the data do not determine it";
  return d;
}

/// A fit that has gone well, with a distance, a border, and a length that no picture tells.
FitResult fine() {
  FitResult r;
  r.verdict = Verdict::doubtful;
  r.verdict_line = "Doubtful: no error bar for length_km.";
  r.checks = {{"converged", true, ""},
              {"chi2 per degree of freedom", true, "1.0"},
              {"error bars", false, "no error bar for length_km"}};
  r.derived = {number("distance", Quantity::distance, 200.0, 4.0),
               number("lower border", Quantity::altitude, 104.0, 2.0),
               number("length", Quantity::width, 300.0, {})};
  return r;
}

TEST(Trust, WhatIsNotToldSpoilsNothingElse) {
  FitResult r = fine();
  assess_quantities(r);
  EXPECT_EQ(r.derived[0].trust, Trust::good);
  EXPECT_EQ(r.derived[1].trust, Trust::good);
  EXPECT_EQ(r.derived[2].trust, Trust::unconstrained);
  EXPECT_EQ(r.derived[2].trust_reason, "the data do not determine it");
  EXPECT_TRUE(tests::has_facts(r.verdict_line, "Doubtful | length_km | Good | distance | lower border"));
}

// Two answers: the distance is 2 km farther in the other one, the border 8 km higher.
TEST(Trust, AnotherAnswerSpeaksAgainstWhatItChanges) {
  FitResult r = fine();
  r.checks.push_back({"one answer", false, "another answer explains the data almost as well"});
  r.derived[0].at_other_mode = 202.0;
  r.derived[1].at_other_mode = 112.0;
  assess_quantities(r);
  EXPECT_EQ(r.derived[0].trust, Trust::good);
  EXPECT_EQ(r.derived[1].trust, Trust::doubtful);
  EXPECT_EQ(r.derived[1].trust_reason, "another answer explains the data almost as well");
}

// Assessed once more with a systematic error, of which the first verdict knew nothing.
TEST(Trust, BothErrorsCount) {
  FitResult r = fine();
  assess_quantities(r);
  r.derived[0].systematic = 15.0;  // 8 % of 200 km, with the statistical 4 km
  assess_quantities(r);
  EXPECT_EQ(r.derived[0].trust, Trust::doubtful);
  EXPECT_TRUE(tests::has_facts(r.derived[0].trust_reason, "7.8 % | 2 % | 7.5 %"));
  EXPECT_TRUE(tests::has_facts(r.verdict_line, "Doubtful | length_km | Good | lower border"));
}

TEST(Trust, NothingIsGoodOfAPictureThatIsNotExplained) {
  FitResult r = fine();
  r.checks[1] = {"chi2 per degree of freedom", false, "chi2 per degree of freedom is 12"};
  assess_quantities(r);
  EXPECT_EQ(r.derived[0].trust, Trust::doubtful);
  EXPECT_EQ(r.derived[0].trust_reason, "chi2 per degree of freedom is 12");
  EXPECT_EQ(r.derived[2].trust, Trust::unconstrained);
  EXPECT_EQ(r.verdict_line.find("Good"), std::string::npos);
}

TEST(Trust, ALimitCountsAgainstWhatDependsOnIt) {
  FitResult r = fine();
  FittedParameter p;
  p.path = "sheet.main.energy_kev";
  p.at_limit = true;
  r.parameters.push_back(p);
  r.derived[1].depends_on = {"sheet.main.energy_kev"};
  assess_quantities(r);
  EXPECT_EQ(r.derived[0].trust, Trust::good);
  EXPECT_EQ(r.derived[1].trust, Trust::doubtful);
  EXPECT_NE(r.derived[1].trust_reason.find("sheet.main.energy_kev"), std::string::npos);
}

TEST(Trust, FailedAndInterruptedFitsTellNothing) {
  for (const Verdict verdict : {Verdict::failed, Verdict::interrupted}) {
    FitResult r = fine();
    r.verdict = verdict;
    assess_quantities(r);
    for (const DerivedNumber& d : r.derived) {
      EXPECT_EQ(d.trust, Trust::unconstrained) << d.name;
      EXPECT_FALSE(d.trust_reason.empty()) << d.name;
    }
  }
}

TEST(Trust, GoesByTheErrorOnTheScaleOfTheKind) {
  // Shares of the value, or kilometres and degrees, on either side of each step.
  for (int k = 0; k <= static_cast<int>(Quantity::other); ++k) {
    const auto kind = static_cast<Quantity>(k);
    const ErrorScale scale = error_scale(kind);
    ASSERT_GT(scale.good, 0.0);
    ASSERT_GT(scale.none, scale.good);
    const double unit = scale.relative ? 50.0 : 1.0;
    EXPECT_EQ(trust_of(kind, -50.0, 0.99 * scale.good * unit), Trust::good);
    EXPECT_EQ(trust_of(kind, 50.0, 1.01 * scale.good * unit), Trust::doubtful);
    EXPECT_EQ(trust_of(kind, 50.0, 0.99 * scale.none * unit), Trust::doubtful);
    EXPECT_EQ(trust_of(kind, 50.0, 1.01 * scale.none * unit), Trust::unconstrained);
    EXPECT_EQ(trust_of(kind, 50.0, sim::kNaN), Trust::unconstrained);
    EXPECT_EQ(trust_of(kind, 50.0, std::numeric_limits<double>::infinity()), Trust::unconstrained);
  }
}

}  // namespace
}  // namespace vegard::fit::trust_test
