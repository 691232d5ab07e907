// Power spectra of small pictures.
#include "fit/measure/power_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vegard::fit::power_spectrum_test {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr int kColumns = 64, kRows = 48;

std::vector<double> hann_window() {
  std::vector<double> window;
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c)
      window.push_back(std::pow(std::sin(0.5 * kTwoPi * (r + 0.5) / kRows), 2) *
                       std::pow(std::sin(0.5 * kTwoPi * (c + 0.5) / kColumns), 2));
  return window;
}

template <class Light>
std::vector<double> picture(const Light& light) {
  std::vector<double> cells;
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c) cells.push_back(light(c, r));
  return cells;
}

// A wave of one length: all but a thousandth of the power is in its band and the next ones, and light that is
// ten times as bright has the same.
TEST(PowerSpectrum, FindsAWaveInItsBand) {
  const PowerSpectrum spectrum(kColumns, kRows, hann_window());
  const double f = 8.0 / kColumns;
  const auto wave = [&](double times) {
    return spectrum.of(picture([&](int c, int) { return times * (3.0 + std::cos(kTwoPi * f * c)); })).power;
  };
  const std::vector<double> power = wave(1.0), brighter = wave(10.0);
  std::size_t best = 0;
  double all = 0.0, near = 0.0;
  for (std::size_t b = 0; b < power.size(); ++b) {
    if (power[b] > power[best]) best = b;
    all += power[b];
    EXPECT_NEAR(brighter[b], power[b], 1e-9 * power[best]);
  }
  for (std::size_t b = best > 0 ? best - 1 : 0; b < std::min(power.size(), best + 2); ++b) near += power[b];
  EXPECT_LT(std::abs(std::log(spectrum.wavenumber(best) / f)), std::log(2.0) / 2.0);
  EXPECT_GT(near, 0.999 * all);
}

TEST(PowerSpectrum, KnowsNoParabola) {
  const PowerSpectrum spectrum(kColumns, kRows, hann_window());
  const auto power =
      spectrum
          .of(picture([](int c, int r) { return 5.0 + 0.02 * c - 0.01 * r + 1e-4 * c * r - 2e-4 * c * c; }))
          .power;
  for (const double p : power) EXPECT_LT(p, 1e-18);
}

TEST(PowerSpectrum, HasTheSlopesOfItsPower) {
  const PowerSpectrum spectrum(kColumns, kRows, hann_window());
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 0.2);
  const std::vector<double> base = picture([&](int, int) { return 2.0 + normal(random); });
  const std::vector<double> grow =
      picture([](int c, int r) { return std::sin(0.7 * c + 0.3 * r) + 0.01 * c; });
  const std::vector<double> slope = spectrum.slope(spectrum.of(base), grow);
  constexpr double h = 1e-5;
  std::vector<double> more = base, less = base;
  for (std::size_t i = 0; i < base.size(); ++i) {
    more[i] += h * grow[i];
    less[i] -= h * grow[i];
  }
  const std::vector<double> high = spectrum.of(more).power, low = spectrum.of(less).power;
  for (std::size_t b = 0; b < slope.size(); ++b)
    EXPECT_NEAR(slope[b], (high[b] - low[b]) / (2.0 * h), 1e-6 * high[b]) << b;
}

// White noise over light of 1: every band's power is that of the noise, and scatters as it is said to. 300
// pictures tell a variance to 8 %; the allowed 35 % are four times that.
TEST(PowerSpectrum, KnowsHowMuchWhiteNoiseScatters) {
  const PowerSpectrum spectrum(kColumns, kRows, hann_window());
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0.0, 0.01);
  constexpr int kPictures = 300;
  std::vector<double> sum(spectrum.bands(), 0.0), square(spectrum.bands(), 0.0);
  double expected = 0.0;
  for (int n = 0; n < kPictures; ++n) {
    const PowerSpectrum::Light light = spectrum.of(picture([&](int, int) { return 1.0 + normal(random); }));
    expected = spectrum.noise_power(light, std::vector<double>(kColumns * kRows, 1e-4));
    for (std::size_t b = 0; b < spectrum.bands(); ++b) {
      sum[b] += light.power[b];
      square[b] += light.power[b] * light.power[b];
    }
  }
  // The lowest band loses some of its power to the trend.
  for (std::size_t b = 1; b < spectrum.bands(); ++b) {
    const double mean = sum[b] / kPictures, variance = square[b] / kPictures - mean * mean;
    EXPECT_NEAR(mean, expected, 4.0 * std::sqrt(variance / kPictures) + 0.01 * expected) << b;
    EXPECT_NEAR(variance / (mean * mean) / spectrum.relative_variance(b), 1.0, 0.35) << b;
  }
}

}  // namespace
}  // namespace vegard::fit::power_spectrum_test
