#include "fit/measure/noise_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fit/measure/profile.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr double kSkyPercentile = 0.05;
constexpr double kPeakShare = 0.1;
constexpr int kHalvings = 40;
constexpr double kMinShare = 1e-12;  // of a variance: rounding

template <class Body>
void for_values(const Profile& p, const Body& body) {
  for (int b = 0; b < p.bands; ++b)
    for (int r = 0; r < p.rows; ++r)
      for (int c = 0; c < 3; ++c)
        if (const std::size_t i = p.index(b, r, c); p.count[i] > 0) body(i, c);
}

std::array<double, 3> channel_peaks(const Profile& profile, const std::array<double, 3>& sky) {
  std::array<double, 3> peak{0.0, 0.0, 0.0};
  for_values(profile, [&](std::size_t i, int c) { peak[c] = std::max(peak[c], profile.mean[i] - sky[c]); });
  return peak;
}

}  // namespace

std::array<double, 3> sky_level(const Profile& profile) {
  std::array<std::vector<double>, 3> values;
  for_values(profile, [&](std::size_t i, int c) { values[c].push_back(profile.mean[i]); });
  std::array<double, 3> level{0.0, 0.0, 0.0};
  for (int c = 0; c < 3; ++c)
    if (!values[c].empty()) level[c] = sim::quantile(values[c], kSkyPercentile);
  return level;
}

double profile_peak(const Profile& profile) {
  const std::array<double, 3> peaks = channel_peaks(profile, sky_level(profile));
  return std::max({peaks[0], peaks[1], peaks[2]});
}

std::vector<double> profile_sigma(const Profile& profile, double model_error) {
  return profile_sigma(profile, model_error, kPeakShare);
}

std::vector<double> profile_sigma(const Profile& profile, double model_error, double peak_share) {
  const std::array<double, 3> sky = sky_level(profile);
  const std::array<double, 3> peak = channel_peaks(profile, sky);
  std::vector<double> sigma(profile.mean.size(), 0.0);
  for_values(profile, [&](std::size_t i, int c) {
    const double own = std::isfinite(profile.standard_error[i]) ? profile.standard_error[i] : 0.0;
    const double local = model_error * std::max(profile.mean[i] - sky[c], 0.0);
    const double floor = peak_share * model_error * peak[c];
    sigma[i] = std::sqrt(own * own + local * local + floor * floor);
  });
  return sigma;
}

std::optional<double> found_model_error(const Profile& data, const std::vector<double>& model,
                                        const std::vector<double>& sigma, double model_error,
                                        double expected) {
  Profile noiseless = data;
  std::fill(noiseless.standard_error.begin(), noiseless.standard_error.end(), 0.0);
  const std::vector<double> whole_light_sigma = profile_sigma(noiseless, 1.0);
  const auto sum_of_squares = [&](double share) {
    double sum = 0.0;
    for (std::size_t i = 0; i < sigma.size(); ++i) {
      if (sigma[i] <= 0.0) continue;
      const double light = whole_light_sigma[i] * whole_light_sigma[i];
      const double noise = std::max(0.0, sigma[i] * sigma[i] - model_error * model_error * light);
      const double residual = data.mean[i] - model[i];
      sum += residual * residual / std::max(noise + share * share * light, kMinShare * sigma[i] * sigma[i]);
    }
    return sum;
  };
  if (sum_of_squares(0.0) <= expected) return 0.0;
  if (sum_of_squares(1.0) > expected) return {};
  double below = 0.0, above = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (below + above);
    (sum_of_squares(middle) > expected ? below : above) = middle;
  }
  return above;
}

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
  const double pixel_variance = std::pow(sim::median(sizes) / kMedian, 2) / kSquares;
  const bool is_by_sensor = scene.fit.photo_noise == sim::PhotoNoise::sensor;
  std::vector<double> variances(grid.bins(), 0.0);
  for (std::size_t b = 0; b < grid.bins(); ++b) {
    const std::size_t i = b * 3 + static_cast<std::size_t>(channel);
    if (cells.count[i] == 0) continue;
    const double step = code_step(photo, cells.mean[i]);
    variances[b] = is_by_sensor ? std::pow(cells.standard_error[i], 2)
                                : std::max(pixel_variance, step * step / 12.0) / cells.count[i];
  }
  return variances;
}

