// The noise of cells: of one pixel, where their neighbours tell it, and of more, where their own pixels do.
#include "fit/measure/noise_model.h"
#include "fit/measure/profile_bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "fit/measure/bin_grid.h"

namespace vegard::fit::cell_noise_test {
namespace {

constexpr int kGreen = 1;
const Region kAll{0, 0, 120, 100};

template <class Light>
Photo picture(const Light& light) {
  Photo photo;
  photo.linear = sim::Image(kAll.width, kAll.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  for (int y = 0; y < kAll.height; ++y)
    for (int x = 0; x < kAll.width; ++x)
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = static_cast<float>(light(x, y));
  return photo;
}

/// Of the cells that have any light.
double mean_variance(const Photo& photo, int cell_px) {
  const auto grid = std::make_shared<const BinGrid>(image_bins(column_bins(kAll, 1), cell_px));
  const Profile cells = extract_profile(photo, grid);
  const std::vector<double> variances = cell_variances(sim::Scene(), photo, cells, kGreen);
  double sum = 0.0, count = 0.0;
  for (std::size_t b = 0; b < variances.size(); ++b) {
    if (cells.count[b * 3 + kGreen] == 0) continue;
    sum += variances[b];
    count += 1.0;
  }
  return sum / count;
}

// Noise of the variance v on every pixel is v / n² in cells of n². On a slope, a hill as wide as the picture
// and a straight edge, which are none. A median of 12000 numbers, each of which shares light with others,
// tells a variance to some 4 %: twice that.
TEST(CellNoise, IsThatOfThePixelsWhateverTheCell) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 0.03);
  const Photo photo = picture([&](int x, int y) {
    return 2.0 + 0.004 * x - 0.003 * y + 0.5 * std::exp(-std::hypot(x - 50.0, y - 40.0) / 60.0) +
           (x < 64 ? 0.0 : 0.7) + normal(random);
  });
  EXPECT_NEAR(mean_variance(photo, 1) / (0.03 * 0.03), 1.0, 0.08);
  EXPECT_NEAR(mean_variance(photo, 2) / (0.03 * 0.03 / 4.0), 1.0, 0.08);
}

// Where pixels are masked, those around have no nine; the mean of the others stands in.
TEST(CellNoise, KnowsHolesAndQuietPictures) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal(0.0, 0.03);
  Photo photo = picture([&](int, int) { return 2.0 + normal(random); });
  for (int y = 40; y < 60; ++y)
    for (int x = 30; x < 70; ++x) {
      photo.linear.at(x, y, kGreen) = 50.0f;
      photo.usable[photo.linear.index(x, y, kGreen)] = 0;
    }
  EXPECT_NEAR(mean_variance(photo, 1) / (0.03 * 0.03), 1.0, 0.08);
  EXPECT_NEAR(mean_variance(picture([](int x, int y) { return 1.0 + 0.25 * x + 0.5 * y; }), 1), 0.0, 1e-12);
}

}  // namespace
}  // namespace vegard::fit::cell_noise_test
