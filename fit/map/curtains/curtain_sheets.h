// Converts a ridge of a map to a sheet along a curve, with its free parameters.
//
// A ridge has a point every few kilometres; a fit should have as few points as the shape needs. Points are
// added where the curve through the present ones is farthest from the ridge, or differs most from its light,
// until both are close. A map constrains the light of a curtain per kilometre, flux times width; its width is
// only an upper limit. So the sheet keeps that light, and its width is free.
//
// Free parameters are: the distance of each point across the ridge (a number "NAME_across_km_I", positive to
// the left of the curve's direction, from which the point's east and north follow by fit.tied), the
// brightness of each point, and energies and widths at fewer knots, between which their logarithms are
// interpolated linearly along the curve. One of all brightnesses is fixed, since a gain is solved for.
//
// A map's curtain ends at the edge of the picture, but the aurora continues, and rays beyond the edge may
// lean into view. So a curve whose end leaves the picture is continued straight by one point, with the
// brightness of its end; the free parameters of its last point in view move the continuation along.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// The map's values at one point of a ridge.
struct RidgePoint {
  sim::EastNorth foot_km;  ///< at 110 km altitude, in the site's tangent plane
  double flux_mw_m2 = 0.0, energy_kev = 0.0, width_km = 0.0;
};

struct Ridge {
  std::string name;                ///< name of the sheet
  std::vector<RidgePoint> points;  ///< two or more, in order
};

/// A ridge whose ends are closer to each other than this gives no curve.
inline constexpr double kMinRidge_km = 5.0;

/// Which ends of a curve are continued beyond the picture, by one point each.
struct CurtainEnds {
  bool before = false, after = false;
};

/// Finds the ends of a ridge just beyond which the lower border is out of view in all pictures of the scene.
CurtainEnds ends_out_of_view(const sim::Scene& scene, const Ridge& ridge);

/// Returns a sheet with the light of the ridge: the integral of flux times width along it, continuations
/// excluded.
sim::Sheet sheet_of_ridge(const Ridge& ridge, const CurtainEnds& ends = {});

/// Returns the indices of the knots: points of a sheet's curve, continuations excluded, that are at least
/// `apart_km` from each other along it. The first and the last point are knots, with as many between them as
/// fit.
std::vector<int> knots_of_sheet(const sim::Sheet& sheet, double apart_km, const CurtainEnds& ends = {});

/// Adds a sheet for a ridge of a map of this scene, and its free parameters.
void add_curtain(sim::Scene& scene, const Ridge& ridge);

/// Removes a sheet and its free parameters from the scene.
void drop_curtain(sim::Scene& scene, const std::string& name);

/// Returns the integral of energy flux times width along the whole curve, in W if the flux is absolute. (The
/// flux is the peak of a Gaussian across the curve; the factor sqrt(2 pi) is left out.)
double light_of_curtain(const sim::Sheet& sheet);

/// Returns the scene without sheets and other emitters and their free or tied parameters, with a single gain
/// for the whole picture, and without a search before the descent.
sim::Scene without_emitters(const sim::Scene& scene);

/// Returns without_emitters() with a curve for each ridge.
sim::Scene scene_of_ridges(const sim::Scene& scene, const std::vector<Ridge>& ridges);

}  // namespace vegard::fit
