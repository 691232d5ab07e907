// What a raster says across a ridge: where the ridge is, how wide, how much it carries, how high it rises
// above its valleys.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/map/curtains/ridge_evidence.h"
#include "fit/map/raster_grid.h"

namespace vegard::fit {

/// What a map says across a curtain at one of its points.
struct RidgeSection {
  double aside_km = 0.0;  ///< of the ridge
  double flux = 0.0, ln_energy = 0.0, width_km = 0.0;
};

/// Mean of three sections, over the way of `step_km` from one of the curtain's points to the next.
RidgeSection ridge_section(const RasterGrid& raster, const std::vector<double>& smooth,
                           const RasterFlux& flux, sim::EastNorth at, sim::EastNorth across, double step_km);

/// The highest place of a raster along a line across a ridge, and how far it rises above the higher of the
/// valleys on its sides.
struct RidgeHeight {
  double aside_km = 0.0, height = 0.0;
};

/// Looks for the highest place up to `reach_km` aside, and for valleys up to `valley_km` from it.
RidgeHeight ridge_height(const RasterGrid& raster, const std::vector<double>& values, sim::EastNorth at,
                         sim::EastNorth across, double reach_km, double valley_km);

/// The unit vector across a line at one of its points.
sim::EastNorth across_line(const RidgeLine& feet, std::size_t i);

}  // namespace vegard::fit
