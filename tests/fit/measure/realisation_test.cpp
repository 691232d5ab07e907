#include "fit/measure/noise_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/random.h"

namespace vegard::fit::realisation_test {
namespace {

constexpr int kWidth = 240, kHeight = 120, kBands = 6;

double normal_number(std::uint64_t seed, std::uint32_t i) {
  const auto words = sim::random_words(seed, sim::Stream::search, i);
  return std::sqrt(-2.0 * std::log(1.0 - sim::uniform(words[0]))) *
         std::cos(6.283185307179586 * sim::uniform(words[1]));
}

/// An arc of Gaussian cross-section whose middle goes up and down from part to part of the bands by
/// `shift_rows`, and whose columns are brighter or darker by a tenth; white noise of 0.002.
Photo arc(double shift_rows, int width = kWidth) {
  Photo photo;
  photo.linear = sim::Image(width, kHeight, {"R", "G", "B"});
  for (int x = 0; x < width; ++x) {
    const double middle = 60.0 + shift_rows * normal_number(7, static_cast<std::uint32_t>(x / 10));
    const double bright = 0.5 * (1.0 + 0.1 * std::sin(0.2 * x));
    for (int y = 0; y < kHeight; ++y)
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) =
            static_cast<float>(0.02 + bright * std::exp(-0.5 * std::pow((y - middle) / 12.0, 2)) +
                               0.002 * normal_number(8 + c, static_cast<std::uint32_t>(y * width + x)));
  }
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  return photo;
}

double mean_at(const std::vector<double>& sigma, int row) {
  double sum = 0.0;
  for (int b = 0; b < kBands; ++b) sum += sigma[(static_cast<std::size_t>(b) * kHeight + row) * 3 + 1];
  return sum / kBands;
}

TEST(RealisationSigma, IsThatOfStructureAndNotOfBrightnessOrNoise) {
  const Region region = {0, 0, kWidth, kHeight};
  const std::vector<double> even = realisation_sigma(arc(0.0), region, kBands, 2.0);
  const std::vector<double> uneven = realisation_sigma(arc(2.0), region, kBands, 2.0);
  // On the flank, 12 rows from the middle, the light falls by 0.5 exp(-1/2) / 12 = 0.025 a row: parts whose
  // middles scatter by 2 rows differ by 0.05, two independent ones in the mean by 0.036. The trend taken out
  // and six bands of four leave 12 degrees of freedom: 20 % each way is one standard deviation.
  EXPECT_NEAR(mean_at(uneven, 48), 0.036, 3.0 * 0.2 * 0.036);
  EXPECT_LT(mean_at(even, 48), 0.1 * mean_at(uneven, 48));
  // Where there is no light there is no structure.
  EXPECT_LT(mean_at(uneven, 4), 0.1 * mean_at(uneven, 48));
}

// Four parts of a band less their mean and their trend have two degrees of freedom. Of 240 bands that is 480,
// and a standard deviation of 1 / sqrt(2 * 480) = 3.2 %.
TEST(RealisationSigma, IsWithoutBiasOverManyBands) {
  constexpr int kMany = 240, kRow = 48, kRowsEachSide = 15;
  constexpr double kShift = 2.0, kSmoothing = 2.0;
  const std::vector<double> sigma = realisation_sigma(
      arc(kShift, kMany * kWidth / kBands), {0, 0, kMany * kWidth / kBands, kHeight}, kMany, kSmoothing);
  double square = 0.0;
  for (int b = 0; b < kMany; ++b)
    square += std::pow(sigma[(static_cast<std::size_t>(b) * kHeight + kRow) * 3 + 1], 2) / kMany;
  // To first order a part differs by its shift times the slope of the smoothed arc; two parts are
  // independent. The third order takes off 3 % on the flank.
  const double width = std::hypot(12.0, kSmoothing);
  double expected = 0.0;
  for (int r = kRow - kRowsEachSide; r <= kRow + kRowsEachSide; ++r) {
    const double off = r - 60.0;
    const double slope =
        0.5 * 12.0 / width * off / (width * width) * std::exp(-0.5 * off * off / (width * width));
    expected += std::pow(kShift * slope, 2) / 2.0 / (2 * kRowsEachSide + 1);
  }
  EXPECT_NEAR(std::sqrt(square / expected), 0.98, 3.0 * 0.032);
}

TEST(RealisationSigma, IsNoneWhereBandsAreTooNarrow) {
  for (const double s : realisation_sigma(arc(2.0), {0, 0, kWidth, kHeight}, 40, 2.0)) EXPECT_EQ(s, 0.0);
}

TEST(SamplingError, IsTheScatterWithoutTheBandsBrightness) {
  std::vector<double> one(6000), other(6000);
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double gain = i < 3000 ? 1.0 : 1.3;
    one[i] = 1.0 + 0.02 * normal_number(1, static_cast<std::uint32_t>(i));
    other[i] = gain * (1.0 + 0.02 * normal_number(2, static_cast<std::uint32_t>(i)));
  }
  // One part in sqrt(2 * 6000).
  EXPECT_NEAR(sampling_error(one, other, 2), 0.02, 3.0 * 0.02 / std::sqrt(12000.0));
  EXPECT_EQ(sampling_error({0.0, 0.0}, {0.0, 0.0}, 1), 0.0);
}

}  // namespace
}  // namespace vegard::fit::realisation_test
