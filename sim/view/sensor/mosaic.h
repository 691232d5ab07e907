// A sensor's colour filters, one to a pixel (Bayer 1976, US patent 3 971 065), and how three channels are
// made of what stands behind them: bilinear, that is the pixel itself where it has the filter, and else the
// mean of its neighbours that have. Each channel takes from its own filter's pixels only, so that noise of
// different channels stays independent.
#pragma once

#include <string>

#include "sim/base/image.h"

namespace vegard::sim {

/// Channel (0 red, 1 green, 2 blue) of the filter at a pixel. `pattern`: "rggb", "bggr", "grbg" or "gbrg",
/// the upper left two by two pixels row by row.
int filter_of_pixel(const std::string& pattern, int x, int y);

/// R, G, B of a mosaic of one channel, at least two by two pixels.
Image demosaic(const Image& mosaic, const std::string& pattern);

/// Variances of what demosaic() gives, where the mosaic's pixels are independent and have these.
Image demosaic_variance(const Image& mosaic_variance, const std::string& pattern);

}  // namespace vegard::sim
