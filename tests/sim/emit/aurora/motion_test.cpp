#include "sim/emit/aurora/motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::motion_test {
namespace {

Substorm substorm() {
  Substorm s;
  s.quiet = 0.05;
  s.grown = 0.3;
  s.onset_s = 1000.0;
  s.growth_s = 600.0;
  s.expansion_s = 200.0;
  s.recovery_s = 900.0;
  return s;
}

TEST(Instants, SixtyFramesPerSecondMakeTheSourcesExposures) {
  // Baranoski et al. 2000, figure 17: the averages of 2, 4, 8 and 16 images are 1/30 to 4/15 s.
  for (const auto& [instants, exposure_s] :
       {std::pair{2, 1.0 / 30}, {4, 1.0 / 15}, {8, 2.0 / 15}, {16, 4.0 / 15}}) {
    Time time;
    time.start_s = 2.5;
    time.exposure_s = exposure_s;
    time.instants = instants;
    const std::vector<double> all = instants_s(time);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(instants));
    for (int k = 0; k < instants; ++k) EXPECT_NEAR(all[k], 2.5 + k / 60.0, 1e-14);
  }
}

TEST(SubstormLevel, HasItsValuesWhereThePhasesMeet) {
  const Substorm s = substorm();
  EXPECT_EQ(substorm_level(s, -1e6), 0.05);
  EXPECT_NEAR(substorm_level(s, 400.0), 0.05, 1e-15);
  EXPECT_NEAR(substorm_level(s, 1000.0), 0.3, 1e-15);
  EXPECT_NEAR(substorm_level(s, 1200.0), 1.0, 1e-15);
  EXPECT_NEAR(substorm_level(s, 2100.0), 0.05, 1e-15);
  EXPECT_NEAR(substorm_level(s, 1e6), 0.05, 1e-15);
  // Half-way through a smooth step.
  EXPECT_NEAR(substorm_level(s, 700.0), 0.175, 1e-15);
  EXPECT_NEAR(substorm_level(s, 1100.0), 0.65, 1e-15);
  EXPECT_NEAR(substorm_level(s, 1650.0), 0.525, 1e-15);
}

TEST(SubstormLevel, HasNoStepAndNoKinkAndGrowsBeforeItFades) {
  const Substorm s = substorm();
  // The steepest place is the middle of the expansion: 1.5 * 0.7 / 200 s.
  constexpr double kStep = 0.25, kSteepest = 1.5 * 0.7 / 200.0;
  double before = substorm_level(s, 0.0), slope_before = 0.0;
  for (double t = kStep; t < 2500.0; t += kStep) {
    const double level = substorm_level(s, t), slope = (level - before) / kStep;
    EXPECT_LT(std::abs(slope), 1.001 * kSteepest) << t;
    // A smooth step's second derivative is at most 6 / length^2.
    EXPECT_LT(std::abs(slope - slope_before), 1.001 * kStep * 6.0 * 0.7 / (200.0 * 200.0)) << t;
    if (t <= 1200.0) {
      EXPECT_GE(slope, 0.0) << t;
    }
    if (t > 1200.0 + kStep) {
      EXPECT_LE(slope, 0.0) << t;
    }
    before = level;
    slope_before = slope;
  }
}

TEST(SubstormLevel, IsExactlyOneWithoutASubstorm) {
  Substorm s = substorm();
  s.quiet = 1.0;
  for (double t : {-1e6, 400.0, 700.0, 999.999, 1000.0, 1100.0, 1200.0, 1700.0, 1e6})
    EXPECT_EQ(substorm_level(s, t), 1.0);
}

}  // namespace
}  // namespace vegard::sim::motion_test
