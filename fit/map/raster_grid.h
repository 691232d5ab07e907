// The linear grid of east and north on which a map is written, drawn, and searched for curtains.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/map/map_result.h"

namespace vegard::fit {

/// The grid: rows to the north, columns to the east, [row * columns + column]. Positions are those of feet in
/// the site's tangent plane.
struct RasterGrid {
  double west_km = 0.0, south_km = 0.0;  ///< of the middle of the first pixel
  double step_km = 2.0;
  int columns = 0, rows = 0;

  std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }
  sim::EastNorth place(double column, double row) const {
    return {west_km + column * step_km, south_km + row * step_km};
  }
};

/// Returns a raster that covers all cells of a map's grid with a small margin.
RasterGrid raster_over(const MapResult& result);

/// Averages the values of cells over each pixel, weighted with the area that a cell covers; 0 where there is
/// no cell.
std::vector<double> rasterised(const MapResult& result, const RasterGrid& raster,
                               const std::vector<double>& cell_values);

/// Energy flux, and ln(E0) times it.
struct RasterFlux {
  std::vector<double> flux, flux_ln_energy;
};
RasterFlux raster_flux(const MapResult& result, const RasterGrid& raster, const std::vector<CellFlux>& cells);

/// 1 where light at the lower border would be seen, else 0.
std::vector<std::uint8_t> places_in_view(const MapResult& result, const RasterGrid& raster);

/// Smooths by a Gaussian with this standard deviation; values beyond the edge are taken as 0.
std::vector<double> smoothed_raster(const RasterGrid& raster, const std::vector<double>& values,
                                    double sigma_px);

/// A raster's value at a place, between its pixels; 0 beyond its edge.
double raster_value(const RasterGrid& raster, const std::vector<double>& values, sim::EastNorth km);

}  // namespace vegard::fit
