// Converts a ridge of a map to a sheet along a curve, with its free parameters.
//
// A ridge has a point every few kilometres; a fit wants as few as its shape needs. Points are added where the
// curve through those that are there is farthest from the ridge, or its light from the ridge's, until both
// are close. What a map constrains of a curtain is its light per kilometre, flux times width: the width is an
// upper limit. So the sheet has that light, and the width is free.
//
// Free are: each point's distance across the ridge (a number "NAME_across_km_I", to the left of the curve's
// direction, which the point's east and north follow by fit.tied), the brightness of each point, and energies
// and widths at fewer knots, between which their logarithms go straight along the curve. One brightness of
// all is held: a gain is solved for.
//
// A map's curtain ends where the picture does, and the aurora does not: its light from beyond leans into
// view. So a curve whose end leaves the picture goes on straight from there, as bright as it ends, and what
// is free of its last point in view moves that piece along.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// What a map says at one place of a ridge.
struct RidgePoint {
  sim::EastNorth foot_km;  ///< at 110 km altitude, in the site's tangent plane
  double flux_mw_m2 = 0.0, energy_kev = 0.0, width_km = 0.0;
};

struct Ridge {
  std::string name;                ///< as the sheet's
  std::vector<RidgePoint> points;  ///< two or more, in order
};

/// A ridge whose ends are nearer to each other than this makes no curve.
inline constexpr double kMinRidge_km = 5.0;

/// Which ends of a curve go on beyond the picture, by one point each.
struct CurveEnds {
  bool before = false, after = false;
};

/// Those of a ridge whose lower border would be out of every picture of the scene a little further on.
CurveEnds ends_out_of_view(const sim::Scene& scene, const Ridge& ridge);

/// A sheet of the ridge's light: integral of flux times width along it, what lies beyond its ends left out.
sim::Sheet sheet_of_ridge(const Ridge& ridge, const CurveEnds& ends = {});

/// Which points of a sheet's curve, those beyond the picture left out, are knots at least so far apart along
/// it: the first and the last, and as many between them as there is room for.
std::vector<int> knots_of_curve(const sim::Sheet& sheet, double apart_km, const CurveEnds& ends = {});

/// Adds a sheet for a ridge of a map of this scene, and what is free of it.
void add_curve(sim::Scene& scene, const Ridge& ridge);

/// Takes a sheet and all that is free of it out of the scene.
void drop_curve(sim::Scene& scene, const std::string& name);

/// Energy flux times width along the whole curve, in W if the flux is absolute (at the peak of a Gaussian
/// across, without its sqrt(2 pi)).
double light_of_curve(const sim::Sheet& sheet);

/// The scene without sheets and other emitters and without what was free or tied of them, one gain for all
/// of the picture, and no search before the descent.
sim::Scene without_emitters(const sim::Scene& scene);

/// That scene with a curve for each ridge.
sim::Scene scene_of_ridges(const sim::Scene& scene, const std::vector<Ridge>& ridges);

}  // namespace vegard::fit
