#include "fit/sky_kind/cell_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "sim/base/number/quantile.h"

namespace vegard::fit {

FeatureCells cells_of(int width, int height) {
  constexpr int kAlongLongerSide = 64;
  FeatureCells cells;
  cells.size_px = std::max(1, (std::max(width, height) + kAlongLongerSide / 2) / kAlongLongerSide);
  cells.columns = width / cells.size_px;
  cells.rows = height / cells.size_px;
  cells.sky.assign(static_cast<std::size_t>(cells.columns) * cells.rows, 0);
  return cells;
}

bool is_cell_kept(const FeatureCells& cells, std::size_t cell, int width,
                  const std::vector<std::uint8_t>& is_kept) {
  const int x0 = static_cast<int>(cell % cells.columns) * cells.size_px,
            y0 = static_cast<int>(cell / cells.columns) * cells.size_px;
  int kept = 0;
  for (int y = y0; y < y0 + cells.size_px; ++y)
    for (int x = x0; x < x0 + cells.size_px; ++x)
      kept += is_kept.empty() || is_kept[static_cast<std::size_t>(y) * width + x] != 0 ? 1 : 0;
  return 2 * kept >= cells.size_px * cells.size_px;
}

CellLight light_of_cells(const Photo& photo, const FeatureCells& cells, bool has_white) {
  CellLight light;
  const std::size_t count = cells.sky.size();
  light.rgb.assign(count, {0.0, 0.0, 0.0});
  const int size = cells.size_px;
  std::vector<float> sums(static_cast<std::size_t>(cells.columns) * 3);
  std::vector<int> clipped(count, 0);
  for (int row = 0; row < cells.rows; ++row) {
    std::fill(sums.begin(), sums.end(), 0.0f);
    for (int y = row * size; y < (row + 1) * size; ++y) {
      const float* pixel = &photo.linear.data[photo.linear.index(0, y, 0)];
      for (int column = 0; column < cells.columns; ++column)
        for (int x = 0; x < size; ++x, pixel += 3) {
          for (int c = 0; c < 3; ++c) sums[static_cast<std::size_t>(column) * 3 + c] += pixel[c];
          if (has_white && std::max({pixel[0], pixel[1], pixel[2]}) > kClippedLight)
            ++clipped[static_cast<std::size_t>(row) * cells.columns + column];
        }
    }
    for (int column = 0; column < cells.columns; ++column)
      for (int c = 0; c < 3; ++c)
        light.rgb[static_cast<std::size_t>(row) * cells.columns + column][c] =
            sums[static_cast<std::size_t>(column) * 3 + c] / (static_cast<double>(size) * size);
  }
  light.grey.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    light.grey[i] = (light.rgb[i][0] + light.rgb[i][1] + light.rgb[i][2]) / 3.0;
    if (cells.sky[i] == 0) continue;
    light.sky.push_back(i);
    light.clipped_share = std::max(light.clipped_share, clipped[i] / (static_cast<double>(size) * size));
  }
  return light;
}

void take_smooth_sky_off(const FeatureCells& cells, CellLight& light) {
  constexpr int kTerms = 6;
  const auto basis = [&](std::size_t i) {
    const double x = 2.0 * static_cast<double>(i % cells.columns) / cells.columns - 1.0;
    const double y = 2.0 * static_cast<double>(i / cells.columns) / cells.rows - 1.0;
    Eigen::Matrix<double, kTerms, 1> b;
    b << 1.0, x, y, x * x, x * y, y * y;
    return b;
  };
  Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Identity() * 1e-9;
  Eigen::Matrix<double, kTerms, 1> right = Eigen::Matrix<double, kTerms, 1>::Zero();
  for (const std::size_t i : light.sky) {
    const auto b = basis(i);
    normal += b * b.transpose();
    right += b * light.log_grey[i];
  }
  const Eigen::Matrix<double, kTerms, 1> terms = normal.ldlt().solve(right);
  light.residual.assign(light.grey.size(), 0.0);
  for (const std::size_t i : light.sky) light.residual[i] = light.log_grey[i] - basis(i).dot(terms);
}

std::vector<CellGradient> residual_gradients(const FeatureCells& cells, const CellLight& light) {
  const int w = cells.columns, h = cells.rows;
  std::vector<CellGradient> gradients;
  for (int y = 1; y + 1 < h; ++y)
    for (int x = 1; x + 1 < w; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * w + x;
      if (cells.sky[i - 1] == 0 || cells.sky[i + 1] == 0 || cells.sky[i - w] == 0 || cells.sky[i + w] == 0)
        continue;
      gradients.push_back(
          {i, light.residual[i + 1] - light.residual[i - 1], light.residual[i + w] - light.residual[i - w]});
    }
  return gradients;
}

