#include "sim/view/film/blur.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/view/film/blur.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// out[i] = weights[0] in[i] + sum over k of weights[k] (before[k][i] + after[k][i]); a null pointer is
/// darkness.
void WeightedSum(const float* in, const float* const* before, const float* const* after, const float* weights,
                 int radius, float* out, std::size_t count) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    auto sum = hn::Mul(hn::LoadU(d, in + i), hn::Set(d, weights[0]));
    for (int k = 1; k <= radius; ++k) {
      auto pair = hn::Zero(d);
      if (before[k] != nullptr) pair = hn::LoadU(d, before[k] + i);
      if (after[k] != nullptr) pair = hn::Add(pair, hn::LoadU(d, after[k] + i));
      sum = hn::Add(sum, hn::Mul(pair, hn::Set(d, weights[k])));
    }
    hn::StoreU(sum, d, out + i);
  }
  for (; i < count; ++i) {
    float sum = in[i] * weights[0];
    for (int k = 1; k <= radius; ++k) {
      float pair = 0.0f;
      if (before[k] != nullptr) pair = before[k][i];
      if (after[k] != nullptr) pair = pair + after[k][i];
      sum = sum + pair * weights[k];
    }
    out[i] = sum;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegard::sim {

HWY_EXPORT(WeightedSum);

namespace {

constexpr double kBlurReach = 4.0;  // standard deviations
constexpr int kRowsPerTask = 16;

int reach(double sigma, int radius) {
  return radius >= 0 ? radius : static_cast<int>(std::ceil(kBlurReach * sigma));
}

/// Returns the normal distribution function.
double normal_share_below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }
double density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::acos(-1.0)); }

template <class Body>
void for_blocks(int rows, int threads, const Body& body) {
  const std::size_t tasks = static_cast<std::size_t>((rows + kRowsPerTask - 1) / kRowsPerTask);
  parallel_for(tasks, threads, [&](std::size_t task, int) {
    const int first = static_cast<int>(task) * kRowsPerTask;
    body(first, std::min(rows, first + kRowsPerTask));
  });
}

template <class Body>
void for_rows(int rows, int threads, const Body& body) {
  for_blocks(rows, threads, [&](int first, int end) {
    for (int row = first; row < end; ++row) body(row);
  });
}

/// Returns the kernel cut to a plane: weights that reach past it from any place in it meet nothing but
/// darkness.
BlurKernel within(BlurKernel kernel, int cells) {
  if (kernel.weights.size() > static_cast<std::size_t>(cells)) kernel.weights.resize(cells);
  return kernel;
}

/// Calls use(plane, its blurred copy, how many numbers) for each.
template <class Use>
void for_blurred(const Planes& planes, double sigma_down, double sigma_across, int threads, const Use& use) {
  if (planes.rows < 1 || planes.columns < 1) return;
  const std::size_t size = static_cast<std::size_t>(planes.rows) * planes.columns * planes.channels;
  const BlurKernel down = within(gaussian_kernel(sigma_down), planes.rows);
  const BlurKernel across = within(gaussian_kernel(sigma_across), planes.columns);
  std::vector<float> half(size), blurred(size);
  for (int p = 0; p < planes.count; ++p) {
    float* plane = planes.data + p * size;
    blur_down(plane, half.data(), planes.rows, planes.columns, planes.channels, down, threads);
    blur_across(half.data(), blurred.data(), planes.rows, planes.columns, planes.channels, across, threads);
    use(plane, blurred, size);
  }
}

}  // namespace

BlurKernel gaussian_kernel(double sigma, int radius) {
  if (sigma <= 0.0) return {{1.0f}};
  const int n = reach(sigma, radius);
  std::vector<double> weights(n + 1);
  double sum = 0.0;
  for (int k = 0; k <= n; ++k) {
    weights[k] = normal_share_below((k + 0.5) / sigma) - normal_share_below((k - 0.5) / sigma);
    sum += (k == 0 ? 1.0 : 2.0) * weights[k];
  }
  BlurKernel kernel;
  for (double w : weights) kernel.weights.push_back(static_cast<float>(w / sum));
  return kernel;
}

double kernel_variance(const BlurKernel& kernel) {
  double sum = kernel.weights[0], moment = 0.0;
  for (int k = 1; k <= kernel.radius(); ++k) {
    sum += 2.0 * kernel.weights[k];
    moment += 2.0 * kernel.weights[k] * k * k;
  }
  return moment / sum;
}

BlurKernel gaussian_kernel_derivative(double sigma, int radius) {
  const int n = reach(sigma, radius);
  std::vector<double> weights(n + 1), growth(n + 1);
  double sum = 0.0, sum_growth = 0.0;
  for (int k = 0; k <= n; ++k) {
    const double high = (k + 0.5) / sigma, low = (k - 0.5) / sigma;
    weights[k] = normal_share_below(high) - normal_share_below(low);
    growth[k] = (low * density(low) - high * density(high)) / sigma;
    sum += (k == 0 ? 1.0 : 2.0) * weights[k];
    sum_growth += (k == 0 ? 1.0 : 2.0) * growth[k];
  }
  BlurKernel kernel;
  for (int k = 0; k <= n; ++k)
    kernel.weights.push_back(static_cast<float>(growth[k] / sum - weights[k] * sum_growth / (sum * sum)));
  return kernel;
}

