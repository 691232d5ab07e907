// A map as a picture of the ground, with the planes of precipitation.fits.
#pragma once

#include "fit/map/map_raster.h"
#include "sim/base/image.h"

namespace vegard::fit {

/// Channels: "Q", the energy flux in mW m^-2; "E0" in keV; "Q_error", the relative standard error of the
/// flux; "lnE0_error", the standard error of ln(E0); "sensitivity", the signal-to-noise ratio of 1 mW m^-2.
/// NaN where no picture constrains a value; energy and errors are also NaN where there is no flux. The first
/// row of the image is the northernmost; the first row of `raster` is the southernmost.
struct MapImage {
  MapRaster raster;
  sim::Image planes;
};

MapImage map_image(const MapResult& result);

}  // namespace vegard::fit
