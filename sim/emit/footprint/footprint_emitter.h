// The aurora of a footprint, marched along rays from the camera.
//
// The volume emission rate of a line is the energy flux at the point's foot times the rate of the height
// profile there. For T = double the steps lie in vector lanes (sim/emit/footprint/footprint_kernel.h), in
// floats: rayleighs agree with a march in double precision to about 1e-5. For T = FreeDual the same march is
// in dual numbers, with exact derivatives with respect to the parameters of the camera, the field, the
// footprint's shape, the energy and the energy flux.
#pragma once

#include <memory>

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/emitter.h"
#include "sim/light/profile_table.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Whether the steps are marched in vector lanes, or one after the other in double as a reference.
enum class MarchBy { lanes, reference };

/// Makes the emitter of a footprint of shape "box". `changes` is needed for derivatives only; if it is empty,
/// the light is taken as proportional to the flux and independent of the oxygen.
template <class T>
std::unique_ptr<Emitter<T>> plane_footprint_emitter(const Scene& scene, const Footprint& footprint,
                                                    PlaneFootprint<T> map, const ProfileTable& profiles,
                                                    const ProfileChanges& changes, const NumberAs<T>& number,
                                                    int threads, MarchBy by = MarchBy::lanes);

/// Makes the emitter of a footprint of shape "shell".
template <class T>
std::unique_ptr<Emitter<T>> cube_footprint_emitter(const Scene& scene, const Footprint& footprint,
                                                   CubeFootprint<double> map, const ProfileTable& profiles,
                                                   const ProfileChanges& changes, const NumberAs<T>& number,
                                                   int threads, MarchBy by = MarchBy::lanes);

/// Make these footprints as fields in space, in the observer's east, north and up.
std::unique_ptr<LightField> plane_footprint_field(const Scene& scene, const Footprint& footprint,
                                                  PlaneFootprint<double> map, const ProfileTable& profiles,
                                                  int threads);
std::unique_ptr<LightField> cube_footprint_field(const Scene& scene, const Footprint& footprint,
                                                 CubeFootprint<double> map, const ProfileTable& profiles,
                                                 int threads);

}  // namespace vegard::sim
