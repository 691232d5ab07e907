// Stars in a picture: a random field, as many of each magnitude as the sky has, evenly over the celestial
// sphere, which turns about its pole and is that of no date; or those of the catalogue as they stand at the
// site and its time, lifted by refraction (sim/view/sky/star_place.h, the same door as a calibration's). With
// them whatever else stands there: planets, the Moon's disc, the Milky Way.
//
// Sources: docs/optics.md, "Stars". The air of [air] dims and reddens them, each channel as its wavelength
// of 610, 550 or 465 nm; they do not twinkle.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/sky/star_photometry.h"

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

/// Whether the scene has anything of the kind.
bool has_stars(const Scene& scene);

/// Linear RGB of the scene's stars, planets, Moon and Milky Way through its camera and sensor, the mean of
/// the given instants; black if none are shown. What stands below the observer's horizon is hidden by the
/// Earth. `stop` ends the work early; stars are missing then. Around an equirectangular picture's edges and
/// over its poles a star's image goes on.
Image star_light(const Scene& scene, const std::vector<double>& instants_s,
                 const std::atomic<bool>* stop = nullptr, int threads = 0);

}  // namespace vegard::sim
