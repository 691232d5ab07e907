#include "fit/answer/free_profile.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/rows/spline_rates.h"

namespace vegard::fit {
namespace {

constexpr double kFreeStepKm = 1.0;

}  // namespace

std::vector<FreeProfile> free_profiles(const sim::Scene& best, const SplinePrior& prior,
                                       const ValueUncertainty& known) {
  std::vector<FreeProfile> profiles;
  for (const SplineLine& line : prior.lines) {
    const sim::Sheet& sheet = best.sheets.at(line.sheet);
    const sim::AltitudeSpline spline = sim::altitude_spline(sheet);
    FreeProfile profile;
    profile.sheet = sheet.name;
    profile.wavelength_nm = best.emission.lines.at(line.line);
    const int steps = static_cast<int>((sheet.spline_top_km - sheet.spline_bottom_km) / kFreeStepKm);
    for (int i = 1; i < steps; ++i) {
      const double altitude = sheet.spline_bottom_km + i * kFreeStepKm;
      double rate = 0.0, variance = 0.0;
      for (int k = 0; k < spline.count(); ++k)
        rate += sheet.spline_rate[sim::spline_rate_index(sheet, line.line, k)] * spline.basis(k, altitude);
      for (std::size_t a = 0; a < line.numbers.size(); ++a) {
        const double weight = spline.basis(line.knots[a], altitude);
        if (weight == 0.0) continue;
        for (std::size_t b = 0; b < line.numbers.size(); ++b)
          variance += weight * spline.basis(line.knots[b], altitude) *
                      known.covariance[line.numbers[a]][line.numbers[b]];
      }
      if (!(rate > 0.0)) continue;
      const double factor = std::exp(std::sqrt(std::max(0.0, variance)) / rate);
      profile.altitude_km.push_back(altitude);
      profile.rate.push_back(rate);
      profile.lower.push_back(rate / factor);
      profile.upper.push_back(rate * factor);
    }
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace vegard::fit
