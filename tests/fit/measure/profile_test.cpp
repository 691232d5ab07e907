#include "fit/measure/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "sim/base/error.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit::profile_test {
namespace {

/// A photograph as from a float file: no quantisation, everything usable.
Photo photo_of(int width, int height, const std::function<double(int, int, int)>& value) {
  Photo photo;
  photo.linear = sim::Image(width, height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = static_cast<float>(value(x, y, c));
  return photo;
}

constexpr double kSigma[3] = {0.01, 0.02, 0.005};

double level(int y, int c) { return 0.3 + 0.1 * c + 0.1 * std::sin(0.05 * y); }

Photo noisy_photo(int width, int height, double ramp_per_px = 0.0) {
  std::mt19937_64 random(20140221);
  std::normal_distribution<double> normal;
  return photo_of(width, height, [&](int x, int y, int c) {
    return level(y, c) + ramp_per_px * x + kSigma[c] * normal(random);
  });
}

/// Mean over rows and bands of (standard error x sqrt(count) / true sigma)^2, one per channel; 1 if they are
/// right.
double variance_ratio(const Profile& profile, int channel) {
  double sum = 0.0;
  int n = 0;
  for (int band = 0; band < profile.bands; ++band)
    for (int row = 0; row < profile.rows; ++row) {
      const std::size_t i = profile.index(band, row, channel);
      if (profile.count[i] < 2) continue;
      const double ratio = profile.standard_error[i] * std::sqrt(profile.count[i]) / kSigma[channel];
      sum += ratio * ratio;
      ++n;
    }
  return sum / n;
}

// A variance from m differences of neighbours has a relative error of sqrt(3 / m): here m = 15 rows x 79 per
// pool, 5 % each, and 20 x 5 pools do not overlap: 0.5 % for their mean. Bounds at five times that.
TEST(ExtractProfile, StandardErrorsOfGaussianNoise) {
  const Profile profile = extract_profile(noisy_photo(400, 300), {0, 0, 400, 300}, 5);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(variance_ratio(profile, c), 1.0, 0.025);
    for (int band = 0; band < 5; ++band)
      for (int row = 7; row < 293; ++row) {
        const std::size_t i = profile.index(band, row, c);
        EXPECT_EQ(profile.count[i], 80);
        EXPECT_NEAR(profile.standard_error[i] / (kSigma[c] / std::sqrt(80.0)), 1.0, 0.125);
      }
  }
}

// The means scatter about the truth by their standard errors: 4500 squares of a unit normal have a mean of 1
// to sqrt(2 / 4500) = 2.1 %; the errors' own 5 % adds its square. Bound at five times that.
TEST(ExtractProfile, MeansScatterByTheirStandardErrors) {
  const Profile profile = extract_profile(noisy_photo(400, 300), {0, 0, 400, 300}, 5);
  double chi2 = 0.0;
  for (int band = 0; band < 5; ++band)
    for (int row = 0; row < 300; ++row)
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = profile.index(band, row, c);
        const double z = (profile.mean[i] - level(row, c)) / profile.standard_error[i];
        chi2 += z * z;
      }
  EXPECT_NEAR(chi2 / 4500, 1.0, 0.11);
}

// A ramp of a whole sigma per pixel would add a half to the variance were its mean difference left in.
TEST(ExtractProfile, RampIsNoNoise) {
  const Profile flat = extract_profile(noisy_photo(400, 60), {0, 0, 400, 60}, 5);
  const Profile ramp = extract_profile(noisy_photo(400, 60, 0.005), {0, 0, 400, 60}, 5);
  for (std::size_t i = 0; i < flat.mean.size(); ++i)
    EXPECT_NEAR(ramp.standard_error[i] / flat.standard_error[i], 1.0, 1e-3);
}

// Structure that varies slowly against a pixel, 20 sigma high, 100 pixels long: its largest difference of
// neighbours, 20 sin'(…) = 1.26 sigma, adds at most 1.26^2 / 4 = 40 % to the variance; counted as scatter it
// would add 200-fold.
TEST(ExtractProfile, WideStructureHardlyCounts) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const Photo photo = photo_of(400, 60, [&](int x, int y, int c) {
    return level(y, c) + kSigma[c] * (20.0 * std::sin(2 * M_PI * x / 100) + normal(random));
  });
  EXPECT_LT(variance_ratio(extract_profile(photo, {0, 0, 400, 60}, 1), 1), 1.5);
}

