#include "sim/view/film/soft_light.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sim/view/film/blur.h"

namespace vegard::sim {
namespace {

/// Weights that reach past a plane from any place in it meet nothing but darkness.
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
