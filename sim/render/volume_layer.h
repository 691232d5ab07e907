// The volumes' share of a picture: their light, and how much of the light behind them they hide.
//
// Premultiplied colour and coverage: Porter and Duff 1984, doi:10.1145/964965.808606. A volume hides each
// emission line by a share of its own, blurred as that line's light is, so that edges match. What is behind
// (sky, stars, pictures) is known in R, G and B only: the hidden share of a channel is the mean over the
// lines, weighted by the channel's response to each line (its colour per rayleigh, where positive), and A is
// the mean over the three channels, weighted by luminance.
#pragma once

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

}  // namespace vegard::sim
