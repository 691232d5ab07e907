#include "fit/uncertainty/delta_method.h"
#include "tests/support/free_paths.h"
#include "tests/support/small_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vegard::fit::delta_method_test {
namespace {

struct TwoNumbers {
  sim::Scene scene = tests::with_sheet({});
  std::vector<FreeNumber> free;
  std::vector<double> values = {3.0, 200.0};
  ValueUncertainty known{{{0.04, 0.3}, {0.3, 9.0}}, {}};

  TwoNumbers() {
    scene.fit.free = {tests::free_entry("sheet.main.energy_kev"),
                      tests::free_entry("sheet.main.center_km.north")};
    free = free_numbers(scene);
  }
  std::vector<DeltaMethod::Estimate> of(const DeltaMethod::Numbers& numbers) const {
    return DeltaMethod(scene, free, values, known)(numbers);
  }
};

TEST(DeltaMethod, OfALinearNumberIsTheFormulaWithItsCorrelation) {
  const TwoNumbers two;
  const auto found = two.of([](const sim::Scene& x) {
    return std::vector<double>{2.0 * x.sheets[0].energy_kev - 0.5 * x.sheets[0].center_km.north, 7.0};
  });
  ASSERT_EQ(found.size(), 2u);
  // 4 * 0.04 - 2 * 0.3 + 0.25 * 9
  ASSERT_TRUE(found[0].sigma);
  EXPECT_NEAR(*found[0].sigma, std::sqrt(1.81), 1e-9);
  EXPECT_FALSE(found[1].sigma);
  EXPECT_FALSE(found[1].moves);
}

TEST(DeltaMethod, OfABentNumberIsFirstOrder) {
  const TwoNumbers two;
  const auto found =
      two.of([](const sim::Scene& x) { return std::vector<double>{std::log(x.sheets[0].energy_kev)}; });
  // The central difference over 0.02 keV to either side of 3 keV: off by (0.02 / 3)^2 / 3 of itself.
  EXPECT_NEAR(found[0].sigma.value(), 0.2 / 3.0, 2e-5 * 0.2 / 3.0);
}

// Nothing tells the energy between 1 and 7 keV: a number that gains 0.01 by each keV has 0.01 of the standard
// deviation of a uniform distribution, beside what the distance has to do with it. Without a limit there is
// nothing to be said.
TEST(DeltaMethod, KnowsWhatLimitsLeaveOfAnUndeterminedDirection) {
  TwoNumbers two;
  two.known = {{{0.0, 0.0}, {0.0, 9.0}}, {{1.0, 0.0}}};
  two.known.covariance[0][0] = 3.0;  // by its limits: 6 / sqrt(12)
  two.free[0].min = 1.0;
  two.free[0].max = 7.0;
  const auto number = [](const sim::Scene& x) {
    return std::vector<double>{0.01 * x.sheets[0].energy_kev, x.sheets[0].center_km.north};
  };
  auto found = two.of(number);
  EXPECT_FALSE(found[0].sigma);
  EXPECT_NEAR(found[0].within_limits.value(), 0.01 * std::sqrt(3.0 + 3.0), 1e-9)
      << "the covariance's share is counted too";
  EXPECT_NEAR(found[1].sigma.value(), 3.0, 1e-9);
  EXPECT_FALSE(found[1].within_limits);
  two.free[0].max = std::numeric_limits<double>::infinity();
  found = two.of(number);
  EXPECT_FALSE(found[0].within_limits);
}

// One standard deviation of a mode moves the answer by 0.1 keV and 1 km, which the covariance contains, and
// the number by 3 more: 1.81 of the test above, less (2 * 0.1 - 0.5)^2, and (2 * 0.1 - 0.5 + 3)^2.
TEST(DeltaMethod, AddsWhatAModeDoesItselfAndByWayOfTheAnswer) {
  TwoNumbers two;
  two.known.modes = {{1, {0.1, 1.0}, {}}};
  const auto found = two.of([](const sim::Scene& x) {
    const double coefficient = x.emission.modes.size() > 1 ? x.emission.modes[1] : 0.0;
    return std::vector<double>{
        2.0 * x.sheets[0].energy_kev - 0.5 * x.sheets[0].center_km.north + 3.0 * coefficient,
        3.0 * coefficient};
  });
  EXPECT_NEAR(found[0].sigma.value(), std::sqrt(1.81 - 0.09 + 7.29), 1e-9);
  EXPECT_FALSE(found[1].sigma) << "it follows from what was fixed";
}

TEST(DeltaMethod, AtALimitGoesByTheOtherSide) {
  TwoNumbers two;
  two.free[0].max = 3.0;
  const auto found = two.of([](const sim::Scene& x) { return std::vector<double>{x.sheets[0].energy_kev}; });
  EXPECT_NEAR(found[0].sigma.value(), 0.2, 1e-9);
}

}  // namespace
}  // namespace vegard::fit::delta_method_test
