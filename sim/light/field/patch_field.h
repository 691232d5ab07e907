// Computes patches of the reference field, and evaluates them for double and for dual numbers.
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

/// Returns the field in the site's east, north and up, as a function of the foot's east and north at
/// kFootAltitudeKm in the tangent plane, in km. Latitudes on the scene's sphere are used as geodetic ones.
std::shared_ptr<const FieldPatch> plane_field(const Igrf& igrf, const Site& site);

/// Returns the field in the Earth's axes, as a function of the coordinates on the faces of a cube about its
/// centre (sim/emit/footprint/map/footprint_map.h). The field is fixed to the Earth; the cube is rotated to
/// the east by `turned_deg`.
std::shared_ptr<const std::array<FieldPatch, 6>> face_fields(const Igrf& igrf, double turned_deg);

}  // namespace vegard::sim
