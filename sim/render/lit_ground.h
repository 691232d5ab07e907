// The ground as it is lit by the sky: its illumination and its layer of the picture.
//
// The whole sky is rendered once more, as a small picture, and its light is integrated over the directions
// above the horizontal, weighted by the cosine of the angle to a surface's normal. Snow and trees are matt
// (Lambert's law: radiance = albedo x irradiance / pi) and lit everywhere by the sky as it is at the
// observer's place; what is not level also by the plain, as if that were level. Hills cast no shadows, and
// light that the ground reflects into the sky is neglected.
//
// The air scatters the aurora's and the airglow's light into the line of sight, evenly in all directions:
// radiance = (1 - T) J, with J the mean of the light from all directions, half of them of the ground
// (Chandrasekhar 1960, Radiative Transfer, equation I.65, for a source that is the same everywhere). Hills
// fade into what the horizon shows (Koschmieder 1924, Beitr. Phys. freien Atm. 12, 33).
#pragma once

#include <array>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/colour/matrix3.h"

namespace vegard::sim {

/// What a line gives to the air above the observer, in rayleighs.
struct LineInAir {
  double wavelength_nm;
  double mean;   ///< over the directions above the horizontal
  double level;  ///< radiance of a white level surface
};

/// Light at the observer's place.
struct GroundIllumination {
  static constexpr int kSlopes = 13;            ///< of the table below, each way
  static constexpr double kSteepest = 0.6;      ///< its slopes: -kSteepest to kSteepest
  Vector3 rgb{};                                ///< on a level surface: linear sensor value times steradian
  std::array<Vector3, kSlopes * kSlopes> on{};  ///< of the sky on a slope: [northward * kSlopes + eastward]
  std::vector<Vector3> horizon;                 ///< night sky just above it, of each degree of azimuth
  std::vector<LineInAir> in_air;                ///< lines of aurora and of airglow
  double aurora_lx = 0.0;                       ///< of the emission lines
  double night_sky_lx = 0.0;                    ///< of airglow, twilight, light pollution and moonlit air
  double stars_lx = 0.0;                        ///< of stars, planets, Moon and Milky Way
  double lux() const { return aurora_lx + night_sky_lx + stars_lx; }
};

/// Returns the scene with a camera that sees the whole sky, and with nothing on the ground. With
/// moon.skylight the Moon is included even if the scene does not show it.
Scene sky_over_ground(const Scene& scene);

/// Computes the illumination from the pictures that render() makes of sky_over_ground(). (light_on_ground()
/// in sim/render/render.h does both.)
GroundIllumination light_of_sky(const Scene& sky, const Image& rayleigh, const Image& rgb,
                                const Image& night_sky, const Image& stars);

/// Returns the ground as a layer of the scene's picture: A is the share of each pixel that it hides; R, G, B
/// are multiplied by A, and have the light of the air before the sky too. The landscape of the scene's seed
/// (sim/render/ground/landscape.h); for observers higher than any ground, above 9 km, a level and even
/// ground, into which the landscape passes from 6 km on.
Image ground_layer(const Scene& scene, const GroundIllumination& light, int threads = 0);

}  // namespace vegard::sim
