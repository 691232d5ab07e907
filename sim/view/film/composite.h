// Compositing in linear light: pictures behind and in front of the aurora, at the camera's size.
//
// Source: Baranoski et al. 2000, section 5 (the background initialises the colour buffer, the aurora is
// added, pixels that the foreground covers are filtered out); docs/optics.md row B31. Porter and Duff 1984,
// doi:10.1145/964965.808606, for premultiplied alpha.
#pragma once

#include "sim/base/image.h"

namespace vegard::sim {

/// Returns linear light of a picture file as R, G, B, A: colour multiplied by alpha, which is 1 if the file
/// has none. Integers are decoded from sRGB, floats are taken as linear. Alpha is clamped to 0 to 1.
Image linear_picture(const PictureFile& file);

/// Returns a picture's coverage, one channel: the mean of its colours, white = 1, times its alpha, clamped to
/// 0 to 1. Coverage is a fraction of area, not light: the file's values are not decoded.
Image coverage_of(const PictureFile& file);

/// Returns the picture fitted to a frame: scaled without distortion until it covers the frame, and cropped
/// equally on both sides. Shrinking takes the mean over the area of each new pixel, enlarging is bilinear
/// between the pixels' centres. For any channels; colours must be multiplied by their alpha, so that
/// invisible parts do not bleed in.
Image fill_frame(const Image& picture, int width, int height);

/// Returns `picture` (R, G, B, A as above) with `coverage`, fitted to the picture's size, as its alpha.
Image with_coverage(const Image& picture, const Image& coverage);

/// The pictures of a composite, both of the camera's size, R, G, B, A as above; empty: none.
struct CompositePictures {
  Image background;
  Image foreground;
};

/// Multiplies R, G and B, but not A, by `gain`.
void scale_light(double gain, Image& picture);

/// Adds R, G and B of a picture, times `gain`, to linear RGB of the same size.
void add_light(const Image& picture, double gain, Image& rgb);

/// Puts a foreground of R, G, B, A in front of linear RGB: rgb = foreground + (1 - alpha) rgb.
void cover(const Image& foreground, Image& rgb);

/// Puts a nearer picture of R, G, B, A in front of another one, into `picture`.
void put_before(const Image& nearer, Image& picture);

/// Hides a fraction of each channel of linear RGB: rgb = (1 - hidden) rgb.
void hide(const Image& hidden, Image& rgb);

}  // namespace vegard::sim
