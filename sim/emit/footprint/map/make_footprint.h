// The one door to footprints: from a scene's words to a map of energy flux and energy.
//
// docs/volumes.md, "Footprints", says how each kind is made.
#pragma once

#include <optional>

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/emit/footprint/map/picture_footprint.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// How far a footprint has gone since the clock's zero.
inline EastNorth drifted_km(const Footprint& footprint, double instant_s) {
  return {footprint.drift_km_s.east * instant_s, footprint.drift_km_s.north * instant_s};
}

/// By how much a shell has turned to the east.
double turned_deg(const Scene& scene, const Footprint& footprint, double instant_s);

/// Of a footprint of shape "box", at an instant of the scene's clock (none: its start); of the sheets it is
/// the mean over all instants of the exposure, as if that began then, wound up by as much as at this one. The
/// map's flux is in mW m^-2; energies are over footprint.energy_kev. For T = FreeDual it carries the
/// derivatives by every number that `number` gives a tangent: east_km, north_km, center_km, width_km,
/// energy_flux_mw_m2, point_flux and point_energy; of a footprint that flows only by center_km,
/// energy_flux_mw_m2 and point_energy, which the flow does not depend on. The grid itself stays where
/// center_km has it. The same for every number of threads. Throws Error(scene) where derivatives need more
/// memory than kMaxMapBytes (sim/scene/structs/footprint_size.h).
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

/// Of a footprint of shape "shell".
CubeFootprint<double> make_cube_footprint(const Scene& scene, const Footprint& footprint,
                                          const FootprintPictures& pictures, int threads,
                                          std::optional<double> instant_s = {});

}  // namespace vegard::sim
