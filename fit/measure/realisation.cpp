#include "fit/measure/realisation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fit/measure/noise_model.h"
#include "fit/measure/smoothing.h"

namespace vegard::fit {
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
  const std::size_t of_band = one.size() / static_cast<std::size_t>(bands);
  double sum = 0.0;
  int count = 0;
  for (std::size_t first = 0; first + of_band <= one.size(); first += of_band) {
    double products = 0.0, squares = 0.0;
    for (std::size_t i = first; i < first + of_band; ++i) {
      products += one[i] * other[i];
      squares += other[i] * other[i];
    }
    if (!(squares > 0.0)) continue;
    for (std::size_t i = first; i < first + of_band; ++i) {
      if (!(one[i] > kRealisedBright * peak)) continue;
      sum += 0.5 * std::pow((one[i] - products / squares * other[i]) / one[i], 2);
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace vegard::fit
