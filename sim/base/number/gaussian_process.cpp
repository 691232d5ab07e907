#include "sim/base/number/gaussian_process.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/distributions.h"

namespace vegard::sim {
namespace {

constexpr double kKernelReach = 4.5;  // of the kernel, in its standard deviations
constexpr int kKernelNodes = 11;
constexpr std::int64_t kMaxRemembered = 1 << 16;
// In nodes to a width: 4 sqrt(ln 2), from exp(-δ²/4) = 1/2 at half the width.
constexpr double kNodesPerWidth = 3.3302184446307908;
// The squares of the kernel at nodes one standard deviation apart sum to sqrt(pi).
constexpr double kNorm = 0.7511255444649425;  // pi^(-1/4)

/// The kernel at the nodes around a place, in units of nodes.
struct Kernel {
  std::int64_t first;
  int count;
  double weight[kKernelNodes];

  explicit Kernel(double place) : first(static_cast<std::int64_t>(std::ceil(place - kKernelReach))) {
    const auto last = static_cast<std::int64_t>(std::floor(place + kKernelReach));
    count = static_cast<int>(last - first) + 1;
    // exp(-(x - k)²/2) is exp(-x²/2) times powers of exp(x) times constants.
    static const struct Constants {
      double of[kKernelNodes];
      Constants() {
        for (int k = 0; k < kKernelNodes; ++k) of[k] = std::exp(-0.5 * k * k);
      }
    } constants;
    const double x = place - static_cast<double>(first), grow = std::exp(x);
    double factor = kNorm * std::exp(-0.5 * x * x);
    for (int k = 0; k < count; ++k) {
      weight[k] = factor * constants.of[k];
      factor *= grow;
    }
  }
};

/// A white Gaussian number.
double white(std::uint64_t seed, Stream stream, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  return normal_quantile(uniform(random_words(seed, stream, i, j, k)[0]));
}

std::uint32_t word(std::int64_t index) { return static_cast<std::uint32_t>(index); }

}  // namespace

GaussianGrid::GaussianGrid(std::uint64_t seed, Stream stream, std::uint32_t address, double width,
                           double instant, double lifetime)
    : seed_(seed),
      stream_(stream),
      address_(address),
      per_width_(kNodesPerWidth / width),
      time_(lifetime > 0.0 ? instant * kNodesPerWidth / lifetime : 0.0),
      lasts_(lifetime <= 0.0) {}

void GaussianProcess::remember(double first, double last) {
  first_ = static_cast<std::int64_t>(std::floor(first * per_width_ - kKernelReach));
  const auto end = static_cast<std::int64_t>(std::ceil(last * per_width_ + kKernelReach)) + 1;
  nodes_.assign(static_cast<std::size_t>(std::clamp<std::int64_t>(end - first_, 0, kMaxRemembered)),
                std::numeric_limits<double>::quiet_NaN());
}

double GaussianProcess::fresh_node(std::int64_t index) const {
  if (lasts_) return white(seed_, stream_, word(index), address_, 0);
  const Kernel kernel(time_);
  double sum = 0.0;
  for (int k = 0; k < kernel.count; ++k)
    sum += kernel.weight[k] * white(seed_, stream_, word(index), address_, word(kernel.first + k));
  return sum;
}

double GaussianProcess::node(std::int64_t index) {
  if (index < first_ || index - first_ >= static_cast<std::int64_t>(nodes_.size())) return fresh_node(index);
  double& remembered = nodes_[static_cast<std::size_t>(index - first_)];
  if (std::isnan(remembered)) remembered = fresh_node(index);
  return remembered;
}

double GaussianProcess::at(double place) {
  const Kernel kernel(place * per_width_);
  double sum = 0.0;
  for (int k = 0; k < kernel.count; ++k) sum += kernel.weight[k] * node(kernel.first + k);
  return sum;
}

double GaussianField::fresh_node(std::int64_t i, std::int64_t j) const {
  // Two rows of a field are as independent as two addresses.
  const std::uint32_t row =
      random_words(seed_, stream_, address_, word(j), 0xFFFFFFFFu)[0];  // of a row, not of a node
  if (lasts_) return white(seed_, stream_, word(i), row, 0);
  const Kernel kernel(time_);
  double sum = 0.0;
  for (int k = 0; k < kernel.count; ++k)
    sum += kernel.weight[k] * white(seed_, stream_, word(i), row, word(kernel.first + k));
  return sum;
}

double GaussianField::at(double x, double y) {
  const Kernel along(x * per_width_), across(y * per_width_);
  double sum = 0.0;
  for (int j = 0; j < across.count; ++j) {
    double row = 0.0;
    for (int i = 0; i < along.count; ++i) {
      const std::int64_t column_index = along.first + i, row_index = across.first + j;
      const std::uint64_t key = static_cast<std::uint64_t>(word(column_index)) << 32 | word(row_index);
      const auto [at, is_new] = nodes_.try_emplace(key, 0.0);
      if (is_new) at->second = fresh_node(column_index, row_index);
      row += along.weight[i] * at->second;
    }
    sum += across.weight[j] * row;
  }
  return sum;
}

}  // namespace vegard::sim
