// The volumes' share of a picture: their light, and how much of what is behind them they hide.
//
// Premultiplied colour and coverage: Porter and Duff 1984, doi:10.1145/964965.808606. A volume hides each
// emission line by a share of its own, blurred as that line's light is, so that edges match. What is behind
// (sky, stars, pictures) is known in R, G and B only: of each channel the share hidden is the mean over the
// lines, weighted by what the sensor's channel has of each (its colour per rayleigh, where positive), and A
// is the mean of the three, weighted by their luminance.
#pragma once

#include "sim/base/image.h"
#include "sim/render/volumes/volumes.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Both with one channel per line.
struct VolumePictures {
  Image rayleigh;
  Image hidden;  ///< share of the light behind, 0 to 1; empty: none

  bool empty() const { return rayleigh.empty(); }
};

/// Of a film whose cells are the camera's pixels, blurred as the lines are (sim/render/picture.h), or not at
/// all. march.blend = "add" hides nothing.
VolumePictures volume_pictures(const Scene& scene, const FilmGeometry& film, const VolumeLight& light,
                               bool blurred, int threads);

/// The share hidden of R, G and B of what is behind, by that of the lines.
Image hidden_colours(const Scene& scene, const Image& hidden);

/// R, G, B, A: the light and its coverage; `hidden` as hidden_colours() or empty.
Image volume_layer(const Scene& scene, const Image& rgb, const Image& hidden);

}  // namespace vegard::sim
