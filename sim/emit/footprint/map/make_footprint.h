// Makes the map of energy flux and energy of a scene's footprint, of every kind.
//
// docs/volumes.md, "Footprints", describes how each kind is made.
#pragma once

#include <optional>

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/emit/footprint/map/picture_footprint.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the drift of a footprint since the clock's zero.
inline EastNorth drifted_km(const Footprint& footprint, double instant_s) {
  return {footprint.drift_km_s.east * instant_s, footprint.drift_km_s.north * instant_s};
}

/// Returns the rotation of a shell to the east.
double turned_deg(const Scene& scene, const Footprint& footprint, double instant_s);

/// Makes the map of a footprint of shape "box" at an instant of the scene's clock (none: the scene's start).
/// A footprint of the sheets is the mean over all instants of an exposure that begins at this instant, with
/// the flow of this instant. The map's flux is in mW m^-2; energies are over footprint.energy_kev. For T =
/// FreeDual it has the derivatives with respect to every parameter to which `number` gives a tangent:
/// east_km, north_km, center_km, width_km, energy_flux_mw_m2, point_flux and point_energy; for a footprint
/// with a flow only center_km, energy_flux_mw_m2 and point_energy, on which the flow does not depend. The
/// grid itself stays at center_km. The map does not depend on the number of threads. Throws Error(scene)
/// where derivatives need more memory than kMaxMapBytes (sim/scene/structs/footprint.h).
template <class T>
PlaneFootprint<T> make_plane_footprint(const Scene& scene, const Footprint& footprint,
                                       const FootprintPictures& pictures, const NumberAs<T>& number,
                                       int threads, std::optional<double> instant_s = {});

extern template PlaneFootprint<double> make_plane_footprint(const Scene&, const Footprint&,
                                                            const FootprintPictures&, const NumberAs<double>&,
                                                            int, std::optional<double>);
extern template PlaneFootprint<FreeDual> make_plane_footprint(const Scene&, const Footprint&,
                                                              const FootprintPictures&,
                                                              const NumberAs<FreeDual>&, int,
                                                              std::optional<double>);

/// Makes the map of a footprint of shape "shell".
CubeFootprint<double> make_cube_footprint(const Scene& scene, const Footprint& footprint,
                                          const FootprintPictures& pictures, int threads,
                                          std::optional<double> instant_s = {});

}  // namespace vegard::sim
