// A random field of stars: as many of each magnitude as the sky has, evenly over the celestial sphere, which
// turns about its pole. They are not the stars of any date.
//
// Sources: docs/physics.md, "Stars". The air of [air] dims and reddens them, each channel as its wavelength
// of 610, 550 or 465 nm; there is no refraction and no twinkling.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::sim {

/// How many stars the whole sky has that are brighter than a V magnitude: 4, 15, 49, 172, 511, 1600 and 4800
/// at magnitudes 0 to 6 (Allen's Astrophysical Quantities, rounded; Hipparcos counts the same but 4968 at 6),
/// log-linear between them and beyond: 0.46 dex per magnitude above 6, which stays within 20 % of the
/// counts of Tycho-2 and UCAC4 up to 12.
double stars_brighter_than(double magnitude);

/// The magnitude that so many stars are brighter than; the inverse of the above. For `count` above 0.
double magnitude_of_count(double count);

struct Star {
  double magnitude = 0.0;     ///< V
  double colour_index = 0.0;  ///< B - V
  double declination_rad = 0.0;
  double hour_angle_rad = 0.0;  ///< west of the meridian at the scene's time 0
};

/// The stars of a seed by their brightness: number 0 is the brightest. A star is the same whatever the limit
/// is.
Star star(std::uint64_t seed, std::uint32_t number);

/// East, north, up of a star at an instant on the scene's clock.
std::array<double, 3> star_direction(const Star& star, double latitude_deg, double instant_s);

/// Photons cm^-2 s^-1 in the V band: 1.0e6 at magnitude 0.
double star_photons_cm2_s(double magnitude);

/// Of the black body that a colour index B - V stands for: Ballesteros 2012,
/// doi:10.1209/0295-5075/97/34008.
double colour_temperature_k(double colour_index);

/// Linear RGB, through a sensor, of light of luminance 1 from a black body of that temperature.
std::array<double, 3> star_tint(double colour_index, const SensorResponse& response);

/// Linear RGB of the scene's stars through its camera and sensor, the mean of the given instants; black if
/// none are shown. What stands below the observer's horizon is hidden by the Earth. `stop` ends the work
/// early; stars are missing then.
Image star_light(const Scene& scene, const std::vector<double>& instants_s,
                 const std::atomic<bool>* stop = nullptr);

}  // namespace vegard::sim