void blur_down_row(const float* in, float* out, int rows, int columns, int channels, const BlurKernel& kernel,
                   int row) {
  const std::ptrdiff_t pitch = static_cast<std::ptrdiff_t>(columns) * channels;
  const int radius = kernel.radius();
  std::vector<const float*> before(radius + 1, nullptr), after(radius + 1, nullptr);
  for (int k = 1; k <= radius; ++k) {
    if (row - k >= 0) before[k] = in + (row - k) * pitch;
    if (row + k < rows) after[k] = in + (row + k) * pitch;
  }
  HWY_DYNAMIC_DISPATCH(WeightedSum)
  (in + row * pitch, before.data(), after.data(), kernel.weights.data(), radius, out,
   static_cast<std::size_t>(pitch));
}

void blur_down(const float* in, float* out, int rows, int columns, int channels, const BlurKernel& kernel,
               int threads) {
  const std::ptrdiff_t pitch = static_cast<std::ptrdiff_t>(columns) * channels;
  for_rows(rows, threads,
           [&](int row) { blur_down_row(in, out + row * pitch, rows, columns, channels, kernel, row); });
}

void blur_across(const float* in, float* out, int rows, int columns, int channels, const BlurKernel& kernel,
                 int threads) {
  const std::ptrdiff_t pitch = static_cast<std::ptrdiff_t>(columns) * channels;
  const int radius = kernel.radius();
  for_rows(rows, threads, [&](int row) {
    // The row with darkness on both sides, so that every shift of it is an ordinary array.
    const std::ptrdiff_t margin = static_cast<std::ptrdiff_t>(radius) * channels;
    std::vector<float> wide(static_cast<std::size_t>(pitch + 2 * margin), 0.0f);
    std::copy_n(in + row * pitch, pitch, wide.begin() + margin);
    const float* centre = wide.data() + margin;
    std::vector<const float*> before(radius + 1, nullptr), after(radius + 1, nullptr);
    for (int k = 1; k <= radius; ++k) {
      before[k] = centre - static_cast<std::ptrdiff_t>(k) * channels;
      after[k] = centre + static_cast<std::ptrdiff_t>(k) * channels;
    }
    HWY_DYNAMIC_DISPATCH(WeightedSum)
    (centre, before.data(), after.data(), kernel.weights.data(), radius, out + row * pitch,
     static_cast<std::size_t>(pitch));
  });
}

void blur_window(const float* in, int rows, int columns, const std::vector<PlaneBlur>& blurs,
                 const Window& window, float* out, int threads) {
  const std::ptrdiff_t pitch = static_cast<std::ptrdiff_t>(blurs.size());
  // To wake threads takes longer than to blur few pixels.
  constexpr int kFewPixels = 16384;
  if (window.rows * window.columns < kFewPixels) threads = 1;
  for_blocks(window.rows, threads, [&](int first_row, int end_row) {
    std::vector<float> down, both(window.columns);
    std::vector<const float*> before, after;
    for (std::ptrdiff_t plane = 0; plane < pitch; ++plane) {
      const BlurKernel &by_rows = blurs[plane].down, &by_columns = blurs[plane].across;
      const int reach_down = by_rows.radius(), reach_across = by_columns.radius();
      // What the window needs of a row that is blurred down; beyond the plane's edges it stays dark.
      const int first = std::max(0, window.first_column - reach_across);
      const int end = std::min(columns, window.first_column + window.columns + reach_across);
      const int dark = first - (window.first_column - reach_across);
      down.assign(static_cast<std::size_t>(window.columns) + 2 * reach_across, 0.0f);
      before.assign(std::max(reach_down, reach_across) + 1, nullptr);
      after.assign(before.size(), nullptr);
      for (int y = first_row; y < end_row; ++y) {
        const int row = window.first_row + y;
        const float* centre = in + (plane * rows + row) * columns + first;
        for (int k = 1; k <= reach_down; ++k) {
          const std::ptrdiff_t away = static_cast<std::ptrdiff_t>(k) * columns;
          before[k] = row - k >= 0 ? centre - away : nullptr;
          after[k] = row + k < rows ? centre + away : nullptr;
        }
        HWY_DYNAMIC_DISPATCH(WeightedSum)
        (centre, before.data(), after.data(), by_rows.weights.data(), reach_down, down.data() + dark,
         static_cast<std::size_t>(end - first));
        for (int k = 1; k <= reach_across; ++k) {
          before[k] = down.data() + reach_across - k;
          after[k] = down.data() + reach_across + k;
        }
        HWY_DYNAMIC_DISPATCH(WeightedSum)
        (down.data() + reach_across, before.data(), after.data(), by_columns.weights.data(), reach_across,
         both.data(), both.size());
        float* to = out + static_cast<std::ptrdiff_t>(y) * window.columns * pitch + plane;
        for (int x = 0; x < window.columns; ++x) to[x * pitch] = both[x];
      }
    }
  });
}

void soften(const Planes& planes, double sigma_down, double sigma_across, int threads) {
  for_blurred(planes, sigma_down, sigma_across, threads,
              [](float* plane, const std::vector<float>& blurred, std::size_t) {
                std::copy(blurred.begin(), blurred.end(), plane);
              });
}

void spread_glow(const Planes& planes, double share, double sigma_down, double sigma_across, int threads) {
  const auto spread = static_cast<float>(share);
  for_blurred(planes, sigma_down, sigma_across, threads,
              [&](float* plane, const std::vector<float>& blurred, std::size_t size) {
                for (std::size_t i = 0; i < size; ++i) plane[i] += spread * (blurred[i] - plane[i]);
              });
}

}  // namespace vegard::sim
#endif
