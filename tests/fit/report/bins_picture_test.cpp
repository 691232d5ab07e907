// The picture of a model whose bands have gains and skies of their own: in the bins it is what was compared.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/answer/answer.h"
#include "fit/compare/observation.h"
#include "fit/measure/profile.h"
#include "fit/report/model_picture.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/source_folder.h"

namespace vegard::fit::bins_picture_test {
namespace {

sim::Scene loop_scene() {
  sim::Scene scene = sim::read_scene(tests::source_folder() + "/tests/cli/scenes/loop.toml");
  scene.fit.band_sky = true;
  scene.fit.model_error = 0.01;
  return scene;
}

/// The scene's own light, its gains and skies solved for.
FittedPhoto solved(const sim::Scene& scene, const Photo& photo) {
  const Observation observation = observed(scene, photo, 1);
  FittedPhoto fitted;
  fitted.best = observation.scene;
  Comparison& full = *observation.full;
  Comparison::Point point = full.at(observation.scene);
  point.aurora.free = 0;
  fitted.data = full.data();
  fitted.sigma = full.sigma();
  fitted.model = full.profile_model(point);
  fitted.behind = full.linear().light(point.aurora, point.solution, fitted.model.size()).behind;
  put_solution(full, point, {}, 1.0, 0, fitted);
  return fitted;
}

/// As the fit sees the photograph's.
Profile bins_of(const sim::Image& picture, const Photo& like, const FittedPhoto& fitted) {
  Photo photo = like;
  photo.linear = picture;
  return smoothed_by_px(extract_profile(photo, fitted.data.grid), kProfileSmoothing_px);
}

// The picture is drawn pixel by pixel, the fit's model bin by bin smoothed alike: half a per cent of the
// loop's light.
TEST(BinsPicture, HasInEachBinWhatTheFitCompared) {
  const sim::Scene scene = loop_scene();
  const Photo photo = tests::noisy_photo(scene, 0.001, 5);
  const FittedPhoto fitted = solved(scene, photo);
  const Profile shown = bins_of(model_picture(fitted, photo, 1).rgb, photo, fitted);
  double peak = 0.0;
  for (std::size_t i = 1; i < fitted.model.size(); i += 3)
    peak = std::max(peak, fitted.model[i] - fitted.behind[i]);
  ASSERT_GT(peak, 0.0);
  const std::vector<std::vector<bool>> constrained = constrained_gains(fitted);
  double worst = 0.0;
  for (int b = 0; b < fitted.data.bands; ++b) {
    EXPECT_TRUE(constrained[b][1]) << b;
    for (int p = 0; p < fitted.data.rows; ++p) {
      const std::size_t i = fitted.data.index(b, p, 1);
      if (!(fitted.sigma[i] > 0.0)) continue;
      worst = std::max(worst, std::abs(shown.mean[i] - fitted.model[i]) / peak);
      EXPECT_NEAR(shown.mean[i], fitted.model[i], 0.005 * peak) << b << ", " << p;
      for (const int c : {-1, 1}) EXPECT_EQ(shown.mean[i + c], shown.mean[i]) << b << ", " << p;
    }
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(BinsPicture, TakesTheMeanGainWhereNothingTellsABands) {
  const sim::Scene scene = loop_scene();
  const Photo photo = tests::noisy_photo(scene, 0.001, 5);
  FittedPhoto fitted = solved(scene, photo);
  fitted.gain[0].assign(3, 100.0);
  for (SolvedNumber& s : fitted.solved)
    if (s.name == "gain.band_0") s.sigma = 200.0;
  ASSERT_FALSE(constrained_gains(fitted)[0][1]);
  const sim::Image unconstrained = model_picture(fitted, photo, 1).rgb;
  fitted.gain[0].assign(3, fitted.best.sensor.gain_per_kilorayleigh);
  for (SolvedNumber& s : fitted.solved)
    if (s.name == "gain.band_0") s.sigma = 1e-3 * fitted.gain[0][0];
  ASSERT_TRUE(constrained_gains(fitted)[0][1]);
  const sim::Image mean = model_picture(fitted, photo, 1).rgb;
  EXPECT_EQ(unconstrained.data, mean.data);
}

// The bands' skies are a hundred times the loop: what is left is measured against the loop.
TEST(BinsPicture, WhatIsLeftIsMeasuredWithoutTheSky) {
  const sim::Scene scene = loop_scene();
  FittedPhoto fitted = solved(scene, tests::noisy_photo(scene, 0.001, 5));
  const double share = rms_over_peak(fitted);
  EXPECT_GT(share, 0.0);
  for (std::vector<double>* light : {&fitted.model, &fitted.behind, &fitted.data.mean})
    for (double& value : *light) value += 100.0;
  EXPECT_NEAR(rms_over_peak(fitted), share, 1e-9 * share);
  // A band of which the gain is not told has no say in the peak, however much light it has.
  for (int p = 0; p < fitted.data.rows; ++p) fitted.behind[fitted.data.index(2, p, 1)] -= 1e6;
  EXPECT_LT(rms_over_peak(fitted), 1e-3 * share);
  for (SolvedNumber& s : fitted.solved)
    if (s.name == "gain.band_2") s.sigma = 2.0 * fitted.gain[2][1];
  EXPECT_NEAR(rms_over_peak(fitted), share, 0.5 * share);
}

}  // namespace
}  // namespace vegard::fit::bins_picture_test
