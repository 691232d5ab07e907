#include "fit/measure/smoothing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/view/film/blur.h"

namespace vegard::fit {

Profile smoothed(const Profile& profile, double sigma_rows) {
  const sim::BlurKernel kernel = sim::gaussian_kernel(sigma_rows);
  Profile result = profile;
  for (int b = 0; b < profile.bands; ++b)
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < profile.rows; ++r) {
        double sum = 0.0, variance = 0.0, weight = 0.0;
        int count = 0;
        for (int k = -kernel.radius(); k <= kernel.radius(); ++k) {
          if (r + k < 0 || r + k >= profile.rows) continue;
          const std::size_t i = profile.index(b, r + k, c);
          if (profile.count[i] == 0) continue;
          const double w = kernel.weights[std::abs(k)];
          sum += w * profile.mean[i];
          if (std::isfinite(profile.standard_error[i]))
            variance += std::pow(w * profile.standard_error[i], 2);
          weight += w;
          count += profile.count[i];
        }
        const std::size_t i = profile.index(b, r, c);
        result.count[i] = count;
        result.mean[i] = weight > 0.0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
        result.standard_error[i] = weight > 0.0 ? std::sqrt(variance) / weight : result.mean[i];
      }
  return result;
}

Profile smoothed_by_px(const Profile& profile, double sigma_px) {
  const double position_px = profile.grid == nullptr ? 1.0 : profile.grid->position_px;
  return sigma_px > 0.0 && position_px > 0.0 ? smoothed(profile, sigma_px / position_px) : profile;
}

}  // namespace vegard::fit