TEST(ExtractProfile, NoiseStaysUnbiasedUnderATornMask) {
  Photo photo = noisy_photo(400, 300, 0.005);
  std::mt19937_64 random(5);
  for (std::uint8_t& usable : photo.usable) usable = random() % 10 < 6;
  const Profile profile = extract_profile(photo, {0, 0, 400, 300}, 5);
  // 60 % usable: 36 % of the pairs are left, an error of 0.8 %; the gaps do not share the ramp's loss of
  // freedom.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(variance_ratio(profile, c), 1.0, 0.04);
}

// Three pixels a, b, c have two differences; less their mean they are half of (a - 2 b + c)², 3 variances in
// the mean and not 4. 100 bands of 20 pools of 15 rows leave 0.7 %.
TEST(ExtractProfile, NoiseOfBandsOfThreePixelsIsUnbiased) {
  const Profile profile = extract_profile(noisy_photo(300, 300), {0, 0, 300, 300}, 100);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(variance_ratio(profile, c), 1.0, 0.03);
}

// Without any neighbours left the scatter of the row's values has to do.
TEST(ExtractProfile, NoNeighboursLeft) {
  Photo photo = noisy_photo(400, 300);
  for (std::size_t i = 0; i < photo.usable.size(); ++i) photo.usable[i] = i / 3 % 2;
  const Profile profile = extract_profile(photo, {0, 0, 400, 300}, 5);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(variance_ratio(profile, c), 1.0, 0.03);
}

TEST(ExtractProfile, QuantisationIsTheLeastNoise) {
  for (const int bits : {8, 16}) {
    const double stored = 100.0 / 255.0;
    Photo photo = photo_of(50, 20, [&](int, int, int) { return sim::srgb_decode(stored); });
    photo.floating = false;
    photo.srgb = true;
    photo.bits = bits;
    const Profile profile = extract_profile(photo, {0, 0, 50, 20}, 2);
    const double slope = 2.4 / 1.055 * std::pow((stored + 0.055) / 1.055, 1.4);
    const double step = slope / ((1 << bits) - 1);
    for (const double sigma : profile.standard_error)
      EXPECT_NEAR(sigma / (step / std::sqrt(12.0) / std::sqrt(25.0)), 1.0, 1e-4);
  }
}

TEST(ExtractProfile, OnlyUsablePixelsCount) {
  Photo photo = photo_of(6, 2, [](int x, int y, int c) { return x + 10 * y + 100 * c; });
  for (int x = 0; x < 6; ++x) photo.usable[photo.linear.index(x, 0, 0)] = x == 1 || x == 5;  // red, upper row
  for (int x = 0; x < 6; ++x) photo.usable[photo.linear.index(x, 1, 1)] = x == 2;  // green, lower row
  for (int x = 0; x < 6; ++x) photo.usable[photo.linear.index(x, 1, 2)] = 0;       // blue, lower row
  const Profile profile = extract_profile(photo, {0, 0, 6, 2}, 1);
  EXPECT_EQ(profile.count, (std::vector<int>{2, 6, 6, 6, 1, 0}));
  EXPECT_DOUBLE_EQ(profile.mean[0], 3.0);
  EXPECT_DOUBLE_EQ(profile.mean[1], 102.5);
  EXPECT_DOUBLE_EQ(profile.mean[3], 12.5);
  EXPECT_DOUBLE_EQ(profile.mean[4], 112.0);
  EXPECT_DOUBLE_EQ(profile.standard_error[4], profile.standard_error[1] * std::sqrt(6.0));
  EXPECT_TRUE(std::isnan(profile.mean[5]));
  EXPECT_FALSE(std::isnan(profile.standard_error[0]));
}

// What one pixel is worth, the rows around it tell; bins at the ends of sheared bands have no more, and
// without an error they would rule a fit. Bound as above.
TEST(ExtractProfile, OnePixelHasTheNoiseOfItsSurroundings) {
  Photo photo = noisy_photo(80, 31);
  for (int x = 0; x < 80; ++x)
    for (int c = 0; c < 3; ++c) photo.usable[photo.linear.index(x, 15, c)] = x == 40;
  const Profile profile = extract_profile(photo, {0, 0, 80, 31}, 1);
  for (int c = 0; c < 3; ++c) {
    ASSERT_EQ(profile.count[profile.index(0, 15, c)], 1);
    EXPECT_NEAR(profile.standard_error[profile.index(0, 15, c)] / kSigma[c], 1.0, 0.125);
  }
  // Where no row has two pixels nothing is known.
  const Profile narrow = extract_profile(photo, {40, 0, 1, 31}, 1);
  EXPECT_TRUE(std::isnan(narrow.standard_error[narrow.index(0, 15, 0)]));
}

