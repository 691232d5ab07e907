#include "fit/photo/mask/local_noise.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {
namespace {

float quantile(std::vector<float>& values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

LocalNoise::LocalNoise(const Plane& values, const Plane& level, const std::function<double(double)>& floor) {
  // The last tile of a row takes what is left over, so that none is too small for a median.
  columns_ = std::max(1, values.width / kTile_px);
  rows_ = std::max(1, values.height / kTile_px);
  std::vector<float> sample, levels;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const int right = column + 1 == columns_ ? values.width : (column + 1) * kTile_px;
      const int bottom = row + 1 == rows_ ? values.height : (row + 1) * kTile_px;
      sample.clear();
      levels.clear();
      for (int y = row * kTile_px; y < bottom; ++y)
        for (int x = column * kTile_px; x < right; ++x) {
          sample.push_back(values.at(x, y));
          levels.push_back(level.at(x, y));
        }
      const float middle = fit::median(sample);
      const float upper = quantile(sample, 0.8413), far = quantile(sample, 0.9772);
      for (float& value : sample) value = std::abs(value - middle);
      const double spread = std::max({1.4826f * fit::median(sample), upper - middle, 0.5f * (far - middle)});
      median_.push_back(middle);
      sigma_.push_back(static_cast<float>(std::max(spread, floor(fit::median(levels)))));
    }
}

LocalNoise::Usual LocalNoise::at(int x, int y) const {
  const auto place = [](int pixel, int tiles, int& first, float& weight) {
    const float tile = std::clamp((pixel + 0.5f) / kTile_px - 0.5f, 0.0f, static_cast<float>(tiles - 1));
    first = std::min(static_cast<int>(tile), std::max(0, tiles - 2));
    weight = tile - static_cast<float>(first);
  };
  int column = 0, row = 0;
  float right = 0.0f, down = 0.0f;
  place(x, columns_, column, right);
  place(y, rows_, row, down);
  const int next_column = std::min(column + 1, columns_ - 1), next_row = std::min(row + 1, rows_ - 1);
  const auto mixed = [&](const std::vector<float>& of) {
    const float upper = (1 - right) * of[row * columns_ + column] + right * of[row * columns_ + next_column];
    const float lower =
        (1 - right) * of[next_row * columns_ + column] + right * of[next_row * columns_ + next_column];
    return (1 - down) * upper + down * lower;
  };
  return {mixed(median_), mixed(sigma_)};
}

}  // namespace vegard::fit
