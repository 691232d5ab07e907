// Kinds of skies that are made by formula, and that gain and offset do not count.
#include "fit/sky_kind/sky_kind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>

#include "fit/sky_kind/kind_model.h"
#include "fit/sky_kind/sky_lines.h"
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

SkyFeatures lines_of(const Photo& photo) {
  SkyFeatures features{};
  add_lines(photo, PixelSet(256, 192), features);
  return features;
}

/// So many grey bands from edge to edge.
Photo bands(int count, double height) {
  return picture_of([count, height](double, double y) {
    double light = 0.05;
    for (int i = 0; i < count; ++i) {
      const double off = (y - 192.0 * (i + 0.5) / count) / 6.0;
      light += height * std::exp(-off * off);
    }
    return Rgb{light, light, light};
  });
}

TEST(SkyLines, HaveTheLengthOfBandsAndNotTheirBrightness) {
  // The sky's edge takes 4 of 128 pixels at either end.
  for (const int count : {1, 2, 3})
    for (const double height : {0.05, 0.5})
      EXPECT_NEAR(feature(lines_of(bands(count, height)), F::thin_lines), count * 120.0 / 128.0,
                  0.03 * count);
  EXPECT_GT(feature(lines_of(bands(1, 0.5)), F::ridge_top), feature(lines_of(bands(1, 0.05)), F::ridge_top));
}

TEST(SkyLines, LeaveStarsAndTrailsOut) {
  Photo photo = bands(0, 0.0);
  for (int n = 20; n < 170; ++n)
    for (int c = 0; c < 3; ++c)
      photo.linear.at(40, n, c) = photo.linear.at(n + 60, 10, c) =
          photo.linear.at(60 + n % 10 * 15, 50 + n / 15 * 12, c) = 0.9f;
  EXPECT_EQ(feature(lines_of(photo), F::thin_lines), 0.0);
}

TEST(SkyLines, CountTilesWithStarsAndNotThoseWithHoles) {
  Photo photo = bands(0, 0.0);
  const auto dot = [&](int x, int y, float light) {
    for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = light;
  };
  // A star in each of the 32 by 32 pixels of the upper half; below as many dark points as bright ones.
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 8; ++x) {
      dot(32 * x + 10, 32 * y + 12, 0.3f);
      if (y >= 3) dot(32 * x + 22, 32 * y + 20, 0.0f);
    }
  EXPECT_EQ(feature(lines_of(photo), F::star_tiles), 0.5);
}

TEST(SkyLines, RaysAcrossABandAreStrong) {
  const auto rays = [](double contrast) {
    return lines_of(picture_of([contrast](double x, double y) {
      const double off = (y - 100.0) / 25.0, ray = 1.0 + contrast * std::cos(x * 0.5);
      const double light = 0.02 + 0.3 * std::exp(-off * off) * ray;
      return Rgb{light, light, light};
    }));
  };
  EXPECT_GT(feature(rays(0.5), F::ray_strength), feature(rays(0.0), F::ray_strength) + 0.5);
}

TEST(KindModel, OddsFollowFromWeightsAndKindsShareTheRest) {
  const std::string none = R"({"constant": 0.0, "terms": []})", some = R"({"constant": 1.0, "terms": []})";
  std::string kinds;
  for (int k = 1; k < kSkyKinds; ++k)
    kinds += std::string(k > 1 ? ", \"" : "\"") + sky_kind_name(static_cast<SkyKind>(k)) +
             "\": " + (static_cast<SkyKind>(k) == SkyKind::one_arc ? some : none);
  const std::string aurora =
      R"({"constant": -1.0, "terms": [{"feature": "ridge top", "weight": 2.0, "least": 0.0, "most": 1.0, "missing": 0.5}]})";
  const KindModel model(R"({"kind": "vegard kinds of pictures", "aurora": {"grey": )" + aurora +
                            R"(, "colour": )" + none + R"(}, "kinds": {)" + kinds + "}}",
                        "model.json");
  SkyFeatures features;
  features.fill(std::numeric_limits<double>::quiet_NaN());
  const auto of = [&](SkyKind kind) { return model.probabilities(features)[static_cast<std::size_t>(kind)]; };
  const auto likely = [](double odds) { return 1.0 / (1.0 + std::exp(-odds)); };
  EXPECT_NEAR(of(SkyKind::clear), (1.0 - likely(-0.5)) / 5.0, 1e-12);
  feature(features, F::ridge_top) = 7.0;  // counts as the most that was learnt from
  EXPECT_NEAR(of(SkyKind::one_arc), likely(1.0) * std::exp(1.0) / (4.0 + std::exp(1.0)), 1e-12);
  feature(features, F::green_spread) = 0.0;
  EXPECT_NEAR(of(SkyKind::diffuse), 0.5 / (4.0 + std::exp(1.0)), 1e-12);
  tests::expect_error(sim::ErrorKind::unreadable_input, [] { KindModel("{", "model.json"); });
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
