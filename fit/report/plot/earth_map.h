// The Earth's surface about a place, flat: the azimuthal equidistant projection. What lies at the angle psi
// from the place, seen from the Earth's centre, in the direction of the azimuth a, is drawn at the distance
// 6371 km psi in that direction (Snyder 1987, "Map projections: a working manual", USGS Professional Paper
// 1395, chapter 25, for a sphere). Distances and directions from the place are true.
#pragma once

#include <optional>

#include "fit/report/plot/plot_canvas.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Kilometres on the ground to the east (x) and to the north (y).
using GroundPoint = PlotPoint;

/// Of a direction from the Earth's centre, in the east, north and up of the place; any length.
GroundPoint ground_point(const double (&from_centre_enu)[3]);

/// Of a foot in the tangent plane of the place. NaN beyond the sphere's edge.
GroundPoint ground_of_foot(sim::EastNorth foot_km);

/// Of a place on the sphere, about another at `latitude_deg` north; longitudes count from that.
GroundPoint ground_of_place(double latitude_deg, double place_latitude_deg, double longitude_from_deg);

/// The point at 110 km altitude that an observer so high sees in a direction; none if the line of sight
/// meets the Earth first, or never reaches that altitude.
struct LineOfSight {
  double azimuth_deg = 0.0, elevation_deg = 0.0;
};
std::optional<GroundPoint> ground_of_sight(const LineOfSight& sight, double observer_altitude_km);

}  // namespace vegard::fit
