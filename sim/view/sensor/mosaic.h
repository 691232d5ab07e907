// The colour filter array of a sensor (Bayer 1976, US patent 3 971 065) and bilinear demosaicing: a channel
// is the pixel itself where it has the channel's filter, else the mean of its neighbours with that filter.
// Each channel only uses pixels with its own filter, so that the noise of different channels stays
// independent.
#pragma once

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the channel (0 red, 1 green, 2 blue) of the filter at a pixel. Not for the pattern `none`.
int filter_of_pixel(MosaicPattern pattern, int x, int y);

/// Returns R, G, B of a mosaic with one channel and at least two by two pixels.
Image demosaic(const Image& mosaic, MosaicPattern pattern);

/// Returns the variances of the result of demosaic() for independent pixels with these variances.
Image demosaic_variance(const Image& mosaic_variance, MosaicPattern pattern);

}  // namespace vegard::sim
