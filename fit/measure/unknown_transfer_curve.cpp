#include "fit/measure/unknown_transfer_curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "fit/measure/profile.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {
namespace {

/// What every code of a photograph becomes, put in place of its light.
template <class OfCode>
void replace_codes(Photo& photo, const OfCode& of_code) {
  assert(!photo.floating);
  const auto largest = static_cast<int>(std::lround(1.0 / file_step(photo)));
  std::vector<float> table(static_cast<std::size_t>(largest) + 1);
  for (int code = 0; code <= largest; ++code)
    table[static_cast<std::size_t>(code)] =
        static_cast<float>(of_code(static_cast<double>(code) / largest, 0.5 / largest));
  for (float& light : photo.linear.data) {
    const double encoded = std::clamp(sim::srgb_encode(light), 0.0, 1.0);
    light = table[static_cast<std::size_t>(std::lround(encoded * largest))];
  }
}

}  // namespace

Photo decoded_by(const Photo& as_srgb, const sim::BentSrgb& curve) {
  Photo photo = as_srgb;
  replace_codes(photo, [&](double encoded, double) { return curve.decode(encoded); });
  photo.tone = std::make_shared<const sim::ToneCurve>(sim::ToneCurve::of_bent(curve));
  return photo;
}

std::vector<double> mean_slopes(const Photo& as_srgb, const sim::BentSrgb& curve,
                                const std::shared_ptr<const BinGrid>& grid, double smoothing_px) {
  Photo slopes = as_srgb;
  replace_codes(slopes, [&](double encoded, double half_a_code) {
    return curve.slope(std::max(encoded, half_a_code));
  });
  return smoothed_by_px(extract_profile(slopes, grid), smoothing_px).mean;
}

double log_determinant(const std::vector<double>& sigma, const std::vector<double>& slopes) {
  assert(sigma.size() == slopes.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < sigma.size(); ++i)
    if (sigma[i] > 0.0) sum += 2.0 * std::log(sigma[i] / slopes[i]);
  return sum;
}

double scaled_chi2(double chi2, int n) {
  if (n <= 0 || chi2 <= n) return chi2;
  return n + n * std::log(chi2 / n);
}

}  // namespace vegard::fit
