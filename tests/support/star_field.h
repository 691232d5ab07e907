// Stars seen by a camera that is known, with noise.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "fit/photo/pointing/sky_camera.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"

namespace vegard::tests {

/// Normal, of mean 0 and standard deviation 1; by Philox, in the stream of the simulator's stars.
inline double normal(std::uint64_t seed, std::uint32_t i, std::uint32_t j) {
  const sim::Words words = sim::random_words(seed, sim::Stream::stars, i, j, 7);
  return sim::normal_quantile(sim::fine_uniform(words[0], words[1]));
}

/// A camera of 640 x 480 px that looks there.
inline fit::SkyCamera known_camera(sim::LensModel model, double focal_px, double azimuth_deg,
                                   double elevation_deg, double roll_deg) {
  fit::SkyCamera camera;
  camera.model = model;
  camera.camera_from_enu = fit::rotation_of(azimuth_deg, elevation_deg, roll_deg);
  camera.numbers[fit::focal_px_number] = focal_px;
  camera.numbers[fit::centre_x_number] = 327.0;
  camera.numbers[fit::centre_y_number] = 236.0;
  return camera;
}

/// Up to `count` stars, evenly over the sky above the horizon, that the camera sees inside its picture.
inline std::vector<fit::StarSighting> star_field(const fit::SkyCamera& camera, int count, double noise_px,
                                                 std::uint64_t seed) {
  std::vector<fit::StarSighting> stars;
  const sim::Lens<double> lens = fit::true_lens(camera);
  for (std::uint32_t i = 0; i < 40000 && static_cast<int>(stars.size()) < count; ++i) {
    const sim::Words words = sim::random_words(seed, sim::Stream::stars, i);
    const double up = 0.05 + 0.95 * sim::uniform(words[0]),
                 azimuth = 6.283185307179586 * sim::uniform(words[1]);
    const double level = std::sqrt(1.0 - up * up);
    fit::StarSighting star;
    star.enu = {level * std::sin(azimuth), level * std::cos(azimuth), up};
    // By the true lens: beyond the fold of its radial terms stars would come back into the picture.
    const Eigen::Vector3d v = camera.camera_from_enu * Eigen::Vector3d(star.enu[0], star.enu[1], star.enu[2]);
    const double in_camera[3] = {v[0], v[1], v[2]};
    if (!sim::project(lens, in_camera, star.x_px, star.y_px)) continue;
    if (star.x_px < 0.0 || star.y_px < 0.0 || star.x_px > 640.0 || star.y_px > 480.0) continue;
    star.x_px += noise_px * normal(seed, i, 1);
    star.y_px += noise_px * normal(seed, i, 2);
    stars.push_back(star);
  }
  return stars;
}

}  // namespace vegard::tests
