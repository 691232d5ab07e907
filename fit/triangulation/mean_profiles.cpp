#include "fit/triangulation/mean_profiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fit/triangulation/light_ranks.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace mean_profiles_parts {

constexpr double kStep_km = 1.0, kHighestAbove_km = 60.0;
constexpr std::size_t kFewestPeaks = 4;

/// The mean light of each piece, [piece][level]; NaN where a camera shows nothing of it.
std::vector<std::vector<double>> of_pieces(const CurtainLight& curtain, const CurtainSupposition& as,
                                           const std::vector<BorderFieldLine>& lines, std::size_t camera) {
  const std::size_t count = CurtainLight::levels(as.highest_km, kStep_km);
  const std::vector<double> light = curtain.along(as, lines, camera, kStep_km);
  std::vector<std::vector<double>> means(kBorderPieces, std::vector<double>(count, 0.0));
  std::vector<std::vector<int>> counts(kBorderPieces, std::vector<int>(count, 0));
  for (std::size_t line = 0; line < lines.size(); ++line)
    for (std::size_t k = 0; k < count; ++k)
      if (const double one = light[line * count + k]; std::isfinite(one)) {
        means[lines[line].piece][k] += one;
        ++counts[lines[line].piece][k];
      }
  for (std::size_t piece = 0; piece < kBorderPieces; ++piece)
    for (std::size_t k = 0; k < count; ++k)
      means[piece][k] = counts[piece][k] > 0 ? means[piece][k] / counts[piece][k] : sim::kNaN;
  return means;
}

}  // namespace mean_profiles_parts

MeanProfiles::MeanProfiles() : peak_above_km(sim::kNaN), peak_above_error_km(sim::kNaN) {}

MeanProfiles mean_profiles(const CurtainLight& curtain, const CurtainSupposition& supposed,
                           double border_km) {
  using namespace mean_profiles_parts;
  MeanProfiles found;
  CurtainSupposition as = supposed;
  as.highest_km = kHighestAbove_km;
  const std::vector<BorderFieldLine> lines = curtain.lines_at(as, border_km);
  const std::size_t count = CurtainLight::levels(as.highest_km, kStep_km);
  for (std::size_t k = 0; k < count; ++k)
    found.above_km.push_back(kLowestAbove_km + kStep_km * static_cast<double>(k));
  std::vector<double> peak_km[2];
  for (std::size_t i = 0; i < 2; ++i) {
    peak_km[i].assign(kBorderPieces, sim::kNaN);
    found.light[i].assign(count, 0.0);
    int pieces = 0;
    const std::vector<std::vector<double>> profiles = of_pieces(curtain, as, lines, i);
    for (std::size_t piece = 0; piece < kBorderPieces; ++piece) {
      const std::vector<double>& profile = profiles[piece];
      if (std::any_of(profile.begin(), profile.end(), [](double one) { return std::isnan(one); })) continue;
      const auto [least, most] = std::minmax_element(profile.begin(), profile.end());
      if (!(*most > *least)) continue;
      // At an end the light may be brighter beyond it.
      if (most != profile.begin() && most + 1 != profile.end())
        peak_km[i][piece] =
            refined_maximum(found.above_km, profile, static_cast<std::size_t>(most - profile.begin()));
      for (std::size_t k = 0; k < count; ++k) found.light[i][k] += (profile[k] - *least) / (*most - *least);
      ++pieces;
    }
    for (double& one : found.light[i]) one = pieces > 0 ? one / pieces : sim::kNaN;
  }
  std::vector<double> peaks, differences, off;
  for (std::size_t piece = 0; piece < kBorderPieces; ++piece) {
    const double a = peak_km[0][piece], b = peak_km[1][piece];
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    peaks.push_back(0.5 * (a + b));
    differences.push_back(a - b);
  }
  if (peaks.size() < kFewestPeaks) return found;
  found.peak_above_km = sim::median(peaks);
  for (const double one : peaks) off.push_back(std::abs(one - found.peak_above_km));
  // 1.48 median absolute deviations are a standard deviation, of which a median has 1.25 / sqrt(n).
  const double own = 1.48 * 1.25 * sim::median(off) / std::sqrt(static_cast<double>(peaks.size()));
  found.peak_above_error_km = std::hypot(own, 0.5 * sim::median(differences), 0.5 * kStep_km);
  return found;
}

}  // namespace vegard::fit
