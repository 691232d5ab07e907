#include "fit/answer/photo_line_ratio.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fit/measure/line_brightness.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::fit {
namespace {

constexpr double kOthersNm[] = {630.0, 427.8};
constexpr double kLit = 0.1;  // of the brightest bin

/// Sums over bins of two lines' brightness.
struct Sums {
  double line = 0.0, green = 0.0;
  double line2 = 0.0, green2 = 0.0, both = 0.0;  ///< covariance
  double ratio() const { return green > 0.0 ? line / green : sim::kNaN; }
  /// d ratio = (d line - ratio d green) / green
  double variance() const {
    return (line2 + ratio() * ratio() * green2 - 2.0 * ratio() * both) / (green * green);
  }
};

Sums sums_of(const LineBrightness& light, const std::vector<bool>& lit, int line, int green) {
  const std::size_t lines = light.names.size();
  Sums sums;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    if (!lit[i]) continue;
    sums.line += light.rayleigh[i * lines + line];
    sums.green += light.rayleigh[i * lines + green];
    const double* covariance = &light.covariance[i * lines * lines];
    sums.line2 += covariance[line * lines + line];
    sums.green2 += covariance[green * lines + green];
    sums.both += covariance[line * lines + green];
  }
  return sums;
}

/// Bins that all channels have, and where the model is bright.
std::vector<bool> lit_bins(const FittedPhoto& photo, const LineBrightness& data, const LineBrightness& model,
                           int green) {
  const std::size_t lines = model.names.size(), bins = model.rayleigh.size() / lines;
  double most = 0.0;
  for (std::size_t i = 0; i < bins; ++i) {
    const double light = model.rayleigh[i * lines + green];
    if (std::isfinite(light)) most = std::max(most, light);
  }
  std::vector<bool> lit(bins);
  for (std::size_t i = 0; i < bins; ++i)
    lit[i] = std::isfinite(data.rayleigh[i * lines + green]) && most > 0.0 &&
             model.rayleigh[i * lines + green] >= kLit * most && photo.sigma[3 * i] > 0.0 &&
             photo.sigma[3 * i + 1] > 0.0 && photo.sigma[3 * i + 2] > 0.0;
  return lit;
}

/// What the solved sky's level, channel by channel, does to a ratio.
double sky_variance(const FittedPhoto& photo, const std::vector<bool>& lit, int line, int green,
                    double ratio) {
  static const char* const kNames[3] = {"sky.level.red", "sky.level.green", "sky.level.blue"};
  double variance = 0.0;
  for (int c = 0; c < 3; ++c)
    for (const SolvedNumber& solved : photo.solved) {
      if (solved.name != kNames[c] || !solved.sigma) continue;
      sim::Scene other = photo.best;
      other.sky.level[c] += *solved.sigma;
      const double change = sums_of(line_brightness(other, photo.data), lit, line, green).ratio() - ratio;
      variance += change * change;
    }
  return variance;
}

std::string why_none_of(const FittedPhoto& photo) {
  if (!photo.best.fit.white_balance_known) return "every channel has a gain of its own";
  if (photo.best.fit.profile_along != sim::ProfileAlong::columns)
    return "the profile does not run along columns";
  if (photo.best.emission.lines.size() > 3) return "three channels cannot tell more than three lines apart";
  return {};
}

void add_ratio(const FitResult& result, const FittedPhoto& photo, double nm,
               std::vector<DerivedNumber>& ratios) {
  const int line = sim::line_index(photo.best.emission.lines, nm),
            green = sim::line_index(photo.best.emission.lines, sim::kGreenNm);
  if (line < 0 || green < 0) return;
  const std::string whose = photo.name.empty() ? "" : " " + photo.name;
  const std::string name = fmt::format("I({:.1f})/I({:.1f}) in the ", nm, sim::kGreenNm);
  DerivedNumber seen, modelled;
  seen.name = name + "photograph" + whose;
  modelled.name = name + "model's picture" + (photo.name.empty() ? "" : " of" + whose);
  seen.is_detail = modelled.is_detail = true;
  seen.quantity = modelled.quantity = Quantity::ratio;
  seen.value = modelled.value = sim::kNaN;
  seen.why_none = why_none_of(photo);
  try {
    if (seen.why_none.empty()) {
      Profile model_profile = photo.data;
      model_profile.mean = photo.model;
      const LineBrightness data = line_brightness(photo.best, photo.data),
                           model = line_brightness(photo.best, model_profile);
      const std::vector<bool> lit = lit_bins(photo, data, model, green);
      const Sums in_data = sums_of(data, lit, line, green), in_model = sums_of(model, lit, line, green);
      if (in_data.green > 0.0 && in_model.green > 0.0) {
        seen.value = in_data.ratio();
        modelled.value = in_model.ratio();
        seen.sigma = std::sqrt(result.error_inflation * result.error_inflation * in_data.variance() +
                               sky_variance(photo, lit, line, green, in_data.ratio()));
        modelled.why_no_sigma = "it is that of the answer";
      } else {
        seen.why_none = "there is no light of 557.7 nm";
      }
    }
  } catch (const sim::Error& error) {
    seen.why_none = error.details().problem;
  }
  modelled.why_none = seen.why_none;
  ratios.push_back(std::move(seen));
  ratios.push_back(std::move(modelled));
}

}  // namespace

std::vector<DerivedNumber> photo_line_ratios(const FitResult& result) {
  std::vector<DerivedNumber> ratios;
  for (const FittedPhoto& photo : result.photos)
    for (const double nm : kOthersNm) add_ratio(result, photo, nm, ratios);
  return ratios;
}

}  // namespace vegard::fit
