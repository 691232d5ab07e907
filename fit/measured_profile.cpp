#include "fit/measured_profile.h"

#include <cmath>

#include "sim/view/sensor.h"

namespace vegard::fit {

Profile measured_profile(const sim::Scene& scene, const Photo& photo,
                         const std::shared_ptr<const BinGrid>& grid) {
  Profile profile = extract_profile(photo, grid);
  if (scene.fit.photo_noise != "sensor") return profile;
  const sim::Image variance = sim::light_variance(scene, photo.linear, file_step(photo));
  for (std::size_t bin = 0; bin < grid->bins(); ++bin)
    for (int c = 0; c < 3; ++c) {
      double sum = 0.0;
      int count = 0;
      for (std::size_t r = grid->first_run[bin]; r < grid->first_run[bin + 1]; ++r) {
        const BinGrid::Run& run = grid->runs[r];
        for (int x = run.begin; x < run.end; ++x) {
          if (!photo.usable[photo.linear.index(x, run.y, c)]) continue;
          sum += variance.at(x, run.y, c);
          ++count;
        }
      }
      if (count > 0) profile.standard_error[bin * 3 + c] = std::sqrt(sum) / count;
    }
  return profile;
}

}  // namespace vegard::fit
