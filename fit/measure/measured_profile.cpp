#include "fit/measure/measured_profile.h"

#include <cmath>
#include <limits>

#include "fit/photo/grey_light.h"
#include "sim/view/sensor/sensor.h"

namespace vegard::fit {

namespace {

/// A grey sensor says the same in all channels: what is said once is to count once.
void keep_one_channel(Profile& profile) {
  for (std::size_t i = 0; i < profile.mean.size(); ++i) {
    if (i % 3 == kGreyChannel) continue;
    profile.count[i] = 0;
    profile.mean[i] = profile.standard_error[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

Profile measured_profile(const sim::Scene& scene, const Photo& photo,
                         const std::shared_ptr<const BinGrid>& grid) {
  Profile profile = extract_profile(photo, grid);
  if (is_grey(scene)) keep_one_channel(profile);
  if (scene.fit.photo_noise != sim::PhotoNoise::sensor) return profile;
  const sim::Image variance = sim::light_variance(scene, photo.linear, file_step(photo));
  const sim::PictureSize of_file = size_of_file(photo);
  const double averaged = static_cast<double>(of_file.width) * of_file.height /
                          (static_cast<double>(photo.linear.width) * photo.linear.height);
  for (std::size_t bin = 0; bin < grid->bins(); ++bin)
    for (int c = 0; c < 3; ++c) {
      if (profile.count[bin * 3 + c] == 0) continue;
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
      if (count > 0) profile.standard_error[bin * 3 + c] = std::sqrt(sum / averaged) / count;
    }
  return profile;
}

}  // namespace vegard::fit
