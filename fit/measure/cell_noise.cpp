#include "fit/measure/cell_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kMask[3] = {1.0, -2.0, 1.0};   ///< the nine are its products
constexpr double kSquares = 36.0;               ///< sum of the squares of the nine
constexpr double kMedian = 0.6744897501960817;  ///< of |x|, x normal and of variance 1

/// NaN if one of the nine is beyond the picture or unusable.
double nine_about(const Photo& photo, int x, int y, int channel) {
  if (x < 1 || y < 1 || x + 1 >= photo.linear.width || y + 1 >= photo.linear.height) return sim::kNaN;
  double sum = 0.0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const std::size_t i = photo.linear.index(x + dx, y + dy, channel);
      if (!photo.usable[i]) return sim::kNaN;
      sum += kMask[dy + 1] * kMask[dx + 1] * photo.linear.data[i];
    }
  return sum;
}

}  // namespace

std::vector<double> cell_variances(const sim::Scene& scene, const Photo& photo, const Profile& cells,
                                   int channel) {
  const BinGrid& grid = *cells.grid;
  std::vector<double> sizes;
  for (const BinGrid::Run& run : grid.runs)
    for (int x = run.begin; x < run.end; ++x)
      if (const double sum = nine_about(photo, x, run.y, channel); !std::isnan(sum))
        sizes.push_back(std::abs(sum));
  double of_pixel = 0.0;
  if (!sizes.empty()) {
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    of_pixel = std::pow(*middle / kMedian, 2) / kSquares;
  }
  const bool of_sensor = scene.fit.photo_noise == sim::PhotoNoise::sensor;
  std::vector<double> variances(grid.bins(), 0.0);
  for (std::size_t b = 0; b < grid.bins(); ++b) {
    const std::size_t i = b * 3 + static_cast<std::size_t>(channel);
    if (cells.count[i] == 0) continue;
    const double step = code_step(photo, cells.mean[i]);
    variances[b] = of_sensor ? std::pow(cells.standard_error[i], 2)
                             : std::max(of_pixel, step * step / 12.0) / cells.count[i];
  }
  return variances;
}

}  // namespace vegard::fit
