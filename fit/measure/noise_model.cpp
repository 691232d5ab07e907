#include "fit/measure/noise_model.h"

#include <algorithm>
#include <cmath>

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
  for (int c = 0; c < 3; ++c) {
    if (values[c].empty()) continue;
    const auto at = values[c].begin() + static_cast<std::ptrdiff_t>(kSkyPercentile * (values[c].size() - 1));
    std::nth_element(values[c].begin(), at, values[c].end());
    level[c] = *at;
  }
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
  const std::vector<double> of_whole_light = profile_sigma(noiseless, 1.0);
  const auto sum_of_squares = [&](double share) {
    double sum = 0.0;
    for (std::size_t i = 0; i < sigma.size(); ++i) {
      if (sigma[i] <= 0.0) continue;
      const double light = of_whole_light[i] * of_whole_light[i];
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

}  // namespace vegard::fit
