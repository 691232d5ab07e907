// A small sample of the scorecard, so that the whole of it stays in order; figures come from the program.
#include <gtest/gtest.h>

#include "tests/recovery/scorecard/one_case.h"

namespace vegard::scorecard::sample_test {
namespace {

struct Sample {
  int set, scene;
};

class ScorecardSample : public ::testing::TestWithParam<Sample> {};

TEST_P(ScorecardSample, IsRecovered) {
  CaseOptions options;
  options.set = GetParam().set;
  options.threads = 0;
  const Row row = run_case(GetParam().scene, options);
  EXPECT_EQ(row.missed, "") << row.verdict << ": " << row.reasons;
  EXPECT_GT(row.evaluations, 0);
}

// Of one sheet: by beams, with rays; by lines of sight, with folds; by beams, without either.
INSTANTIATE_TEST_SUITE_P(OfSetOne, ScorecardSample,
                         ::testing::Values(Sample{1, 3}, Sample{1, 5}, Sample{1, 9}));

// Of two sheets, one behind the other: each had the other's sine before they were looked for again, or a
// shorter wave.
INSTANTIATE_TEST_SUITE_P(TwoSheets, ScorecardSample, ::testing::Values(Sample{22, 33}, Sample{22, 48}));

}  // namespace
}  // namespace vegard::scorecard::sample_test
