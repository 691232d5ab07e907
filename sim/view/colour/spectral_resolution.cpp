#include "sim/view/colour/spectral_resolution.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace vegard::sim {
namespace {

/// Where a kernel falls through half of its height, from its peak in steps of `direction`, in grid steps.
double half_height(const std::vector<double>& kernel, int peak, int direction) {
  const double half = 0.5 * kernel[peak];
  const int count = static_cast<int>(kernel.size());
  int i = peak;
  while (i + direction >= 0 && i + direction < count && kernel[i + direction] > half) i += direction;
  if (i + direction < 0 || i + direction >= count) return i;
  return i + direction * (kernel[i] - half) / (kernel[i] - kernel[i + direction]);
}

}  // namespace

ResolvingKernel resolving_kernel(const SensorResponse& response, double wavelength_nm) {
  std::vector<Eigen::Vector3d> channels;
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (double nm = response.first_nm(); nm <= response.last_nm(); nm += 1.0) {
    const Vector3 of_power = response.channels_of_power(nm);
    channels.emplace_back(of_power[0] / nm, of_power[1] / nm, of_power[2] / nm);
    area += channels.back();
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < channels.size(); ++i) {
    channels[i] = channels[i].cwiseQuotient(area);
    const double away = response.first_nm() + static_cast<double>(i) - wavelength_nm;
    spread += 12.0 * away * away * channels[i] * channels[i].transpose();
  }
  // All areas are 1, and so is the sum of the weights.
  const Eigen::Vector3d narrowest = spread.ldlt().solve(Eigen::Vector3d::Ones());
  const Eigen::Vector3d weights = narrowest / narrowest.sum();
  ResolvingKernel result;
  result.weights = {weights(0), weights(1), weights(2)};
  result.spread_nm = weights.dot(spread * weights);
  std::vector<double> kernel;
  for (const Eigen::Vector3d& channel : channels) kernel.push_back(weights.dot(channel));
  const int peak = static_cast<int>(std::max_element(kernel.begin(), kernel.end()) - kernel.begin());
  result.peak_nm = response.first_nm() + peak;
  result.fwhm_nm = half_height(kernel, peak, 1) - half_height(kernel, peak, -1);
  return result;
}

}  // namespace vegard::sim
