#include "fit/measure/noise_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vegard::fit::noise_model_test {
namespace {

/// One band of 101 rows: sky 0.1 per channel and a triangle of light, 0 to 1 and back, in the channel's
/// share.
Profile triangle() {
  Profile profile;
  profile.bands = 1;
  profile.rows = 101;
  profile.region = {0, 0, 10, 101};
  for (int r = 0; r < 101; ++r)
    for (int c = 0; c < 3; ++c) {
      // 20 rows of bare sky, so that the 5th percentile is the sky.
      const double light = std::max(0.0, 1.0 - std::abs(r - 50) / 40.0);
      profile.mean.push_back(0.1 * (c + 1) + light / (c + 1));
      profile.standard_error.push_back(0.003);
      profile.count.push_back(10);
    }
  return profile;
}

TEST(NoiseModel, TakesTheFifthPercentileForTheSky) {
  const std::array<double, 3> sky = sky_level(triangle());
  for (int c = 0; c < 3; ++c) EXPECT_DOUBLE_EQ(sky[c], 0.1 * (c + 1));
  EXPECT_NEAR(profile_peak(triangle()), 1.0, 1e-12);
}

TEST(NoiseModel, AddsItsThreePartsInQuadrature) {
  const Profile profile = triangle();
  const std::vector<double> sigma = profile_sigma(profile, 0.05);
  for (int c = 0; c < 3; ++c) {
    const double peak = 1.0 / (c + 1);
    EXPECT_NEAR(sigma[profile.index(0, 50, c)],
                std::sqrt(0.003 * 0.003 + std::pow(0.05 * peak, 2) + std::pow(0.005 * peak, 2)), 1e-12);
    EXPECT_NEAR(sigma[profile.index(0, 0, c)], std::hypot(0.003, 0.005 * peak), 1e-12) << "dark";
  }
  EXPECT_NEAR(profile_sigma(profile, 0.0)[0], 0.003, 1e-12);
}

// Residuals of exactly the size that noise and a model error of 0.7 % have together, where 2 % were assumed.
TEST(NoiseModel, FindsTheModelErrorThatResidualsHave) {
  const Profile profile = triangle();
  const std::vector<double> assumed = profile_sigma(profile, 0.02), real = profile_sigma(profile, 0.007);
  std::vector<double> model = profile.mean;
  for (std::size_t i = 0; i < model.size(); ++i) model[i] += i % 2 == 0 ? real[i] : -real[i];
  const double values = static_cast<double>(model.size());
  EXPECT_NEAR(found_model_error(profile, model, assumed, 0.02, values).value(), 0.007, 1e-9);
  EXPECT_GT(found_model_error(profile, model, assumed, 0.02, 0.9 * values).value(), 0.007)
      << "numbers that were fitted make residuals smaller";
  EXPECT_EQ(found_model_error(profile, profile.mean, assumed, 0.02, values), 0.0) << "less than the noise";
  for (double& value : model) value = 1e3;
  EXPECT_FALSE(found_model_error(profile, model, assumed, 0.02, values));
}

TEST(NoiseModel, LeavesOutWhatHasNoPixels) {
  Profile profile = triangle();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  profile.count[151] = 0;
  profile.mean[151] = profile.standard_error[151] = nan;
  profile.count[30] = 1;  // one pixel has a mean and no scatter
  profile.standard_error[30] = nan;
  const std::vector<double> sigma = profile_sigma(profile, 0.05);
  EXPECT_EQ(sigma[151], 0.0);
  EXPECT_GT(sigma[30], 0.0);
  for (double s : sigma) EXPECT_TRUE(std::isfinite(s));
}

}  // namespace
}  // namespace vegard::fit::noise_model_test
