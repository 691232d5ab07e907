// The bulge of a substorm, which travels along an oval around the Earth.
//
// Source: S.-I. Akasofu, "The development of the auroral substorm", Planet. Space Sci. 12, 273 (1964): at the
// onset arcs brighten near midnight and bulge towards the pole; the front of the bulge, the westward
// travelling surge, goes along the oval to the west at about 1 km/s, and in the recovery all sinks back. The
// law is ours. With x the distance along the spline to the west of the place next to bulge_longitude_deg, L =
// bulge_length_km and t the time since the onset,
//   strength = level(t) · smooth_step((speed·t - x)/L) · smooth_step((x + L)/L),
// where speed·t ends at the length of a closed spline less L, at which the tail begins;
// a point of the spline is bulge_km · strength nearer to the pole, across the spline, and its flux is 1 +
// (bulge_gain - 1) · strength times its own. The level rises from 0 to 1 along a smooth step in the
// substorm's expansion and sinks to 0 in its recovery.
#pragma once

#include <vector>

#include "sim/base/number/dual.h"
#include "sim/emit/footprint/map/curve.h"
#include "sim/light/sample.h"
#include "sim/scene/structs/footprint.h"
#include "sim/scene/structs/site.h"

namespace vegard::sim {

/// Returns the bulge's level at an instant, 0 to 1.
double bulge_level(const Substorm& substorm, double instant_s);

/// Returns the strength at `west_km` from the bulge's beginning, 0 to 1. The front goes no farther than
/// `farthest_km`.
double bulge_strength(const Footprint& footprint, const Substorm& substorm, double instant_s, double west_km,
                      double farthest_km);

/// Returns the shortest time in which the bulge changes notably: in which its front goes a quarter of its
/// length, or of the substorm's phases.
double bulge_change_s(const Footprint& footprint, const Substorm& substorm);

/// Returns the points of a shell's spline with the bulge of an instant, in km about the body's middle: more
/// of them than before, or the same points if there is no bulge. `longest_km` is as of curve_pieces(). T is
/// double or FreeDual, with tangents of flux and energy alone. `places` becomes where each new point was
/// before the bulge moved it (CurvePiece::place, among `points`), or empty if there is no bulge.
template <class T>
std::vector<CurveNode<T, 3>> with_bulge(const Footprint& footprint, const Substorm& substorm,
                                        double instant_s, const std::vector<CurveNode<T, 3>>& points,
                                        double longest_km, std::vector<double>* places = nullptr);

}  // namespace vegard::sim
