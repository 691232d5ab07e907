#include "fit/report/model_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/render/render.h"
#include "tests/support/small_fit.h"

namespace vegard::fit::model_picture_test {
namespace {

// Two bands of 20 columns: centres at 10 and 30.
TEST(ModelPicture, JoinsTheGainsBetweenTheBandsCentres) {
  const FittedPhoto result = tests::small_fit(tests::small_photo()).photos[0];
  EXPECT_DOUBLE_EQ(gain_at_column(result, 0.5, 0), 0.06);
  EXPECT_DOUBLE_EQ(gain_at_column(result, 10.0, 0), 0.06);
  EXPECT_DOUBLE_EQ(gain_at_column(result, 20.0, 0), 0.05);
  EXPECT_DOUBLE_EQ(gain_at_column(result, 30.0, 0), 0.04);
  EXPECT_DOUBLE_EQ(gain_at_column(result, 39.5, 0), 0.04);
}

// With one gain for all it is what `vegard render` makes of the best scene's expectation, clipped before the
// sky.
TEST(ModelPicture, IsTheRenderingOfTheBestScenesExpectation) {
  const Photo photo = tests::small_photo();
  FittedPhoto result = tests::small_fit(photo).photos[0];
  result.gain = {{0.05, 0.05, 0.05}};
  result.best.sensor.gain_per_kilorayleigh = 0.05;
  const ModelPicture picture = model_picture(result, photo, 1);
  const sim::Rendering rendering = sim::render(scene_of_expectation(result));
  ASSERT_GT(*std::max_element(rendering.rayleigh.data.begin(), rendering.rayleigh.data.end()), 0.0f);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      for (int c = 0; c < 3; ++c) {
        const float sky = rendering.rgb.at(x, y, c) - rendering.aurora.at(x, y, c);
        const float expected = std::max(rendering.aurora.at(x, y, c), 0.0f) + sky;
        ASSERT_NEAR(picture.rgb.at(x, y, c), expected, 1e-5);
        ASSERT_FLOAT_EQ(picture.residual.at(x, y, c), photo.linear.at(x, y, c) - picture.rgb.at(x, y, c));
      }
  EXPECT_EQ(picture.rayleigh.data, rendering.rayleigh.data);
}

// A fit's model is aurora and sky, whatever else the scene is composed of.
TEST(ModelPicture, HasNoStars) {
  const Photo photo = tests::small_photo();
  FittedPhoto result = tests::small_fit(photo).photos[0];
  const ModelPicture without = model_picture(result, photo, 1);
  result.best.stars.shown = true;
  result.best.composite.foreground = "is not read.png";
  EXPECT_EQ(model_picture(result, photo, 1).rgb.data, without.rgb.data);
}

// Nor is it one realisation: neither jitter nor its random numbers are in it.
TEST(ModelPicture, HasDenseBeamsWithoutJitter) {
  FittedPhoto result = tests::small_fit(tests::small_photo()).photos[0];
  result.best.sheets[0].beams = 2000;
  const sim::Scene scene = scene_of_expectation(result);
  EXPECT_GT(result.best.sheets[0].spacing_jitter, 0.0);
  EXPECT_EQ(scene.sheets[0].spacing_jitter, 0.0);
  EXPECT_EQ(scene.sheets[0].beams, 32000);
  // Who has many already pays for no more than four times as many.
  result.best.sheets[0].beams = 50000;
  EXPECT_EQ(scene_of_expectation(result).sheets[0].beams, 200000);
  // As many as the length asks for, where the scene says so.
  const int dense_beams = scene.sheets[0].beams;
  result.best.sheets[0].beams = 1;
  result.best.sheets[0].beams_per_km = 2000.0 / result.best.sheets[0].length_km;
  EXPECT_EQ(scene_of_expectation(result).sheets[0].beams, dense_beams);
  EXPECT_EQ(scene_of_expectation(result).sheets[0].beams_per_km, 0.0);
}

}  // namespace
}  // namespace vegard::fit::model_picture_test
