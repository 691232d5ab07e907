// Compositing in linear light: pictures behind and before the aurora, at the camera's size.
//
// Source: Baranoski et al. 2000, section 5 (the background initialises the colour buffer, the aurora is
// added, what the foreground covers is filtered out); docs/optics.md row B31. Porter and Duff 1984,
// doi:10.1145/964965.808606, for colour multiplied by its coverage.
#pragma once

#include "sim/base/image.h"

namespace vegard::sim {

/// Linear light of a picture file as R, G, B, A: colour multiplied by alpha, 1 where the file has none.
/// Integers are decoded from sRGB, floats are linear as they stand. Alpha is limited to 0 to 1.
Image linear_picture(const PictureFile& file);

/// A picture's coverage, one channel: the mean of its colours as the file's numbers stand, white = 1, times
/// its alpha, limited to 0 to 1. It counts area, not light: there is no curve in it.
Image coverage_of(const PictureFile& file);

/// The picture filled into a frame: scaled without distortion until it covers the frame, what juts out cut
/// off evenly on both sides. Shrinking takes the mean over the area of each new pixel, enlarging is bilinear
/// between the pixels' centres. Any channels; colours are to be multiplied by their alpha, so that what
/// cannot be seen does not bleed in.
Image fill_frame(const Image& picture, int width, int height);

/// `picture` (R, G, B, A as above) with `coverage` for its alpha, which is filled into the picture's frame.
Image with_coverage(const Image& picture, const Image& coverage);

/// What a composite needs beside the scene, both of the camera's size, R, G, B, A as above; empty: none.
struct CompositePictures {
  Image background;
  Image foreground;
};

/// Multiplies R, G and B, not A.
void scale_light(double gain, Image& picture);

/// Adds R, G and B of a picture, times `gain`, to linear RGB of the same size.
void add_light(const Image& picture, double gain, Image& rgb);

/// Linear RGB behind a foreground of R, G, B, A: rgb = foreground + (1 - alpha) rgb.
void cover(const Image& foreground, Image& rgb);

/// Two pictures of R, G, B, A as one: that of the nearer before the other.
void put_before(const Image& nearer, Image& picture);

/// Linear RGB behind something that hides a share of each channel: rgb = (1 - hidden) rgb.
void hide(const Image& hidden, Image& rgb);

}  // namespace vegard::sim
