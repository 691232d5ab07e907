// The aurora of a footprint, marched along rays from the camera.
//
// The volume emission rate of a line is the energy flux at the point's foot times the rate of the height
// profile there. For T = double the steps lie in vector lanes (sim/emit/footprint/footprint_kernel_types.h),
// in floats: rayleighs agree with a march in double precision to about 1e-5. For T = FreeDual the same march
// is in dual numbers, with exact derivatives with respect to the parameters of the camera, the field, the
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

// The emitter of a footprint as curtains: upright walls of no thickness along its spline, a fast preview.
//
// A wall is visible from both sides. It represents a Gaussian of standard deviation `width_km` across it,
// measured horizontally; a ray collects flux * width_km * sqrt(2 pi) * rate(altitude), times the cosine of
// the angle between the wall's normal and the horizontal, over the cosine of incidence. At less than 3
// degrees from the wall's plane the path is limited to that at 3 degrees, since a real wall bends before the
// path becomes longer.

/// Position and brightness of a footprint at an instant.
struct FootprintAt {
  EastNorth drifted_km{};   ///< drift of a box since the clock's zero
  double turned_deg = 0.0;  ///< rotation of a shell to the east
  double share = 1.0;       ///< factor on its light
  double instant_s = 0.0;   ///< of rays and of a substorm's bulge
};

/// Makes the emitter of a footprint with model "curtain". `changes` is as for plane_footprint_emitter(). T is
/// double or FreeDual. Rays find walls by a hierarchy of boxes; as a reference they try all, with the same
/// light to the last bit.
template <class T>
std::unique_ptr<Emitter<T>> curtain_emitter(const Scene& scene, const Footprint& footprint,
                                            const ProfileTable& profiles, const ProfileChanges& changes,
                                            const NumberAs<T>& number, const FootprintAt& at = {},
                                            MarchBy by = MarchBy::lanes);

}  // namespace vegard::sim
