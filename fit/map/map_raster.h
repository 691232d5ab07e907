// A map on a linear grid of east and north, in which it is written, drawn, and searched for curtains.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/map/map_fit.h"
#include "sim/base/image.h"

namespace vegard::fit {

/// The grid: rows to the north, columns to the east, [row * columns + column]. Positions are those of feet in
/// the site's tangent plane.
struct MapRaster {
  double west_km = 0.0, south_km = 0.0;  ///< of the middle of the first pixel
  double step_km = 2.0;
  int columns = 0, rows = 0;

  std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }
  sim::EastNorth place(double column, double row) const {
    return {west_km + column * step_km, south_km + row * step_km};
  }
};

/// Returns a raster that covers all cells of a map's grid with a small margin.
MapRaster raster_over(const MapResult& result);

/// Averages the values of cells over each pixel, weighted with the area that a cell covers; 0 where there is
/// no cell.
std::vector<double> rasterised(const MapResult& result, const MapRaster& raster,
                               const std::vector<double>& of_cell);

/// Energy flux, and ln(E0) times it.
struct RasterFlux {
  std::vector<double> flux, flux_ln_energy;
};
RasterFlux raster_flux(const MapResult& result, const MapRaster& raster, const std::vector<CellFlux>& cells);

/// 1 where light at the lower border would be seen, else 0.
std::vector<std::uint8_t> places_in_view(const MapResult& result, const MapRaster& raster);

/// Smooths by a Gaussian with this standard deviation; values beyond the edge are taken as 0.
std::vector<double> smoothed_raster(const MapRaster& raster, const std::vector<double>& values,
                                    double sigma_px);

// A map as a picture of the ground, with the planes of precipitation.fits.

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
