// Patches of the reference field, and the field of a patch at a place, for double and for dual numbers.
#pragma once

#include <array>
#include <memory>

#include "sim/base/number/dual.h"
#include "sim/light/field/field_patch.h"
#include "sim/light/field/igrf.h"
#include "sim/scene/structs/site.h"

namespace vegard::sim {

template <class T>
inline T select(bool which, const T& yes, const T& no) {
  return which ? yes : no;
}

#define VEGARD_INLINE inline
#include "sim/light/field/field_body.h"
#undef VEGARD_INLINE

/// In the site's east, north and up, by east and north of the foot at kFootAltitudeKm in the tangent plane,
/// in km. Latitudes of the scene's sphere count as geodetic ones.
std::shared_ptr<const FieldPatch> plane_field(const Igrf& igrf, const Site& site);

/// In the Earth's axes, by the places on the faces of a cube about its centre
/// (sim/emit/footprint/map/footprint_map.h). The field stands where the Earth is; the cube has been turned to
/// the east by an angle.
std::shared_ptr<const std::array<FieldPatch, 6>> face_fields(const Igrf& igrf, double turned_deg);

}  // namespace vegard::sim
