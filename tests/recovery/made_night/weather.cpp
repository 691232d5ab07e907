#include "tests/recovery/made_night/weather.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/noise.h"
#include "sim/base/number/random.h"

namespace vegard::made_night {

double noisy(double light, const SensorNoise& noise, std::uint64_t seed, int x, int y, int c) {
  const sim::Words words = sim::random_words(seed, sim::Stream::photon_noise, static_cast<std::uint32_t>(x),
                                             static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(c));
  const double normal = sim::normal_quantile(sim::fine_uniform(words[0], words[1]));
  return light +
         normal * std::sqrt(std::max(light, 0.0) / noise.electrons_at_white + noise.read * noise.read);
}

double middle(std::vector<double> values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double cloud_share(std::uint64_t seed, double cover, const double enu[3], double seconds,
                   const CloudForm& form) {
  if (cover <= 0.0) return 0.0;
  constexpr double kHeight_km = 6.0, kWind_km_s = 0.012, kLowest = 0.06;
  const double up = std::max(enu[2], kLowest);
  const double x = (kHeight_km * enu[0] / up + kWind_km_s * seconds) / form.size_km,
               y = (kHeight_km * enu[1] / up + 0.4 * kWind_km_s * seconds) / form.size_km;
  const double noise = 0.5 + 0.9 * sim::octave_noise(seed, sim::Stream::nebula, 5, 4, x, y, seconds / 3000.0);
  // Overcast leaves no gap, broken clouds leave half.
  const double share = std::clamp((noise - 1.0 + cover * 1.1) / form.softness, 0.0, 1.0);
  return 0.95 * share;
}

double glare(double cosine, double core_deg) {
  const double away_deg = std::acos(std::clamp(cosine, -1.0, 1.0)) / sim::kRadiansPerDegree;
  return 6.0 * std::exp(-0.5 * away_deg * away_deg / (core_deg * core_deg)) +
         0.12 / (1.0 + away_deg * away_deg / 4.0);
}

}  // namespace vegard::made_night
