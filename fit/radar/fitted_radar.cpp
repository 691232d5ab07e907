#include "fit/radar/fitted_radar.h"

#include <algorithm>

#include "sim/base/number/chi_squared.h"

namespace vegard::fit {

bool contradicts(const FittedRadar& radar) {
  constexpr double kLeastChance = 0.0027;
  return sim::chi2_tail(radar.chi2, std::max(1, radar.values)) < kLeastChance;
}

}  // namespace vegard::fit