double elongation(const FeatureCells& cells, const std::vector<CellGradient>& gradients) {
  const int w = cells.columns, h = cells.rows;
  std::vector<std::array<double, 3>> tensor(cells.sky.size(), {0.0, 0.0, 0.0});
  for (const CellGradient& g : gradients) tensor[g.cell] = {g.x * g.x, g.x * g.y, g.y * g.y};
  constexpr int kHalf = 2;
  double coherent = 0.0, energy = 0.0;
  for (int y = kHalf; y + kHalf < h; ++y)
    for (int x = kHalf; x + kHalf < w; ++x) {
      std::array<double, 3> sum{};
      for (int v = y - kHalf; v <= y + kHalf; ++v)
        for (int u = x - kHalf; u <= x + kHalf; ++u)
          for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] += tensor[static_cast<std::size_t>(v) * w + u][k];
      energy += sum[0] + sum[2];
      coherent += std::hypot(sum[0] - sum[2], 2.0 * sum[1]);
    }
  return energy > 0.0 ? coherent / energy : 0.0;
}

std::optional<TopAndBelow> top_and_below(const CellLight& light, double clipped) {
  std::vector<double> residuals;
  residuals.reserve(light.sky.size());
  for (const std::size_t i : light.sky) residuals.push_back(light.residual[i]);
  constexpr double kBright = 0.9, kMiddle = 0.5;
  const double bright = sim::quantile(residuals, kBright), middle = sim::quantile(residuals, kMiddle);
  TopAndBelow mean;
  double tops = 0.0, belows = 0.0;
  for (const std::size_t i : light.sky) {
    if (light.grey[i] > clipped) continue;
    std::array<double, 3>* to = light.residual[i] >= bright   ? &mean.top
                                : light.residual[i] <= middle ? &mean.below
                                                              : nullptr;
    if (to == nullptr) continue;
    (to == &mean.top ? tops : belows) += 1.0;
    for (std::size_t c = 0; c < 3; ++c) (*to)[c] += light.rgb[i][c];
  }
  if (tops == 0.0 || belows == 0.0) return std::nullopt;
  for (std::size_t c = 0; c < 3; ++c) {
    mean.top[c] /= tops;
    mean.below[c] /= belows;
  }
  return mean;
}

std::optional<double> peak_above_ring(const FeatureCells& cells, const CellLight& light, std::size_t cell) {
  const int w = cells.columns, h = cells.rows;
  constexpr int kRing = 5;
  constexpr double kOfRing = 0.9;
  constexpr std::size_t kMinOfRing = 8;
  const int x = static_cast<int>(cell % w), y = static_cast<int>(cell / w);
  std::vector<double> ring;
  for (int v = std::max(0, y - kRing); v <= std::min(h - 1, y + kRing); ++v)
    for (int u = std::max(0, x - kRing); u <= std::min(w - 1, x + kRing); ++u) {
      const std::size_t other = static_cast<std::size_t>(v) * w + u;
      const int away = std::max(std::abs(u - x), std::abs(v - y));
      if (cells.sky[other] == 0) continue;
      if (away <= 1 && light.grey[other] > light.grey[cell]) return std::nullopt;
      if (away == kRing) ring.push_back(light.log_grey[other]);
    }
  if (ring.size() < kMinOfRing) return std::nullopt;
  return light.log_grey[cell] - sim::quantile(ring, kOfRing);
}

void find_points(const std::vector<float>& root, int width, int height, double step,
                 const std::function<bool(int x, int y)>& is_sky,
                 const std::function<void(int x, int y)>& found) {
  constexpr int kOff = 3;
  constexpr double kSigmas = 7.0, kOfMad = 1.4826;
  const int w = width, h = height;
  if (w <= 2 * kOff || h <= 2 * kOff) return;
  const auto above = [&](int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y) * w + x, down = static_cast<std::size_t>(kOff) * w;
    return root[i] - 0.25f * (root[i - kOff] + root[i + kOff] + root[i - down] + root[i + down]);
  };
  // Every eleventh pixel measures the noise.
  std::vector<double> heights, of_sky;
  const int area = (w - 2 * kOff) * (h - 2 * kOff);
  for (int n = 0; n < area; n += 11) {
    const int x = kOff + n % (w - 2 * kOff), y = kOff + n / (w - 2 * kOff);
    heights.push_back(std::abs(above(x, y)));
    if (is_sky && is_sky(x, y)) of_sky.push_back(heights.back());
  }
  // The dark outside of a fisheye's circle has less noise than its sky.
  constexpr std::size_t kEnough = 50;
  if (of_sky.size() > kEnough) heights = std::move(of_sky);
  const double noise =
      std::max(kOfMad * sim::quantile(heights, 0.5), 0.5 * std::sqrt(std::max(step, 1e-6)) / 16.0);
  const auto least = static_cast<float>(kSigmas * noise);
  for (int y = kOff; y + kOff < h; ++y)
    for (int x = kOff; x + kOff < w; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * w + x;
      const float here = root[i];
      if (here < root[i - 1] || here <= root[i + 1] || here < root[i - w] || here <= root[i + w]) continue;
      if (above(x, y) < least) continue;
      if (here < root[i - w - 1] || here < root[i - w + 1] || here <= root[i + w - 1] ||
          here <= root[i + w + 1])
        continue;
      found(x, y);
    }
}

}  // namespace vegard::fit
