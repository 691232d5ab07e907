// Grids of latitude and longitude over the ground of a map: geographic, and of the dipole.
#pragma once

#include "fit/map/raster_grid.h"
#include "fit/report/plot/plot.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Adds lines of geographic latitude and longitude, dashed, with their steps in the legend.
void add_geographic_grid(const sim::Scene& scene, const RasterGrid& raster, Panel& panel);

/// The same of the centred dipole of the scene (field.pole_latitude_deg and pole_longitude_deg, by default
/// IGRF-13's of 2020). Longitude is 0 on the meridian that runs from the dipole's pole to the geographic
/// south pole.
void add_magnetic_grid(const sim::Scene& scene, const RasterGrid& raster, Panel& panel);

}  // namespace vegard::fit
