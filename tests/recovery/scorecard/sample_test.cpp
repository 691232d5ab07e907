// A small sample of the scorecard, so that the whole of it stays in order; figures come from the program.
#include <gtest/gtest.h>

#include "tests/recovery/scorecard/one_case.h"

namespace vegard::scorecard::sample_test {
namespace {

class ScorecardSample : public ::testing::TestWithParam<int> {};

TEST_P(ScorecardSample, IsRecovered) {
  CaseOptions options;
  options.set = 1;
  options.threads = 0;
  const Row row = run_case(GetParam(), options);
  EXPECT_EQ(row.missed, "") << row.verdict << ": " << row.reasons;
  EXPECT_GT(row.evaluations, 0);
}

// Of one sheet: by beams, with rays; by lines of sight, with folds; by beams, without either.
INSTANTIATE_TEST_SUITE_P(OfSetOne, ScorecardSample, ::testing::Values(3, 5, 9));

}  // namespace
}  // namespace vegard::scorecard::sample_test
