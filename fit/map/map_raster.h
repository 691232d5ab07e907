// A map on a linear grid of east and north: what is written, drawn, and searched for curtains.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/map/map_fit.h"

namespace vegard::fit {

/// Rows to the north, columns to the east: [row * columns + column]. Feet in the site's tangent plane.
struct MapRaster {
  double west_km = 0.0, south_km = 0.0;  ///< of the middle of the first pixel
  double step_km = 2.0;
  int columns = 0, rows = 0;

  std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }
  sim::EastNorth place(double column, double row) const {
    return {west_km + column * step_km, south_km + row * step_km};
  }
};

/// Over all cells of a map's grid, and a little beyond.
MapRaster raster_over(const MapResult& result);

/// Means over pixels of a number per cell times its share of the pixel; 0 where there is no cell.
std::vector<double> rasterised(const MapResult& result, const MapRaster& raster,
                               const std::vector<double>& of_cell);

/// Energy flux, and ln(E0) times it.
struct RasterFlux {
  std::vector<double> flux, flux_ln_energy;
};
RasterFlux raster_flux(const MapResult& result, const MapRaster& raster, const std::vector<CellFlux>& cells);

/// Where light at the lower border would be seen: 1, else 0.
std::vector<std::uint8_t> places_in_view(const MapResult& result, const MapRaster& raster);

/// Gaussian of so many pixels; nothing beyond the edge.
std::vector<double> smoothed_raster(const MapRaster& raster, const std::vector<double>& values,
                                    double sigma_px);

}  // namespace vegard::fit
