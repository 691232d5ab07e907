// The electrons that fall at one point of the sheets' footprint: the mean over all draws of beams, and where
// a field line through a point in space has its foot.
//
// Across a layer Q is the Gaussian of sim/emit/aurora/sheet.h; layers, arcs and sheets add up, each with its
// own energy. A curve's electrons are those of its nearest points; that they crowd on the inner side of a
// bend is left out. Rays, patches and an undulating border have means of 1 and 0, so they are left out too,
// as is how far electrons wander on their way down (0.3 km after 200 km, docs/physics.md).
#pragma once

#include <vector>

#include "sim/light/emitter.h"
#include "sim/light/sample.h"

namespace vegard::sim {

struct Scene;

/// Electrons of one sheet at a foot.
template <class T>
struct FootElectrons {
  int sheet = 0;
  T energy_flux_mw_m2{};
  T ln_energy_kev{};  ///< of the sheet's characteristic energy
};

/// Returns the electrons of every sheet at the point of the site's tangent plane (east, north) at
/// kFootAltitudeKm: the mean over the instants of the exposure. Sheets without electrons there have none in
/// the result. Folds, curls and spirals must be off. `number` is as for Emitter. T is double or FreeDual.
template <class T>
std::vector<FootElectrons<T>> foot_electrons(const Scene& scene, const T& east_km, const T& north_km,
                                             const NumberAs<T>& number);

/// The point of the tangent plane at kFootAltitudeKm.
template <class T>
struct FootPlace {
  T east_km{}, north_km{};
};

/// Returns the foot of the field line through a point of the site's frame (east, north, up in km from the
/// observer), by the scene's field model. A field line is straight.
template <class T>
FootPlace<T> foot_below(const Scene& scene, const double point_km[3], const NumberAs<T>& number);

/// Returns the point above a latitude and longitude in the frame of foot_below().
struct PointInSpace {
  double enu_km[3];
};
PointInSpace point_above(const Scene& scene, double latitude_deg, double longitude_deg, double altitude_km);

/// Returns how far the nearest line of any sheet is from a foot, km; infinite without sheets.
double distance_to_sheets_km(const Scene& scene, double east_km, double north_km);

}  // namespace vegard::sim
