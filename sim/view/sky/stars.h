// Stars in a picture: a random field with the real number of stars per magnitude, uniform on the celestial
// sphere, which rotates about its pole but has no date; or the catalogue's stars at the site and its time,
// with refraction (sim/view/sky/star_place.h, as in calibrations). Also planets, the Moon's disc and the
// Milky Way.
//
// Sources: docs/optics.md, "Stars". The air of [air] dims and reddens stars, with the wavelengths 610, 550
// and 465 nm for R, G and B; stars do not twinkle.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/view/sky/star_photometry.h"

namespace vegard::sim {

struct Scene;

/// Returns the number of stars of the whole sky brighter than a V magnitude: 4, 15, 49, 172, 511, 1600 and
/// 4800 at magnitudes 0 to 6 (Allen's Astrophysical Quantities, rounded; Hipparcos counts the same but 4968
/// at 6), log-linear between them and beyond: 0.46 dex per magnitude above 6, which stays within 20 % of the
/// counts of Tycho-2 and UCAC4 up to 12.
double stars_brighter_than(double magnitude);

/// The inverse of stars_brighter_than(), for `count` above 0.
double magnitude_of_count(double count);

struct Star {
  double magnitude = 0.0;     ///< V
  double colour_index = 0.0;  ///< B - V
  double declination_rad = 0.0;
  double hour_angle_rad = 0.0;  ///< west of the meridian at the scene's time 0
};

/// Returns a star of the random field of a seed; number 0 is the brightest. It does not depend on the
/// limiting magnitude.
Star star(std::uint64_t seed, std::uint32_t number);

/// Returns the direction (east, north, up) of a star at an instant of the scene's clock.
std::array<double, 3> star_direction(const Star& star, double latitude_deg, double instant_s);

/// True if the scene has stars, planets, the Moon or the Milky Way.
bool has_stars(const Scene& scene);

/// Returns linear RGB of the scene's stars, planets, Moon and Milky Way in its camera and sensor, the mean
/// over the given instants; black if none are shown. Objects below the observer's horizon are hidden. `stop`
/// ends the work early, with stars missing. In an equirectangular picture, a star's image continues across
/// the edges and the poles.
Image star_light(const Scene& scene, const std::vector<double>& instants_s,
                 const std::atomic<bool>* stop = nullptr, int threads = 0);

/// A star or planet in the sensor: its direction (east, north, up) and its linear RGB times steradian, which
/// over the solid angle of its image is the light of star_light().
struct PointOfLight {
  std::array<double, 3> enu{}, rgb_steradian{};
};

/// Returns the scene's stars and planets above the observer's horizon at an instant, the brightest first, at
/// most `most` of them.
std::vector<PointOfLight> star_points(const Scene& scene, double instant_s, std::size_t most);

// The Milky Way: the light of all stars that are too faint to be seen individually.
//
// Our own model with eleven numbers: stars in a disc and a bulge, dust in a thinner disc, and the integral of
// the attenuated starlight along the line of sight. It has the band, its width, the brighter half towards the
// centre and the dark lane along the middle, but no single clouds and rifts. Scale lengths and heights are
// those of stars and dust near the Sun (J. Bland-Hawthorn and O. Gerhard 2016, Annual Review of Astronomy and
// Astrophysics 54, 529: disc 2.6 and 0.30 kpc, the Sun at 8.2 kpc); the dust's opacity and the bulge are
// ESTIMATED. The brightness is scaled to 30 stars of tenth magnitude per square degree at the galactic poles,
// which gives 130 to 600 along the band; Allen's Astrophysical Quantities have 160 to 640 there. ESTIMATED to
// be right within a factor of 2.

/// Returns the brightness above the air in stars of V magnitude 10 per square degree, at galactic
/// coordinates.
double milky_way_s10(double longitude_deg, double latitude_deg);

}  // namespace vegard::sim
