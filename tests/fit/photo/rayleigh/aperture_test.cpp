#include "fit/photo/rayleigh/aperture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/star_field.h"

namespace vegard::fit::aperture_test {
namespace {

CountPicture even_picture(int side, double level) {
  CountPicture picture;
  picture.rate = sim::Image(side, side, {"counts_s"});
  picture.rate.data.assign(picture.rate.data.size(), static_cast<float>(level));
  picture.variance.assign(picture.rate.data.size(), 0.0f);
  picture.usable.assign(picture.rate.data.size(), 1);
  picture.exposure_s = 1.0;
  return picture;
}

/// A Gaussian of this standard deviation and sum.
void add_star(CountPicture& picture, double x_px, double y_px, double sigma_px, double sum) {
  for (int y = 0; y < picture.rate.height; ++y)
    for (int x = 0; x < picture.rate.width; ++x) {
      const auto part = [&](double at, double centre) {
        return std::erf((at + 1.0 - centre) / (std::sqrt(2.0) * sigma_px)) -
               std::erf((at - centre) / (std::sqrt(2.0) * sigma_px));
      };
      picture.rate.at(x, y, 0) += static_cast<float>(0.25 * sum * part(x, x_px) * part(y, y_px));
    }
}

TEST(Aperture, HasAStarsLightWhereverItStands) {
  for (const double shift : {0.0, 0.2, 0.5, 0.77}) {
    CountPicture picture = even_picture(41, 30.0);
    add_star(picture, 20.0 + shift, 21.3 - shift, 0.75, 500.0);
    const auto light = aperture_light(picture, 20.0 + shift, 21.3 - shift, {});
    ASSERT_TRUE(light);
    // Beyond four standard deviations of a round Gaussian lie exp(-8), 0.03 %; of an edge's pixel the share
    // of its area stands for that of its light: 0.2 %.
    EXPECT_NEAR(light->rate, 500.0, 1.5);
    EXPECT_NEAR(light->level, 30.0, 1e-3);
    EXPECT_NEAR(light->pixels, 3.14159265 * 9.0, 0.15);
  }
}

TEST(Aperture, TakesNothingFromASkyThatBendsOrABrightNeighbour) {
  CountPicture picture = even_picture(61, 0.0);
  for (int y = 0; y < 61; ++y)
    for (int x = 0; x < 61; ++x)
      picture.rate.at(x, y, 0) = static_cast<float>(100.0 + 2.0 * x - 0.7 * y + 0.03 * (x * x + y * y));
  // Floats of 200 have steps of 1.5e-5, and there are 28 pixels.
  EXPECT_NEAR(aperture_light(picture, 30.4, 30.5, {})->rate, 0.0, 1e-3);
  CountPicture crowded = even_picture(61, 10.0);
  add_star(crowded, 30.0, 30.0, 0.75, 300.0);
  add_star(crowded, 37.0, 30.0, 0.7, 3000.0);  // in its ring
  EXPECT_NEAR(aperture_light(crowded, 30.0, 30.0, {}, {{37.0, 30.0}})->rate, 300.0, 1.5);
}

TEST(Aperture, KnowsItsNoise) {
  // Seeds 1 to 200: the scatter of what is measured of nothing is what is told, to 3 / sqrt(2 200).
  double square = 0.0, told = 0.0;
  constexpr int kSeeds = 200;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    CountPicture picture = even_picture(31, 50.0);
    for (std::size_t i = 0; i < picture.rate.data.size(); ++i)
      picture.rate.data[i] += static_cast<float>(4.0 * tests::normal(seed, static_cast<std::uint32_t>(i), 3));
    const auto light = aperture_light(picture, 15.3, 15.9, {});
    ASSERT_TRUE(light);
    square += light->rate * light->rate / kSeeds;
    told += light->sigma * light->sigma / kSeeds;
  }
  EXPECT_NEAR(std::sqrt(square / told), 1.0, 0.15);
}

TEST(Aperture, SaysNothingAtAnEdgeOrOfAFullPixel) {
  CountPicture picture = even_picture(31, 50.0);
  EXPECT_FALSE(aperture_light(picture, 2.0, 15.0, {}));
  EXPECT_TRUE(aperture_light(picture, 4.0, 15.0, {}));
  picture.usable[15 * 31 + 17] = 0;
  EXPECT_FALSE(aperture_light(picture, 15.5, 15.5, {}));
}

}  // namespace
}  // namespace vegard::fit::aperture_test
