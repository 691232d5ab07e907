// The line of a sheet's feet in the tangent plane, and its place on the Earth.
//
// Feet are points of the sphere 110 km above the body's whose east and north are given in the site's tangent
// plane (docs/physics.md, "Where things are"): a foot at the distance d is at the angle asin(d / 6481 km)
// from the site, seen from the Earth's centre. Latitudes are those of the sphere. A geomagnetic latitude is
// that of the centred dipole whose northern pole is given by [field] of the scene (IGRF-13 of 2020 by
// default): asin(n . r).
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/sheet.h"

namespace vegard::sim {

struct Scene;

/// Points of the straight line from start to end, with its drift at an instant. For a system of arcs they are
/// on its middle line, except that `nearest` is on the nearest arc. For a curve they are points of the curve.
struct FootPoints {
  EastNorth start, middle, end, nearest;
};
FootPoints foot_points(const Sheet& sheet, double instant_s);

/// Return `count` points of an arc from start to end: of the straight line, and of the sine in the middle
/// between the first and the last layer (without folds and curls). For a curve both return points of the
/// curve.
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

/// Returns the place of a foot; all NaN beyond the sphere's edge.
PlaceOnEarth place_of_foot(const Scene& scene, EastNorth foot_km);

/// Standard error of a sheet's line across it, as a function of the coordinate along it.
struct FootBand {
  std::string sheet;
  std::vector<double> along_km;  ///< from the middle towards the end
  std::vector<double> sigma_km;  ///< across the line; empty if not known
};

/// Returns the coordinates at which a FootBand is reported.
std::vector<double> band_places_km(const Sheet& sheet);

/// Returns how far the line of `moved` lies to the left of that of `best` at the places `along_km` of best's
/// line.
std::vector<double> aside_km(const Sheet& best, const Sheet& moved, double instant_s,
                             const std::vector<double>& along_km);

}  // namespace vegard::sim
