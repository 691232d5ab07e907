// A map as a picture of the ground, with the planes of precipitation.fits.
#pragma once

#include "fit/map/map_result.h"
#include "fit/map/raster_grid.h"
#include "sim/base/image.h"

namespace vegard::fit {

/// Channels: "Q", the energy flux in mW m^-2; "E0" in keV; "Q_error", the relative standard error of the
/// flux; "lnE0_error", the standard error of ln(E0); "sensitivity", the signal-to-noise ratio of 1 mW m^-2.
/// NaN where no picture constrains a value; energy and errors are also NaN where there is no flux. The first
/// row of the image is the northernmost; the first row of `raster` is the southernmost.
struct RasterisedMap {
  RasterGrid raster;
  sim::Image planes;
};

RasterisedMap rasterised_map(const MapResult& result);

}  // namespace vegard::fit
