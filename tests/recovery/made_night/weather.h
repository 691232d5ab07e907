// What is put upon a rendered sky: clouds, glare and a sensor's noise.
#pragma once

#include <cstdint>
#include <vector>

namespace vegard::made_night {

struct SensorNoise {
  double electrons_at_white = 8000.0;
  double read = 0.0015;  ///< of white, standard deviation
};

/// Linear light, white = 1, with the noise of photons and of reading.
double noisy(double light, const SensorNoise& noise, std::uint64_t seed, int x, int y, int c);

double middle(std::vector<double> values);

struct CloudForm {
  double size_km = 9.0, softness = 0.35;
};

/// The share of light that clouds hide in a direction: noise on a level 6 km up, which the wind carries.
double cloud_share(std::uint64_t seed, double cover, const double enu[3], double seconds,
                   const CloudForm& form = {});

/// Glare of a source that is far above white: a core, and a halo that falls with the square.
double glare(double cosine, double core_deg);

}  // namespace vegard::made_night
