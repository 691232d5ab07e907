#include "fit/columns/column_maps.h"

#include <cmath>

#include "fit/columns/spectrum_trials.h"
#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace {

constexpr double kSeenSigmas = 3.0;  // standard deviations that a line with light stands out
constexpr double kEdgeSigmas = 2.0;

/// Takes the brightnesses of a pixel. Returns false if one of them, or its error, is missing.
bool take_pixel(const std::vector<LineMap>& lines, std::size_t i, ColumnData& data) {
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const LineMap& line = lines[l];
    data.rayleigh[l] = line.rayleigh[i];
    const double known = line.known_error.empty() ? 0.0 : line.known_error[i];
    data.sigma[l] = std::hypot(line.error.of(data.rayleigh[l]), known);
    if (!std::isfinite(data.rayleigh[l]) || !std::isfinite(data.sigma[l])) return false;
  }
  return true;
}

/// Returns whether every brightness has an error: a relative error of 0 or less of light is none.
bool has_errors(const ColumnData& data, std::size_t lines) {
  for (std::size_t l = 0; l < lines; ++l)
    if (!(data.sigma[l] > 0.0)) return false;
  return true;
}

/// Returns whether a line is brighter than its error.
bool light_in_pixel(const ColumnData& data, std::size_t lines) {
  for (std::size_t l = 0; l < lines; ++l)
    if (data.rayleigh[l] > kSeenSigmas * data.sigma[l]) return true;
  return false;
}

ColumnVerdict verdict_of_pixel(const ColumnChi2& chi2, const ColumnValley& best, const ColumnPoint& sigma_ln,
                               bool has_second) {
  if (has_second) return ColumnVerdict::two_solutions;
  ColumnVerdict verdict = ColumnVerdict::well_constrained;
  for (std::size_t k = 0; k < kColumnUnknowns; ++k) {
    if (!chi2.free()[k]) continue;
    const double reach = kEdgeSigmas * sigma_ln[k];
    if (best.at_edge[k] || !std::isfinite(reach) || best.at[k] - reach < chi2.model().least(k) ||
        best.at[k] + reach > chi2.model().most(k))
      return ColumnVerdict::one_sided;
    if (2.0 * reach > std::log(kWideFactor)) verdict = ColumnVerdict::loosely_constrained;
  }
  return verdict;
}

/// Whether a soft component explains a pixel's lines where its electrons do not.
bool asks_for_soft(const ColumnChi2* with_soft, const ColumnData& data, double chi2, int degrees) {
  if (with_soft == nullptr || !asks_for_trials(chi2, degrees)) return false;
  const double other = with_soft->valleys(data).front().chi2;
  return chi2 - other >= kAskedFall && !contradicts_tables(other, degrees_of_freedom(*with_soft));
}

