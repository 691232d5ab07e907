// The azimuthal equidistant projection of the Earth's surface about a place. A point at the angle psi from
// the place, seen from the Earth's centre, in the direction of the azimuth a, is drawn at the distance 6371
// km psi in that direction (Snyder 1987, "Map projections: a working manual", USGS Professional Paper 1395,
// chapter 25, for a sphere). Distances and directions from the place are true.
#pragma once

#include <optional>

#include "fit/report/plot/plot_canvas.h"
#include "sim/base/number/vec3.h"

namespace vegard::fit {

/// A projected point: kilometres on the ground to the east (x) and to the north (y).
using GroundPoint = PlotPoint;

/// Projects a direction from the Earth's centre, given in the east, north and up of the place; its length
/// does not matter.
GroundPoint ground_point(const double (&from_centre_enu)[3]);

/// Projects a foot in the tangent plane of the place. NaN beyond the sphere's edge.
GroundPoint ground_of_foot(sim::EastNorth foot_km);

/// Projects a place on the sphere. The centre of the projection is at `latitude_deg`; `longitude_from_deg` is
/// the place's longitude relative to it.
GroundPoint ground_of_place(double latitude_deg, double place_latitude_deg, double longitude_from_deg);

/// A direction of view.
struct LineOfSight {
  double azimuth_deg = 0.0, elevation_deg = 0.0;
};
/// Projects the point at 110 km altitude that an observer at this altitude sees in a direction; none if the
/// line of sight meets the Earth first, or never reaches 110 km.
std::optional<GroundPoint> ground_of_sight(const LineOfSight& sight, double observer_altitude_km);

}  // namespace vegard::fit
