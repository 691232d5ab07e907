// The volumes' share of a picture: their light, and how much of the light behind them they hide.
//
// Premultiplied colour and coverage: Porter and Duff 1984, doi:10.1145/964965.808606. A volume hides each
// emission line by a share of its own, blurred as that line's light is, so that edges match. What is behind
// (sky, stars, pictures) is known in R, G and B only: the hidden share of a channel is the mean over the
// lines, weighted by the channel's response to each line (its colour per rayleigh, where positive), and A is
// the mean over the three channels, weighted by luminance.
#pragma once

#include <string>

#include "sim/base/image.h"
#include "sim/render/volumes/volumes.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Light of the volumes and the share that they hide, both with one channel per line.
struct VolumePictures {
  Image rayleigh;
  Image hidden;  ///< share of the light behind, 0 to 1; empty: none

  bool empty() const { return rayleigh.empty(); }
};

/// Returns the pictures for a film whose cells are the camera's pixels, blurred as the lines are
/// (sim/render/picture.h) if `blurred`. With march.blend = "add" nothing is hidden.
VolumePictures volume_pictures(const Scene& scene, const FilmGeometry& film, const VolumeLight& light,
                               bool blurred, int threads);

/// Converts the hidden share of each line to that of R, G and B.
Image hidden_colours(const Scene& scene, const Image& hidden);

/// Returns R, G, B, A: the light and its coverage. `hidden` is that of hidden_colours(), or empty.
Image volume_layer(const Scene& scene, const Image& rgb, const Image& hidden);

// The nebulae that the scene draws by the literal march, as a layer of the picture.

/// Returns R, G, B, A, the colours multiplied by alpha; later nebulae of the scene stand in front of earlier
/// ones. Empty if there are none. Throws Error(unreadable_input) if the picture march.depth cannot be used.
Image literal_layer(const Scene& scene, int threads);

/// Converts a picture in R, G, B, A, whose colours are not multiplied by alpha, to a layer for cover()
/// (sim/view/film/composite.h). Over a colour c it gives
///   "alpha": rgb a + c (1 - a);  "add": rgb + c
/// for c behind it.
Image layer_of_literal(const Image& picture, BlendRule blend);

/// Returns R, G, B, A of the camera's size: colours from 0 to 1, not multiplied by the opacity A. All are 0
/// where the lens sees nothing or the Earth hides the nebula. `depth_km`, of the same size and with one
/// channel, is the distance at which each ray is stopped; null: rays stop at the ground only.
Image literal_nebula_picture(const Scene& scene, const Nebula& nebula, const Image* depth_km, int threads);

}  // namespace vegard::sim
