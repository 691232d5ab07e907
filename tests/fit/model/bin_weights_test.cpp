// The weights of a profile's bins against the profile that a photograph has itself.
#include "fit/model/profile_model.h"

#include <gtest/gtest.h>

#include <cstddef>

#include "fit/measure/profile.h"

namespace vegard::fit::bin_weights_test {
namespace {

/// The light of pixel x, y in channel c, the same all over a cell of three by one pixels.
float light(int x, int y, int c) { return static_cast<float>((x / 3 * 7 + y * 5 + c * 3) % 11) / 16.0f; }

TEST(BinWeights, OfRowsGiveTheMeansOfThePhotographWithItsMask) {
  Photo photo;
  photo.linear = sim::Image(60, 20, {"R", "G", "B"});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 60; ++x)
      for (int c = 0; c < 3; ++c) photo.linear.data[photo.linear.index(x, y, c)] = light(x, y, c);
  photo.usable.assign(photo.linear.data.size(), 1);
  for (std::size_t i = 0; i < photo.usable.size(); i += 7) photo.usable[i] = 0;
  for (int x = 0; x < 60; ++x) photo.usable[photo.linear.index(x, 9, 1)] = 0;  // a row without green

  const Region region{6, 4, 50, 12};
  sim::FilmGeometry film;
  film.cell_width_px = 3.0;
  film.x0_px = 6.0 - 4 * 3.0;
  film.y0_px = 4.0 - 2.0;
  film.columns = 25;
  film.rows = 16;
  const Profile profile = extract_profile(photo, region, 3);
  const sim::CellWeights weights = bin_weights(photo, {profile.grid}, film);
  ASSERT_EQ(weights.means() * 3, profile.mean.size());
  for (std::size_t bin = 0; bin < weights.means(); ++bin) {
    for (int c = 0; c < 3; ++c) {
      double sum = 0.0, pixels = 0.0;
      for (std::size_t r = weights.first_run[bin]; r < weights.first_run[bin + 1]; ++r) {
        const sim::CellWeights::Run& run = weights.runs[r];
        for (int i = 0; i < run.columns; ++i) {
          const float weight = weights.pixels[run.first_pixels + i * 3 + c];
          const int x = static_cast<int>(film.x0_px) + (run.first_column + i) * 3;
          pixels += weight;
          sum += weight * light(x, static_cast<int>(film.y0_px) + run.row, c);
        }
      }
      const std::size_t i = bin * 3 + c;
      EXPECT_EQ(pixels, profile.count[i]);
      if (profile.count[i] == 0)
        EXPECT_EQ(weights.inverse[i], 0.0f);
      else  // 1 / count is a float
        EXPECT_NEAR(sum * weights.inverse[i], profile.mean[i], 1e-6);
    }
  }
}

}  // namespace
}  // namespace vegard::fit::bin_weights_test
