#include "fit/compare/colour_statistic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/measure/noise_model.h"

namespace vegard::fit {
namespace {

constexpr double kColourBright = 5.0;  ///< standard deviations
constexpr double kNoiseAbove = 3.0;    ///< standard deviations
constexpr double kDarkestShare = 0.2;  ///< of the photograph's light

struct Logarithm {
  double value = 0.0, slope = 0.0;
};

/// ln x; below `darkest` its tangent there.
Logarithm logarithm(double x, double darkest) {
  if (x >= darkest) return {std::log(x), 1.0 / x};
  return {std::log(darkest) + x / darkest - 1.0, 1.0 / darkest};
}

/// The profile's 5th percentile lies below the sky by about a standard deviation of its noise, which matters
/// where light is faint: the mean of what it may be noise of.
std::array<double, 3> dark_level(const Profile& data) {
  const std::array<double, 3> least = sky_level(data);
  std::array<double, 3> sum{}, count{};
  for (std::size_t i = 0; i < data.mean.size(); ++i) {
    if (data.count[i] == 0) continue;
    const double own = std::isfinite(data.standard_error[i]) ? data.standard_error[i] : 0.0;
    if (data.mean[i] > least[i % 3] + kNoiseAbove * own) continue;
    sum[i % 3] += data.mean[i];
    count[i % 3] += 1.0;
  }
  for (int c = 0; c < 3; ++c) sum[c] = count[c] > 0.0 ? sum[c] / count[c] : least[c];
  return sum;
}

}  // namespace

ColourStatistic::ColourStatistic(const Profile& data, const std::vector<double>& sigma, double weight) {
  const std::array<double, 3> sky = dark_level(data);
  for (std::size_t bin = 0; bin < data.mean.size() / 3; ++bin) {
    const auto light = [&](int c) { return data.mean[bin * 3 + c] - sky[c]; };
    const auto bright = [&](int c) {
      return data.count[bin * 3 + c] > 0 && sigma[bin * 3 + c] > 0.0 &&
             light(c) > kColourBright * sigma[bin * 3 + c];
    };
    const auto channel = [&](int c) {
      return Channel{bin * 3 + c, data.mean[bin * 3 + c], kDarkestShare * light(c)};
    };
    const auto relative = [&](double error, int c) {
      return std::isfinite(error) ? std::pow(error / light(c), 2) : 0.0;
    };
    for (const int over : {0, 2}) {
      if (!bright(over) || !bright(1)) continue;
      Ratio ratio{channel(over), channel(1), 0.0, 0.0};
      ratio.sigma =
          std::sqrt((relative(sigma[bin * 3 + over], over) + relative(sigma[bin * 3 + 1], 1)) / weight);
      ratio.bias = 0.5 * (relative(data.standard_error[bin * 3 + over], over) -
                          relative(data.standard_error[bin * 3 + 1], 1));
      ratios_.push_back(ratio);
    }
  }
}

void ColourStatistic::evaluate(const StatisticInput& input, double* residual, double* jacobian) const {
  const SolvedLight& light = input.light;
  const std::size_t p = light.free;
  for (std::size_t k = 0; k < ratios_.size(); ++k) {
    const Ratio& ratio = ratios_[k];
    double difference = ratio.bias;
    if (jacobian != nullptr) std::fill_n(jacobian + k * p, p, 0.0);
    for (const Channel* channel : {&ratio.over, &ratio.under}) {
      const double sign = channel == &ratio.over ? 1.0 : -1.0;
      const std::size_t i = channel->value;
      const Logarithm data = logarithm(channel->mean - light.behind[i], channel->darkest);
      const Logarithm model = logarithm(light.aurora[i], channel->darkest);
      difference += sign * (data.value - model.value);
      if (jacobian == nullptr) continue;
      for (std::size_t j = 0; j < p; ++j)
        jacobian[k * p + j] -=
            sign / ratio.sigma *
            (data.slope * light.behind_slope[i * p + j] + model.slope * light.aurora_slope[i * p + j]);
    }
    residual[k] = difference / ratio.sigma;
  }
}

}  // namespace vegard::fit
