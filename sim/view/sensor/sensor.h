// A camera's sensor: linear light to digital numbers with their noise, those to a picture, and the way back.
//
//   light (linear RGB, white = 1) -> vignetting -> raw channels, by the inverse of rgb_from_raw() ->
//   electrons, white_e to raw 1 -> Poisson(electrons + dark) + Gaussian(read noise) -> full well -> number =
//   black + electrons * dn_per_electron, rounded, limited -> black and mean dark taken off, demosaiced,
//   rgb_from_raw()
//   -> tone curve -> file
//
// Source: EMVA standard 1288, release 3.1 (2016), section 2, for the linear model of photon, dark and
// quantisation noise; Healey and Kondepudy 1994, IEEE TPAMI 16, 267, doi:10.1109/34.276126, for the same of
// cameras. Left out: fixed patterns, blooming, hot pixels, cosmic rays, noise reduction and sharpening of
// makers. docs/optics.md, "Sensor".
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// What a converter gives for linear RGB light, signed where a camera's matrix makes it so; raw channels
/// below 0 count as 0. Whole numbers, in one channel "raw" behind a mosaic, else in R, G, B. The noise is a
/// pure function of the scene's seed and the frame's number: pictures of one seed and different frames have
/// independent noise.
Image raw_numbers(const Scene& scene, const Image& light, std::uint32_t frame = 0, int threads = 0);

/// Linear RGB of raw numbers, still as dark in the corners as the lens has it, negative where noise is.
Image developed(const Scene& scene, const Image& raw);

/// Linear RGB, limited to 0 to 1, encoded by the tone curve and in the false colour of the scene's table, as
/// a display file holds it. Photographs are read without that table: it is for eyes (recover_light()).
Image encoded(const Scene& scene, const Image& rgb);

/// The way back from a file's decoded linear RGB: divides by the vignetting, and marks in `usable`, per pixel
/// and channel as in the image's data, what a full pixel has had a part in, or where the lens gives less than
/// a hundredth of its light, as 0. The image may have another size than the scene's camera. `file_step` as in
/// light_variance().
void recover_light(const Scene& scene, double file_step, Image& rgb, std::vector<std::uint8_t>& usable);

/// Variance of recovered light per pixel and channel: photons', dark, read and rounding noise through
/// demosaicing, matrix and vignetting, and the file's own rounding to steps of `file_step` (1/255, 1/65535;
/// 0: floats). `light` is the recovered light, whose own noise then enters, or better the true one.
/// Neighbours behind a mosaic share pixels, and so their noise; channels behind a matrix share theirs, so
/// that the variance of their sums is not the sum of these. What demosaicing makes up between pixels, and
/// compression by JPEG, are not in it.
Image light_variance(const Scene& scene, const Image& light, double file_step);

}  // namespace vegard::sim
