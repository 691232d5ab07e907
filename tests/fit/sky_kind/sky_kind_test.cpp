// Kinds of skies that are made by formula, and that gain and offset do not count.
#include "fit/sky_kind/sky_kind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "tests/support/expect_error.h"

namespace vegard::fit::sky_kind_test {
namespace {

using F = SkyFeature;
using Rgb = std::array<double, 3>;

Photo picture_of(const std::function<Rgb(double x, double y)>& light) {
  Photo photo;
  photo.file_name = "made.png";
  photo.linear = sim::Image(256, 192, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  for (int y = 0; y < 192; ++y)
    for (int x = 0; x < 256; ++x) {
      const Rgb rgb = light(x + 0.5, y + 0.5);
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) = static_cast<float>(rgb[static_cast<std::size_t>(c)]);
    }
  return photo;
}

SkyFeatures features_of(const Photo& photo) {
  return sky_features(photo, sky_cells(256, 192, {}, "made.png"));
}

/// A band that rises to the right, green where `green` is 1 and grey where it is 0.
Rgb band(double x, double y, double green) {
  const double off = (y - 100.0 + 0.15 * x) / 9.0, light = 0.2 * std::exp(-off * off);
  return {0.02 + light * (1.0 - 0.8 * green), 0.02 + light, 0.02 + light * (1.0 - 0.8 * green)};
}

TEST(SkyFeatures, TellAGreenBandFromAGreyOne) {
  const SkyFeatures green = features_of(picture_of([](double x, double y) { return band(x, y, 1.0); }));
  const SkyFeatures grey = features_of(picture_of([](double x, double y) { return band(x, y, 0.0); }));
  EXPECT_GT(feature(green, F::green_spread), 0.3);
  EXPECT_GT(feature(green, F::green_light), 0.8);
  EXPECT_TRUE(std::isnan(feature(grey, F::green_spread)));
  EXPECT_TRUE(std::isnan(feature(grey, F::blue)));
  for (const SkyFeatures& features : {green, grey}) {
    EXPECT_GT(feature(features, F::elongated), 0.9);
    EXPECT_EQ(feature(features, F::ridges), 1.0);
    // The band crosses the picture: 256 of 256 pixels, less what smoothing takes.
    EXPECT_GT(feature(features, F::ridge_length), 0.7);
  }
}

TEST(SkyFeatures, DoNotChangeWithGain) {
  const SkyFeatures one = features_of(picture_of([](double x, double y) { return band(x, y, 1.0); }));
  const SkyFeatures other = features_of(picture_of([](double x, double y) {
    Rgb rgb = band(x, y, 1.0);
    for (double& value : rgb) value *= 0.25;
    return rgb;
  }));
  for (const SkyFeatureWords& words : sky_feature_words()) {
    if (words.feature == F::brightness || words.feature == F::level) continue;  // of the file, by design
    if (std::isnan(feature(one, words.feature))) {
      EXPECT_TRUE(std::isnan(feature(other, words.feature))) << words.name;  // of directions
      continue;
    }
    // Floats of pixels have seven digits.
    EXPECT_NEAR(feature(one, words.feature), feature(other, words.feature), 1e-4) << words.name;
  }
}

TEST(SkyFeatures, CountStarsAndTheTilesThatHaveThem) {
  Photo photo = picture_of([](double, double) { return Rgb{0.01, 0.01, 0.01}; });
  EXPECT_EQ(feature(features_of(photo), F::points), 0.0);
  // 40 stars, all in the left half.
  for (int i = 0; i < 40; ++i)
    for (int c = 0; c < 3; ++c) photo.linear.at(8 + (i % 8) * 15, 10 + (i / 8) * 36, c) = 0.2f;
  const SkyFeatures features = features_of(photo);
  EXPECT_NEAR(feature(features, F::points), std::log10(41.0), 1e-9);
  EXPECT_GT(feature(features, F::star_cover), 0.3);
  EXPECT_LT(feature(features, F::star_cover), 0.55);
}

TEST(SkyFeatures, FindAWhiteDiscAndHowRoundItIs) {
  const auto disc = [](double squeeze) {
    return features_of(picture_of([squeeze](double x, double y) {
      const double light = std::hypot(x - 120.0, squeeze * (y - 90.0)) < 20.0 ? 1.0 : 0.02;
      return Rgb{light, light, light};
    }));
  };
  // 400 pi of 256 x 192 pixels.
  EXPECT_NEAR(std::pow(10.0, feature(disc(1.0), F::disc)), 400.0 * 3.14159 / 49152.0, 1e-3);
  EXPECT_GT(feature(disc(1.0), F::disc_round), 0.9);
  EXPECT_LT(feature(disc(4.0), F::disc_round), 0.5);
}

TEST(SkyKind, ProbabilitiesAddUpAndAGreenBandIsAurora) {
  const SkyFinding found =
      kind_of_sky(picture_of([](double x, double y) { return band(x, y, 1.0); }), PixelSet(256, 192));
  EXPECT_NEAR(std::accumulate(found.probabilities.begin(), found.probabilities.end(), 0.0), 1.0, 1e-12);
  EXPECT_GT(found.aurora, 0.8);
  EXPECT_TRUE(is_aurora(found.kind));
  EXPECT_NE(found.sentence.find(sky_kind_words(found.kind)), std::string::npos);
}

TEST(SkyKind, AFrameWithoutLightIsBlack) {
  const Photo photo = picture_of([](double, double) { return Rgb{0.001, 0.001, 0.001}; });
  EXPECT_EQ(kind_of_sky(photo, PixelSet(256, 192)).kind, SkyKind::black);
}

TEST(SkyKind, AMaskThatLeavesNothingIsRefused) {
  const Photo photo = picture_of([](double, double) { return Rgb{0.01, 0.01, 0.01}; });
  PixelSet all(256, 192);
  std::fill(all.in.begin(), all.in.end(), std::uint8_t{1});
  tests::expect_error(sim::ErrorKind::unreadable_input, [&] { kind_of_sky(photo, all); });
}

}  // namespace
}  // namespace vegard::fit::sky_kind_test