void invert_pixel(const ColumnChi2& chi2, const ColumnChi2* with_soft, const ColumnData& data, std::size_t i,
                  ColumnMaps& maps) {
  const std::vector<ColumnValley> valleys = chi2.valleys(data);
  const ColumnValley& best = valleys.front();
  const int degrees = degrees_of_freedom(chi2);
  maps.chi2[i] = static_cast<float>(best.chi2);
  maps.consistency[i] =
      static_cast<float>(degrees > 0 ? chi2_tail(best.chi2, degrees) : std::exp(-0.5 * best.chi2));
  const bool asks = asks_for_soft(with_soft, data, best.chi2, degrees);
  if (contradicts_tables(best.chi2, degrees)) {
    maps.quality[i] =
        static_cast<std::uint8_t>(asks ? ColumnVerdict::other_spectrum : ColumnVerdict::contradiction);
    return;
  }
  const ColumnMatrix covariance = column_covariance(best, chi2.free());
  ColumnPoint sigma_ln{};
  for (std::size_t k = 0; k < kColumnUnknowns; ++k)
    sigma_ln[k] = best.at_edge[k]
                      ? sim::kNaN
                      : std::sqrt(covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)));
  const ColumnValley* second = nullptr;
  for (std::size_t v = 1; v < valleys.size() && second == nullptr; ++v)
    if (valleys[v].chi2 - best.chi2 <= kEquivalentChi2 && valleys[v].barrier >= kMinBarrier)
      second = &valleys[v];
  maps.energy_kev[i] = static_cast<float>(std::exp(best.at[kLnEnergy]));
  maps.flux_mw_m2[i] = static_cast<float>(std::exp(best.at[kLnFlux]));
  maps.oxygen_factor[i] = static_cast<float>(std::exp(best.at[kLnOxygen]));
  if (chi2.free()[kLnSoft]) {
    maps.soft_ratio[i] = static_cast<float>(std::exp(best.at[kLnSoft]));
    maps.ln_soft_error[i] = static_cast<float>(sigma_ln[kLnSoft]);
  }
  maps.ln_energy_error[i] = static_cast<float>(sigma_ln[kLnEnergy]);
  maps.relative_flux_error[i] = static_cast<float>(sigma_ln[kLnFlux]);
  maps.ln_oxygen_error[i] = static_cast<float>(sigma_ln[kLnOxygen]);
  if (second != nullptr) maps.other_energy_kev[i] = static_cast<float>(std::exp(second->at[kLnEnergy]));
  maps.quality[i] = static_cast<std::uint8_t>(
      asks ? ColumnVerdict::other_spectrum : verdict_of_pixel(chi2, best, sigma_ln, second != nullptr));
}

}  // namespace

bool most_contradict(const ColumnMaps& maps) {
  std::size_t lit = 0, contradicting = 0;
  for (const std::uint8_t quality : maps.quality) {
    const auto verdict = static_cast<ColumnVerdict>(quality);
    lit += verdict != ColumnVerdict::no_light && verdict != ColumnVerdict::not_measured ? 1 : 0;
    contradicting +=
        verdict == ColumnVerdict::contradiction || verdict == ColumnVerdict::other_spectrum ? 1 : 0;
  }
  return 2 * contradicting > lit;
}

ColumnMaps invert_maps(const ColumnChi2& chi2, const ColumnChi2* with_soft, const std::vector<LineMap>& lines,
                       std::size_t width, std::size_t height, int threads) {
  ColumnMaps maps;
  maps.width = width;
  maps.height = height;
  const std::size_t pixels = width * height;
  const auto nan = static_cast<float>(sim::kNaN);
  for (std::vector<float>* values :
       {&maps.energy_kev, &maps.flux_mw_m2, &maps.oxygen_factor, &maps.ln_energy_error,
        &maps.relative_flux_error, &maps.ln_oxygen_error, &maps.soft_ratio, &maps.ln_soft_error,
        &maps.other_energy_kev, &maps.chi2, &maps.consistency})
    values->assign(pixels, nan);
  maps.quality.assign(pixels, static_cast<std::uint8_t>(ColumnVerdict::not_measured));
  sim::parallel_for(height, threads, [&](std::size_t row, int) {
    ColumnData data;
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      if (!take_pixel(lines, i, data) || !has_errors(data, lines.size())) continue;
      if (light_in_pixel(data, lines.size()))
        invert_pixel(chi2, with_soft, data, i, maps);
      else
        maps.quality[i] = static_cast<std::uint8_t>(ColumnVerdict::no_light);
    }
  });
  return maps;
}

std::vector<ColumnData> lit_sample(const std::vector<LineMap>& lines, std::size_t most) {
  std::vector<ColumnData> lit;
  ColumnData data;
  for (std::size_t i = 0; i < lines.front().rayleigh.size(); ++i)
    if (take_pixel(lines, i, data) && has_errors(data, lines.size()) && light_in_pixel(data, lines.size()))
      lit.push_back(data);
  if (lit.size() <= most) return lit;
  std::vector<ColumnData> sample;
  for (std::size_t i = 0; i < most; ++i) sample.push_back(lit[i * lit.size() / most]);
  return sample;
}

}  // namespace vegard::fit
