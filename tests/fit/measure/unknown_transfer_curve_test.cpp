// What a photograph is through a curve that is tried, and how curves are compared.
#include "fit/measure/unknown_transfer_curve.h"
#include "fit/measure/profile_bins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/measure/noise_model.h"
#include "fit/measure/profile.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit::unknown_transfer_curve_test {
namespace {

constexpr int kWidth = 64, kHeight = 40;

/// Codes between 20 and 199 that differ from pixel to pixel, `shift` added to all.
Photo coded(int shift) {
  Photo photo;
  photo.linear = sim::Image(kWidth, kHeight, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) =
            static_cast<float>(sim::srgb_decode((20 + (y * 4 + (x * 7 + c * 5) % 23) % 179 + shift) / 255.0));
  photo.unknowns = 1;
  return photo;
}

std::shared_ptr<const BinGrid> grid() {
  sim::Scene scene;
  scene.camera.width = kWidth;
  scene.camera.height = kHeight;
  scene.fit.bands = 4;
  return std::make_shared<const BinGrid>(profile_bins(scene, {0, 0, kWidth, kHeight}));
}

TEST(UnknownTransferCurve, DecodesTheCodes) {
  const Photo as_srgb = coded(0);
  const sim::BentSrgb curve{1.4, 0.8};
  const Photo decoded = decoded_by(as_srgb, curve);
  for (std::size_t i = 0; i < decoded.linear.data.size(); ++i)
    ASSERT_NEAR(decoded.linear.data[i], curve.decode(sim::srgb_encode(as_srgb.linear.data[i])), 1e-6);
  const Photo same = decoded_by(as_srgb, {});
  for (std::size_t i = 0; i < same.linear.data.size(); ++i)
    ASSERT_NEAR(same.linear.data[i], as_srgb.linear.data[i], 1e-7);
  EXPECT_NEAR(code_step(decoded, 0.2), curve.slope(curve.encode(0.2)) / 255.0, 1e-5);
}

// A code more and a code less in every pixel: what a bin's light then does is its slope.
TEST(UnknownTransferCurve, SlopesAreThoseOfTheMeans) {
  const sim::BentSrgb curve{1.3, 0.7};
  const auto bins = grid();
  const auto means = [&](int shift) {
    return smoothed_by_px(extract_profile(decoded_by(coded(shift), curve), bins), 2.0).mean;
  };
  const std::vector<double> more = means(1), less = means(-1),
                            slopes = mean_slopes(coded(0), curve, bins, 2.0);
  for (std::size_t i = 0; i < slopes.size(); ++i)
    ASSERT_NEAR(slopes[i], (more[i] - less[i]) * 255.0 / 2.0, 2e-4 * slopes[i]) << i;
}

// What a gain makes up for does not count, nor does the curve where the noise is that of the codes.
TEST(UnknownTransferCurve, LogDeterminantKnowsNoScaleAndNoNoiseOfCodes) {
  const std::vector<double> sigma = {0.01, 0.0, 0.03, 0.02}, slopes = {0.5, 1.0, 0.2, 0.9};
  std::vector<double> brighter = sigma, steeper = slopes;
  for (double& s : brighter) s *= 7.0;
  for (double& s : steeper) s *= 7.0;
  EXPECT_NEAR(log_determinant(brighter, steeper), log_determinant(sigma, slopes), 1e-12);
  const auto bins = grid();
  for (const sim::BentSrgb curve : {sim::BentSrgb{1.0, 1.0}, sim::BentSrgb{1.7, 0.6}}) {
    std::vector<double> slope = mean_slopes(coded(0), curve, bins, 2.0), noise = slope;
    for (double& s : noise) s *= 0.01;
    EXPECT_NEAR(log_determinant(noise, slope), 2.0 * std::log(0.01) * static_cast<double>(slope.size()),
                1e-6);
  }
}

TEST(UnknownTransferCurve, ScaledChi2GoesOnSmoothly) {
  EXPECT_EQ(scaled_chi2(40.0, 100), 40.0);
  EXPECT_NEAR(scaled_chi2(100.0 + 1e-6, 100) - scaled_chi2(100.0, 100), 1e-6, 1e-9);
  EXPECT_NEAR(scaled_chi2(400.0, 100), 100.0 + 100.0 * std::log(4.0), 1e-9);
}

}  // namespace
}  // namespace vegard::fit::unknown_transfer_curve_test