namespace {

constexpr int kParts = 4;
constexpr int kMinWidth_px = 2;  // of a part
constexpr int kRealisedRowsEachSide = 15;
constexpr double kIndependent = 2.0;     // of the parts
constexpr double kRealisedBright = 0.2;  // of the peak
constexpr std::array<double, kParts> kPlace = {-1.5, -0.5, 0.5, 1.5};
constexpr double kPlaces2 = 5.0;  // sum of their squares

/// Excess variance of the parts' shapes, row by row, of one band and channel; NaN where a part has no pixels.
std::vector<double> excess(const Profile& parts, int band, int channel, double sky) {
  const auto part = [&](int k, int row) { return parts.index(band * kParts + k, row, channel); };
  const auto complete = [&](int row) {
    for (int k = 0; k < kParts; ++k)
      if (parts.count[part(k, row)] == 0 || !std::isfinite(parts.standard_error[part(k, row)])) return false;
    return true;
  };
  std::array<double, kParts> with_mean{};
  std::vector<double> mean(parts.rows, 0.0);
  double mean2 = 0.0;
  for (int r = 0; r < parts.rows; ++r) {
    if (!complete(r)) continue;
    for (int k = 0; k < kParts; ++k) mean[r] += (parts.mean[part(k, r)] - sky) / kParts;
    for (int k = 0; k < kParts; ++k) with_mean[k] += mean[r] * (parts.mean[part(k, r)] - sky);
    mean2 += mean[r] * mean[r];
  }
  std::vector<double> variance(parts.rows, std::numeric_limits<double>::quiet_NaN());
  if (!(mean2 > 0.0)) return variance;
  for (int r = 0; r < parts.rows; ++r) {
    if (!complete(r)) continue;
    std::array<double, kParts> left{};
    double sum = 0.0, slope = 0.0, noise = 0.0;
    for (int k = 0; k < kParts; ++k) {
      left[k] = parts.mean[part(k, r)] - sky - with_mean[k] / mean2 * mean[r];
      sum += left[k];
      slope += kPlace[k] * left[k] / kPlaces2;
      noise += std::pow(parts.standard_error[part(k, r)], 2) / kParts;
    }
    double squares = 0.0;
    for (int k = 0; k < kParts; ++k) squares += std::pow(left[k] - sum / kParts - slope * kPlace[k], 2);
    variance[r] = squares / (kParts - 2) - noise;
  }
  return variance;
}

}  // namespace

std::vector<double> realisation_sigma(const Photo& photo, const Region& region, int bands,
                                      double smoothing_px) {
  std::vector<double> sigma(static_cast<std::size_t>(bands) * region.height * 3, 0.0);
  if (region.width < bands * kParts * kMinWidth_px) return sigma;
  const Profile parts = smoothed(extract_profile(photo, region, bands * kParts), smoothing_px);
  const std::array<double, 3> sky = sky_level(parts);
  for (int b = 0; b < bands; ++b)
    for (int c = 0; c < 3; ++c) {
      const std::vector<double> single = excess(parts, b, c, sky[c]);
      for (int r = 0; r < parts.rows; ++r) {
        const int first = std::max(0, r - kRealisedRowsEachSide),
                  last = std::min(parts.rows - 1, r + kRealisedRowsEachSide);
        double sum = 0.0;
        int count = 0;
        for (int k = first; k <= last; ++k) {
          if (std::isnan(single[k])) continue;
          sum += single[k];
          ++count;
        }
        sigma[(static_cast<std::size_t>(b) * parts.rows + r) * 3 + c] =
            std::sqrt(std::max(0.0, sum / std::max(1, count)) / kIndependent);
      }
    }
  return sigma;
}

double sampling_error(const std::vector<double>& one, const std::vector<double>& other, int bands) {
  const double peak = one.empty() ? 0.0 : *std::max_element(one.begin(), one.end());
  if (!(peak > 0.0)) return 0.0;
  const std::size_t band_values = one.size() / static_cast<std::size_t>(bands);
  double sum = 0.0;
  int count = 0;
  for (std::size_t first = 0; first + band_values <= one.size(); first += band_values) {
    double products = 0.0, squares = 0.0;
    for (std::size_t i = first; i < first + band_values; ++i) {
      products += one[i] * other[i];
      squares += other[i] * other[i];
    }
    if (!(squares > 0.0)) continue;
    for (std::size_t i = first; i < first + band_values; ++i) {
      if (!(one[i] > kRealisedBright * peak)) continue;
      sum += 0.5 * std::pow((one[i] - products / squares * other[i]) / one[i], 2);
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace vegard::fit
