// The foot of the field line through a point in space, for double and for dual numbers.
//
// The frame is the observer's east, north and up, or the Earth's axes for the faces of a cube, with its
// origin at the Earth's centre. In packs of floats an altitude has an error below 0.0005 km, a foot one of
// about 0.001 km.
#pragma once

#include <utility>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/light/field/field_patch.h"
#include "sim/light/sample.h"

namespace vegard::sim {

#define VEGARD_INLINE inline
#include "sim/emit/footprint/foot_body.h"
#undef VEGARD_INLINE

}  // namespace vegard::sim
