#include "fit/report/compared_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

struct ComparedCell {
  double data = sim::kNaN, sigma = sim::kNaN, model = sim::kNaN;
};

ComparedCell mean_over_bands(const FittedPhoto& fitted, int first_band, int end_band, int row, int channel) {
  double count = 0.0, data = 0.0, model = 0.0, variance = 0.0;
  for (int band = first_band; band < end_band; ++band) {
    const std::size_t i = fitted.data.index(band, row, channel);
    if (i >= fitted.sigma.size() || i >= fitted.model.size()) continue;
    const double n = fitted.data.count[i];
    if (n == 0 || !(fitted.sigma[i] > 0.0)) continue;
    count += n;
    data += n * fitted.data.mean[i];
    model += n * fitted.model[i];
    variance += std::pow(n * fitted.sigma[i], 2);
  }
  if (count == 0.0) return {};
  return {data / count, std::sqrt(variance) / count, model / count};
}

ComparedCell mean_over_rows(const FittedPhoto& fitted, int first_band, int end_band, int first_row,
                            int end_row, int channel) {
  int rows = 0;
  double data = 0.0, model = 0.0, variance = 0.0;
  for (int row = first_row; row < end_row; ++row) {
    const ComparedCell cell = mean_over_bands(fitted, first_band, end_band, row, channel);
    if (!std::isfinite(cell.data)) continue;
    ++rows;
    data += cell.data;
    model += cell.model;
    variance += cell.sigma * cell.sigma;
  }
  if (rows == 0) return {};
  return {data / rows, std::sqrt(variance / rows), model / rows};
}

/// One row of one band, so that its colour is computed where every colour is.
Chromaticity colour_of(const std::array<std::vector<double>, 3>& light,
                       const std::array<std::vector<double>, 3>& sigma, std::size_t i) {
  Profile profile;
  profile.bands = profile.rows = 1;
  for (int c = 0; c < 3; ++c) {
    profile.mean.push_back(light[c][i]);
    profile.standard_error.push_back(sigma[c][i]);
    profile.count.push_back(std::isfinite(light[c][i]) ? 1 : 0);
  }
  return chromaticity(profile, 0, 0);
}

}  // namespace

ComparedProfile compared_profile(const FittedPhoto& fitted, int first_band, int end_band, int max_points,
                                 const ElevationOfPixel& elevation_of_pixel) {
  const Profile& data = fitted.data;
  const int rows_each = std::max(1, (data.rows + max_points - 1) / max_points);
  const double middle =
      0.5 * (band_begin(data.region, data.bands, first_band) + band_begin(data.region, data.bands, end_band));
  ComparedProfile profile;
  for (int row = 0; row < data.rows; row += rows_each) {
    const int end_row = std::min(data.rows, row + rows_each);
    const double y_px = data.region.y + 0.5 * (row + end_row);
    profile.height.push_back(elevation_of_pixel ? elevation_of_pixel(middle, y_px) : y_px);
    for (int c = 0; c < 3; ++c) {
      const ComparedCell cell = mean_over_rows(fitted, first_band, end_band, row, end_row, c);
      profile.data[c].push_back(cell.data);
      profile.sigma[c].push_back(cell.sigma);
      profile.model[c].push_back(cell.model);
    }
  }
  return profile;
}

ComparedColour compared_colour(const ComparedProfile& profile) {
  ComparedColour colour;
  for (std::size_t i = 0; i < profile.height.size(); ++i) {
    const Chromaticity data = colour_of(profile.data, profile.sigma, i);
    const Chromaticity model = colour_of(profile.model, profile.sigma, i);
    colour.data_r.push_back(data.r);
    colour.data_g.push_back(data.g);
    colour.sigma_r.push_back(data.sigma_r);
    colour.sigma_g.push_back(data.sigma_g);
    colour.model_r.push_back(model.r);
    colour.model_g.push_back(model.g);
  }
  return colour;
}

}  // namespace vegard::fit
