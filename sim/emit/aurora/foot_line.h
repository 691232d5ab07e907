// The line on which a sheet's feet stand, in the tangent plane, and where that is on the Earth.
//
// Feet are points of the sphere 110 km above the body's whose east and north are given in the site's tangent
// plane (docs/physics.md, "Where things are"): a foot at the distance d stands asin(d / 6481 km) from the
// site, seen from the Earth's centre. Latitudes are those of the sphere. A geomagnetic latitude is that of
// the centred dipole whose pole in the north the scene has in [field] (IGRF-13 of 2020 by default): asin(n .
// r).
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Of the straight line from start to end, where it has drifted to at an instant. Of a system of arcs: the
/// system's middle line; the nearest point is that of the nearest arc. Of a curve they are its own points.
struct FootPoints {
  EastNorth start, middle, end, nearest;
};
FootPoints foot_points(const Sheet& sheet, double instant_s);

/// Points of an arc, `count` of them from start to end: the straight line, and the sine of the middle between
/// the first and the last layer (without folds and curls). Of a curve both are its own.
std::vector<EastNorth> straight_feet(const Sheet& sheet, double instant_s, int arc, int count);
std::vector<EastNorth> sine_feet(const Scene& scene, const Sheet& sheet, double instant_s, int arc,
                                 int count);

struct PlaceOnEarth {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;  ///< above -180, to 180
  double longitude_from_site_deg = 0.0;
  double magnetic_latitude_deg = 0.0;
};

/// Above -180, to 180.
double wrapped_longitude_deg(double longitude_deg);

/// All NaN beyond the sphere's edge.
PlaceOnEarth place_of_foot(const Scene& scene, EastNorth foot_km);

/// How far a sheet's line may be off to the side, against the coordinate along it.
struct FootBand {
  std::string sheet;
  std::vector<double> along_km;  ///< from the middle towards the end
  std::vector<double> sigma_km;  ///< across the line; empty where it is not known
};

/// The coordinates at which a band is reported.
std::vector<double> band_places_km(const Sheet& sheet);

/// How far the line of `moved` lies to the left of that of `best` at those places of best's line.
std::vector<double> aside_km(const Sheet& best, const Sheet& moved, double instant_s,
                             const std::vector<double>& along_km);

}  // namespace vegard::sim
