#include "fit/photo/mask/plane.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr double kEvenOffset = 0.002;

}  // namespace

Plane mean_light(const Photo& photo) {
  Plane plane(photo.linear.width, photo.linear.height);
  for (std::size_t i = 0; i < plane.value.size(); ++i)
    plane.value[i] =
        (photo.linear.data[3 * i] + photo.linear.data[3 * i + 1] + photo.linear.data[3 * i + 2]) / 3.0f;
  return plane;
}

Plane channel_light(const Photo& photo, int channel) {
  Plane plane(photo.linear.width, photo.linear.height);
  for (std::size_t i = 0; i < plane.value.size(); ++i) plane.value[i] = photo.linear.data[3 * i + channel];
  return plane;
}

Plane binned(const Plane& plane, int factor) {
  if (factor <= 1) return plane;
  Plane result((plane.width + factor - 1) / factor, (plane.height + factor - 1) / factor);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      double sum = 0.0;
      int pixels = 0;
      for (int v = y * factor; v < std::min((y + 1) * factor, plane.height); ++v)
        for (int u = x * factor; u < std::min((x + 1) * factor, plane.width); ++u, ++pixels)
          sum += plane.at(u, v);
      result.at(x, y) = static_cast<float>(sum / pixels);
    }
  return result;
}

double white_of(const Plane& light) {
  if (light.value.empty()) return 1.0;
  std::vector<float> values = light.value;
  const float bright = sim::quantile(values, 0.999);
  return bright > 0.0f ? bright : 1.0;
}

Plane shown_brightness(const Plane& light) {
  Plane result = light;
  const double white = white_of(light);
  for (float& value : result.value)
    value = static_cast<float>(std::sqrt(std::clamp(value / white, 0.0, 1.0)));
  return result;
}

Plane even_noise(const Plane& light) {
  Plane result = light;
  const double white = white_of(light);
  for (float& value : result.value)
    value = static_cast<float>(std::sqrt(std::max(0.0, value / white) + kEvenOffset));
  return result;
}

double even_noise_slope(double light, double white) {
  return 0.5 / (white * std::sqrt(std::max(0.0, light / white) + kEvenOffset));
}

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
      const float middle = sim::median(sample);
      const float upper = sim::quantile(sample, 0.8413), far = sim::quantile(sample, 0.9772);
      for (float& value : sample) value = std::abs(value - middle);
      const double spread = std::max({1.4826f * sim::median(sample), upper - middle, 0.5f * (far - middle)});
      median_.push_back(middle);
      sigma_.push_back(static_cast<float>(std::max(spread, floor(sim::median(levels)))));
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
  const auto mixed = [&](const std::vector<float>& values) {
    const float upper =
        (1 - right) * values[row * columns_ + column] + right * values[row * columns_ + next_column];
    const float lower = (1 - right) * values[next_row * columns_ + column] +
                        right * values[next_row * columns_ + next_column];
    return (1 - down) * upper + down * lower;
  };
  return {mixed(median_), mixed(sigma_)};
}

}  // namespace vegard::fit
