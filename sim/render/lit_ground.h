// The ground as it is lit by the sky: its illumination and its layer of the picture.
//
// The whole sky is rendered once more, as a small picture, and its light is integrated over the directions
// above the horizontal, weighted by the sine of the elevation. The ground is matt and grey (Lambert's law:
// radiance = albedo x irradiance / pi) and lit everywhere as it is at the observer's place; light that it
// reflects into the air and the sky is neglected.
#pragma once

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/colour/matrix3.h"

namespace vegard::sim {

/// Light on a level surface at the observer's place.
struct GroundIllumination {
  Vector3 rgb{};              ///< linear sensor value times steradian
  double aurora_lx = 0.0;     ///< of the emission lines
  double night_sky_lx = 0.0;  ///< of airglow, twilight, light pollution and moonlit air
  double stars_lx = 0.0;      ///< of stars, planets, Moon and Milky Way
  double lux() const { return aurora_lx + night_sky_lx + stars_lx; }
};

/// Returns the scene with a camera that sees the whole sky, and with nothing on the ground. With
/// moon.skylight the Moon is included even if the scene does not show it.
Scene sky_over_ground(const Scene& scene);

/// Computes the illumination from the pictures that render() makes of sky_over_ground(). (light_on_ground()
/// in sim/render/render.h does both.)
GroundIllumination light_of_sky(const Scene& sky, const Image& rayleigh, const Image& rgb,
                                const Image& night_sky, const Image& stars);

/// Returns the ground as a layer of the scene's picture: A is the share of each pixel below the horizon; R,
/// G, B are multiplied by A.
Image ground_layer(const Scene& scene, const GroundIllumination& light, int threads = 0);

}  // namespace vegard::sim