TEST(ExtractProfile, BandsAndRowsOfARegion) {
  const Photo photo = photo_of(40, 30, [](int x, int y, int c) { return x + 1000 * y + 0.25 * c; });
  const Region region{5, 7, 31, 11};
  const Profile profile = extract_profile(photo, region, 4);
  ASSERT_EQ(profile.rows, 11);
  for (int band = 0; band < 4; ++band) {
    const int begin = band_begin(region, 4, band), end = band_begin(region, 4, band + 1);
    for (int row = 0; row < 11; ++row) {
      const std::size_t i = profile.index(band, row, 2);
      EXPECT_NEAR(profile.mean[i], 0.5 * (begin + end - 1) + 1000 * (7 + row) + 0.5, 1e-9);
      EXPECT_EQ(profile.count[i], end - begin);
    }
  }
}

TEST(BandBegin, BandsCoverTheRegionExactly) {
  for (const int width : {1, 7, 24, 25, 100, 719, 4618})
    for (const int bands : {1, 2, 3, 24, 100}) {
      if (bands > width) continue;
      const Region region{11, 0, width, 1};
      EXPECT_EQ(band_begin(region, bands, 0), 11);
      EXPECT_EQ(band_begin(region, bands, bands), 11 + width);
      int narrowest = width, widest = 0;
      for (int b = 0; b < bands; ++b) {
        const int columns = band_begin(region, bands, b + 1) - band_begin(region, bands, b);
        narrowest = std::min(narrowest, columns);
        widest = std::max(widest, columns);
      }
      EXPECT_GE(narrowest, 1);
      EXPECT_LE(widest - narrowest, 1);
    }
}

TEST(CheckedRegion, InsideOrRefused) {
  const Region whole = checked_region({0, 0, 0, 0}, 720, 480);
  EXPECT_EQ(whole.width, 720);
  EXPECT_EQ(whole.height, 480);
  EXPECT_EQ(checked_region({700, 470, 20, 10}, 720, 480).x, 700);
  const int huge = 2147483647;
  for (const std::array<int, 4>& bad : std::vector<std::array<int, 4>>{{701, 470, 20, 10},
                                                                       {700, 471, 20, 10},
                                                                       {-1, 0, 10, 10},
                                                                       {0, 0, 0, 10},
                                                                       {5, 0, 0, 0},
                                                                       {10, 10, -5, 5},
                                                                       {huge, 0, huge, 5}}) {
    try {
      checked_region(bad, 720, 480);
      ADD_FAILURE() << "a region outside was taken";
    } catch (const sim::Error& error) {
      EXPECT_EQ(error.kind(), sim::ErrorKind::scene);
      EXPECT_EQ(error.details().key, "fit.roi_px");
    }
  }
}

TEST(ExtractProfile, NumberOfBandsIsChecked) {
  const Photo photo = photo_of(6, 2, [](int, int, int) { return 0.5; });
  for (const int bands : {0, -3, 7}) EXPECT_THROW(extract_profile(photo, {0, 0, 6, 2}, bands), sim::Error);
  EXPECT_NO_THROW(extract_profile(photo, {0, 0, 6, 2}, 6));
}

// Against a direct simulation: 20000 noisy triples give a share's scatter to sqrt(1 / 40000) = 0.5 %; the
// formula is of first order, exact here to about sigma^2. Bound at 3 %.
TEST(Chromaticity, ErrorsPropagate) {
  Profile profile;
  profile.bands = profile.rows = 1;
  profile.mean = {0.2, 0.5, 0.1};
  profile.standard_error = {0.01, 0.004, 0.003};
  profile.count = {9, 9, 9};
  const Chromaticity told = chromaticity(profile, 0, 0);
  EXPECT_DOUBLE_EQ(told.r, 0.25);
  EXPECT_DOUBLE_EQ(told.g, 0.625);
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  double rr = 0.0, gg = 0.0;
  constexpr int kTrials = 20000;
  for (int i = 0; i < kTrials; ++i) {
    double v[3];
    for (int c = 0; c < 3; ++c) v[c] = profile.mean[c] + profile.standard_error[c] * normal(random);
    const double sum = v[0] + v[1] + v[2];
    rr += (v[0] / sum - told.r) * (v[0] / sum - told.r);
    gg += (v[1] / sum - told.g) * (v[1] / sum - told.g);
  }
  EXPECT_NEAR(told.sigma_r / std::sqrt(rr / kTrials), 1.0, 0.03);
  EXPECT_NEAR(told.sigma_g / std::sqrt(gg / kTrials), 1.0, 0.03);
  profile.mean = {0.1, -0.2, 0.05};
  EXPECT_TRUE(std::isnan(chromaticity(profile, 0, 0).r));
}

}  // namespace
}  // namespace vegard::fit::profile_test
