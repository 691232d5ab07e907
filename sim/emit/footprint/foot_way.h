// How the feet of a footprint's light are found.
#pragma once

#include <algorithm>

#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/dipole.h"
#include "sim/emit/footprint/footprint_kernel_types.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The way of a footprint of the scene, in the axes of the site that it is given about (a uniform field is
/// the same in all of them: that of its home goes with it), with FootprintKernel's axis in `axis`: zeros
/// where there is none.
template <class T>
FootWay way_of_foot(const Scene& scene, const Footprint& footprint, const NumberAs<T>& number, T axis[3]) {
  std::fill_n(axis, 3, T(0.0));
  if (footprint.shape == FootprintShape::shell) return FootWay::shell;
  if (footprint.fall != FootprintFall::field) return FootWay::vertical;
  if (scene.field.model == FieldModel::dipole) {
    const DipoleAxis dipole = dipole_axis(scene.field, footprint.home ? *footprint.home : scene.site);
    std::copy_n(dipole.in_enu, 3, axis);
    return FootWay::dipole;
  }
  const FallFrame<T> frame = fall_frame<T>(number(scene.field.inclination_deg) * kRadiansPerDegree,
                                           number(scene.field.declination_deg) * kRadiansPerDegree);
  std::copy_n(frame.along, 3, axis);
  return FootWay::field;
}

}  // namespace vegard::sim
