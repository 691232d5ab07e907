#include "sim/emit/footprint/step_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "march_case.h"
#include "sim/light/form_profile.h"
#include "tests/support/glow.h"

namespace vegard::sim::step_profile_test {
namespace {

ProfileTable steep() {
  ProfileTable table;
  table.of_energy.push_back(form_profile(tests::glow(), {630.0, 557.7}, 5.0, {105.0, 0.8, 25.0}));
  return table;
}

double read(const StepProfile& profile, int width, int line, double altitude_km) {
  const double place = (altitude_km - profile.bottom_km()) / HeightProfile::kStepKm;
  const int row = static_cast<int>(place);
  const float* at = profile.rate(0, width) + row * profile.stride() + line;
  return at[0] + (place - row) * (at[profile.stride()] - at[0]);
}

TEST(StepProfile, TilesAProfileWithoutLossWhateverItsBends) {
  const ProfileTable table = steep();
  const StepProfile profile(table, 300.0, 2.0);
  ASSERT_EQ(profile.width_step_km() * 8, 2.0);
  for (int line = 0; line < 2; ++line) {
    const double whole = column_below(table.of_energy[0], line, 300.0).rayleigh;
    for (const double offset : {0.0, 0.3, 1.1, 1.9}) {
      double sum = 0.0, at_middles = 0.0;
      for (double h = profile.bottom_km() - offset; h < 300.0; h += 2.0) {
        const double middle = std::min(std::max(h + 1.0, profile.bottom_km()), 299.99);
        sum += 0.1 * 2.0 * read(profile, 8, line, middle);
        at_middles += 0.1 * 2.0 * read(profile, 0, line, middle);
      }
      EXPECT_NEAR(sum / whole, 1.0, 2e-4);
      // Without the means it would be seen how the steps lie.
      if (offset == 0.3) {
        EXPECT_GT(std::abs(at_middles / whole - 1.0), 1e-3);
      }
    }
  }
}

TEST(StepProfile, IsTheProfileItselfForALevelStep) {
  const ProfileTable table = steep();
  const StepProfile profile(table, 300.0, 2.0);
  for (const double h : {103.0, 105.0, 150.25, 299.5})
    EXPECT_EQ(
        read(profile, 0, 1, h),
        table.of_energy[0].rate[static_cast<std::size_t>((h - 80.0) * 4) * table.of_energy[0].stride + 1]);
}

// A tent of one row to either side: the mean over a row about its peak is 3/4 of it, over the next one 1/8.
TEST(StepProfile, MeansOfATentAreItsAreas) {
  const StepProfile tent(march_case::drawn([](double h) { return std::abs(h - 120.0) < 0.1 ? 1.0 : 0.0; }),
                         300.0, 2.0);
  ASSERT_EQ(tent.width_step_km(), HeightProfile::kStepKm);
  EXPECT_FLOAT_EQ(read(tent, 1, 0, 120.0), 0.75f);
  EXPECT_FLOAT_EQ(read(tent, 1, 0, 119.75), 0.125f);
  EXPECT_FLOAT_EQ(read(tent, 1, 0, 120.25), 0.125f);
  EXPECT_NEAR(read(tent, 1, 0, 120.5), 0.0, 1e-7);
}

TEST(StepProfile, BeginsAtTheFirstLight) {
  const StepProfile dark(march_case::drawn([](double h) { return h > 120.1 ? 1.0 : 0.0; }), 300.0, 2.0);
  EXPECT_EQ(dark.bottom_km(), 119.75);  // two rows below the first that is lit
  const StepProfile lit(march_case::drawn([](double) { return 1.0; }), 300.0, 2.0);
  EXPECT_EQ(lit.bottom_km(), 80.0);
}

}  // namespace
}  // namespace vegard::sim::step_profile_test
