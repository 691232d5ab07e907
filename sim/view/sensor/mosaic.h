// A sensor's colour filters, one to a pixel (Bayer 1976, US patent 3 971 065), and how three channels are
// made of what stands behind them: bilinear, that is the pixel itself where it has the filter, and else the
// mean of its neighbours that have. Each channel takes from its own filter's pixels only, so that noise of
// different channels stays independent.
#pragma once

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Channel (0 red, 1 green, 2 blue) of the filter at a pixel of any pattern but none.
int filter_of_pixel(MosaicPattern pattern, int x, int y);

/// R, G, B of a mosaic of one channel, at least two by two pixels.
Image demosaic(const Image& mosaic, MosaicPattern pattern);

/// Variances of what demosaic() gives, where the mosaic's pixels are independent and have these.
Image demosaic_variance(const Image& mosaic_variance, MosaicPattern pattern);

}  // namespace vegard::sim
