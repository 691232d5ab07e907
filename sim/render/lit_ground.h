// The ground in the light of all that shines above it: how much falls on it, and how it looks.
//
// The whole sky is rendered once more, small, and added up over the directions above the horizontal, each
// times the sine of its elevation. The ground is matt and grey (Lambert's law: radiance = albedo x irradiance
// / pi) and lit everywhere as it is at the observer's place; nothing of it goes back into the air or the sky.
#pragma once

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/colour/matrix3.h"

namespace vegard::sim {

/// On a level surface at the observer's place.
struct GroundIllumination {
  Vector3 rgb{};              ///< linear sensor value times steradian
  double aurora_lx = 0.0;     ///< of the emission lines
  double night_sky_lx = 0.0;  ///< of airglow, twilight, light pollution and moonlit air
  double stars_lx = 0.0;      ///< of stars, planets, Moon and Milky Way
  double lux() const { return aurora_lx + night_sky_lx + stars_lx; }
};

/// The same scene before a camera that sees all of its sky, and with nothing on the ground. With
/// moon.skylight its Moon is there, shown or not.
Scene sky_over_ground(const Scene& scene);

/// Of that scene's pictures, as render() has them (sim/render/render.h has both in one call).
GroundIllumination light_of_sky(const Scene& sky, const Image& rayleigh, const Image& rgb,
                                const Image& night_sky, const Image& stars);

/// The ground in the scene's picture: R, G, B times A, the share of each pixel below the horizon.
Image ground_layer(const Scene& scene, const GroundIllumination& light, int threads = 0);

}  // namespace vegard::sim
