// A camera's sensor: linear light to digital numbers with noise, numbers to a picture, and a picture to
// light.
//
//   light (linear RGB, white = 1) -> vignetting -> raw channels, by the inverse of rgb_from_raw() ->
//   electrons, white_e to raw 1 -> Poisson(electrons + dark) + Gaussian(read noise) -> full well -> number =
//   black + electrons * dn_per_electron, rounded, limited -> black and mean dark subtracted, demosaiced,
//   rgb_from_raw()
//   -> tone curve -> file
//
// Source: EMVA standard 1288, release 3.1 (2016), section 2, for the linear model of photon, dark and
// quantisation noise; Healey and Kondepudy 1994, IEEE TPAMI 16, 267, doi:10.1109/34.276126, for the noise of
// cameras. Left out: fixed patterns, blooming, hot pixels, cosmic rays, noise reduction and sharpening of
// makers. docs/optics.md, "Sensor".
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Returns the digital numbers (integers) for linear RGB light, in one channel "raw" with a mosaic, else in
/// R, G, B. The light may be negative, because of a camera's matrix; negative raw channels count as 0. The
/// noise depends only on the scene's seed and the frame's number: frames of one seed have independent noise.
Image raw_numbers(const Scene& scene, const Image& light, std::uint32_t frame = 0, int threads = 0);

/// Returns linear RGB of raw numbers, without correction for vignetting; noise can make it negative.
Image developed(const Scene& scene, const Image& raw);

/// Returns the values of a display file for linear RGB: limited to 0 to 1, encoded by the tone curve (by
/// "filmic" rolled off instead of limited), with the false colours of sensor.colour_table. recover_light()
/// does not undo the false colours.
Image encoded(const Scene& scene, const Image& rgb);

/// Recovers light from a file's decoded linear RGB: divides by the vignetting. Sets `usable`, per pixel and
/// channel in the order of the image's data, to 0 where a saturated pixel contributes or the vignetting is
/// below 0.01. The image may have another size than the scene's camera. `file_step` as in light_variance().
void recover_light(const Scene& scene, double file_step, Image& rgb, std::vector<std::uint8_t>& usable);

/// Returns the variance of recovered light per pixel and channel: photon, dark, read and rounding noise
/// propagated through demosaicing, matrix and vignetting, and the rounding of the file to steps of
/// `file_step` (1/255, 1/65535; 0: floats). `light` is the true light or, less exactly, the recovered light.
/// Demosaicing correlates neighbouring pixels and the matrix correlates channels: the variance of a sum is
/// not the sum of these. Interpolation errors of demosaicing and JPEG compression are not included.
Image light_variance(const Scene& scene, const Image& light, double file_step);

// The colour filter array of a sensor (Bayer 1976, US patent 3 971 065) and bilinear demosaicing: a channel
// is the pixel itself where it has the channel's filter, else the mean of its neighbours with that filter.
// Each channel only uses pixels with its own filter, so that the noise of different channels stays
// independent.

/// Returns the channel (0 red, 1 green, 2 blue) of the filter at a pixel. Not for the pattern `none`.
int filter_of_pixel(MosaicPattern pattern, int x, int y);

/// Returns R, G, B of a mosaic with one channel and at least two by two pixels.
Image demosaic(const Image& mosaic, MosaicPattern pattern);

/// Returns the variances of the result of demosaic() for independent pixels with these variances.
Image demosaic_variance(const Image& mosaic_variance, MosaicPattern pattern);

// Vignetting: the decrease of a lens's light from the middle of the picture to its edges.
//
// cos^n of the angle off the axis (n = 4: natural vignetting, the illumination of a plane behind a simple
// lens) times an even polynomial in the distance from the middle, 1 + a r^2 + b r^4 + c r^6 with r = 1 in the
// corners (form of Goldman 2010, IEEE TPAMI 32, 2276, doi:10.1109/TPAMI.2010.55).

/// Light at a point of the picture, in pixels, over the light in its middle. At least 0.
class Vignetting {
 public:
  explicit Vignetting(const Scene& scene);
  bool none() const { return none_; }
  double at(double x_px, double y_px) const;

 private:
  Camera camera_;
  Lens<double> lens_;
  double cos_power_;
  std::array<double, 3> polynomial_;
  bool none_;
};

/// Multiplies every channel by the vignetting at the pixels' centres.
void darken(const Vignetting& vignetting, Image& image);

}  // namespace vegard::sim
