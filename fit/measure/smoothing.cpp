#include "fit/measure/smoothing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/view/film/blur.h"

namespace vegard::fit {

Profile smoothed(const Profile& profile, double sigma_rows) {
  const sim::BlurKernel kernel = sim::gaussian_kernel(sigma_rows);
  Profile result = profile;
  for (int b = 0; b < profile.bands; ++b)
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < profile.rows; ++r) {
        double sum = 0.0, variance = 0.0, weight = 0.0;
        int count = 0;
        for (int k = -kernel.radius(); k <= kernel.radius(); ++k) {
          if (r + k < 0 || r + k >= profile.rows) continue;
          const std::size_t i = profile.index(b, r + k, c);
          if (profile.count[i] == 0) continue;
          const double w = kernel.weights[std::abs(k)];
          sum += w * profile.mean[i];
          if (std::isfinite(profile.standard_error[i]))
            variance += std::pow(w * profile.standard_error[i], 2);
          weight += w;
          count += profile.count[i];
        }
        const std::size_t i = profile.index(b, r, c);
        result.count[i] = count;
        result.mean[i] = weight > 0.0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
        result.standard_error[i] = weight > 0.0 ? std::sqrt(variance) / weight : result.mean[i];
      }
  return result;
}

namespace {

/// One grid's values, from the index `first` on.
void smooth_part(ModelProfile& model, std::size_t first, int bands, int rows, double sigma_rows) {
  const sim::BlurKernel kernel = sim::gaussian_kernel(sigma_rows);
  // One band's rows at a time: value and derivatives lie side by side, three channels to a row.
  const auto smooth_rows = [&](std::vector<double>& data, std::size_t per_value) {
    const std::size_t per_row = 3 * per_value;
    std::vector<double> from(per_row * rows);
    for (int b = 0; b < bands; ++b) {
      double* band = data.data() + first * per_value + static_cast<std::size_t>(b) * rows * per_row;
      std::copy_n(band, from.size(), from.begin());
      for (int r = 0; r < rows; ++r) {
        double* to = band + r * per_row;
        std::fill_n(to, per_row, 0.0);
        double weight = 0.0;
        for (int k = std::max(-kernel.radius(), -r); k <= std::min(kernel.radius(), rows - 1 - r); ++k) {
          const double w = kernel.weights[std::abs(k)];
          weight += w;
          const double* row = from.data() + (r + k) * per_row;
          for (std::size_t i = 0; i < per_row; ++i) to[i] += w * row[i];
        }
        for (std::size_t i = 0; i < per_row; ++i) to[i] /= weight;
      }
    }
  };
  smooth_rows(model.value, 1);
  if (model.free > 0) smooth_rows(model.derivative, model.free);
  if (!model.offset.empty()) smooth_rows(model.offset, 1);
  if (!model.offset_derivative.empty()) smooth_rows(model.offset_derivative, model.free);
}

}  // namespace

void smooth(ModelProfile& model, int bands, int rows, double sigma_rows) {
  smooth_part(model, 0, bands, rows, sigma_rows);
}

Profile smoothed_by_px(const Profile& profile, double sigma_px) {
  const double position_px = profile.grid == nullptr ? 1.0 : profile.grid->position_px;
  return sigma_px > 0.0 && position_px > 0.0 ? smoothed(profile, sigma_px / position_px) : profile;
}

void smooth(ModelProfile& model, const std::vector<std::shared_ptr<const BinGrid>>& grids, double sigma_px) {
  std::size_t first = 0;
  for (const std::shared_ptr<const BinGrid>& grid : grids) {
    if (grid->position_px > 0.0)
      smooth_part(model, first, grid->groups, grid->positions, sigma_px / grid->position_px);
    first += grid->bins() * 3;
  }
}

}  // namespace vegard::fit
