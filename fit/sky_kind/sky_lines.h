// Bright lines of a sky at two widths, fine lines that cross them, and stars by parts of the sky.
//
// A line is where the light's second derivative across is at least twice that along (Steger 1998,
// doi:10.1109/34.659930), on a map of the logarithm of light smoothed by a Gaussian, and no neighbour across
// is brighter. Arcs are long lines; clouds, noise and glows have short ones.
#pragma once

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"
#include "fit/sky_kind/sky_features.h"

namespace vegard::fit {

/// Adds star_tiles, ridge_top, thin_lines, wide_lines and ray_strength of the pixels that are not left out.
/// A camera's gain does not count. Zero, or the least value, where nothing is found.
void add_lines(const Photo& photo, const PixelSet& left_out, SkyFeatures& features);

}  // namespace vegard::fit
