// Which scenes are compared by the mean over all draws, and what its wide cells and high bins make of
// profiles.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "fit/measure/profile_bins.h"
#include "fit/model/profile_model.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::expected_model_test {
namespace {

constexpr int kBands = 4;

sim::Scene scene_of_bands() {
  sim::Scene scene = tests::small_scene();
  scene.blur.width_deg = {0.6, 0.5, 0.4};
  scene.fit.bands = kBands;
  return scene;
}

Photo all_usable(const sim::Scene& scene) {
  Photo photo;
  photo.linear = sim::Image(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  return photo;
}

ModelProfile model_of(const sim::Scene& scene, int rows) {
  const Photo photo = all_usable(scene);
  const Region region{0, 0, scene.camera.width, scene.camera.height};
  ProfileModel model(scene, photo, {std::make_shared<const BinGrid>(column_bins(region, kBands, rows))}, 1.0,
                     4.0, 1, 0, 4.0);
  ModelProfile profile;
  model.evaluate(scene, profile);
  return profile;
}

/// Root mean square of what two profiles differ by, over that of one.
double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return std::sqrt(difference / size);
}

TEST(ExpectedModel, IsADrawWhereAskedForAndWhereThereIsNoMean) {
  sim::Scene scene = scene_of_bands();
  EXPECT_FALSE(is_drawn(scene));
  EXPECT_TRUE(has_smooth_bands(scene));
  scene.fit.model = sim::FitModel::draws;
  EXPECT_TRUE(is_drawn(scene));
  EXPECT_FALSE(has_smooth_bands(scene));
  scene = scene_of_bands();
  scene.sheets[0].fold_spacing_km = 30.0;
  EXPECT_TRUE(is_drawn(scene));
  scene = scene_of_bands();
  scene.fit.weight[sim::StatisticKind::horizontal] = 0.5;
  EXPECT_FALSE(is_drawn(scene));
  EXPECT_FALSE(has_smooth_bands(scene));
}

/// A second statistic makes the cells of the film narrow; the bands' means are the same light.
TEST(ExpectedModel, WideCellsHaveTheMeansOfNarrowOnes) {
  sim::Scene scene = scene_of_bands();
  const ModelProfile wide = model_of(scene, 1);
  scene.fit.weight[sim::StatisticKind::image] = 1e-9;
  const ModelProfile narrow = model_of(scene, 1);
  // Cells of 4 pixels spread light by 1.6 across; ramps between cells of 20 do so by the blur's own width.
  EXPECT_LT(apart(wide.value, narrow.value), 0.004);
}

/// Of profiles smoothed by 4 rows: every third of the row's values, at the middle of its bin.
TEST(ExpectedModel, BinsOfThreeRowsAreWhatRowsAreInTheirMiddle) {
  const sim::Scene scene = scene_of_bands();
  const ModelProfile rows = model_of(scene, 1), bins = model_of(scene, 3);
  const std::size_t of_rows = scene.camera.height, of_bins = of_rows / 3;
  ASSERT_EQ(bins.value.size(), kBands * of_bins * 3);
  std::vector<double> middles;
  for (std::size_t band = 0; band < kBands; ++band)
    for (std::size_t bin = 0; bin < of_bins; ++bin)
      for (std::size_t c = 0; c < 3; ++c)
        middles.push_back(rows.value[(band * of_rows + 3 * bin + 1) * 3 + c]);
  // A hat of three rows adds 9/6 to the smoothing's variance of 16: 5 % of its width.
  EXPECT_LT(apart(bins.value, middles), 0.03);
}

}  // namespace
}  // namespace vegard::fit::expected_model_test
