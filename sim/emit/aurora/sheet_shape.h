// The numbers of one arc of a scene's sheets at an instant.
#pragma once

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the shape of one arc of a sheet's system at an instant. `number(n, scale)` gives scale times a
/// parameter of the scene as T, `number(n)` the parameter itself.
template <class T, class Number>
SheetShape<T> sheet_shape(const Scene& scene, int sheet, int arc, double instant_s, const Number& number) {
  const Sheet& s = scene.sheets[sheet];
  SheetShape<T> shape;
  shape.center_east_km = number(s.center_km.east) + s.drift_km_s.east * instant_s;
  shape.center_north_km = number(s.center_km.north) + s.drift_km_s.north * instant_s;
  const T bearing_rad = number(s.bearing_deg, kRadiansPerDegree);
  shape.along_east = sine(bearing_rad);
  shape.along_north = cosine(bearing_rad);
  shape.length_km = number(s.length_km);
  shape.thickness_km = number(s.thickness_km);
  shape.wavelength_km = number(s.wavelength_km);
  // A sine that travels: its phase at a place falls behind by the way it has gone.
  shape.phase_rad = number(s.phase_rad) - T(s.sine_speed_km_s * instant_s * kTwoPi) / shape.wavelength_km;
  shape.phase_shift_rad = number(s.phase_shift_rad);
  shape.width_km = number(s.width_km);
  const T flux = has_given_brightness(s) ? T(1.0) : T(number(s.energy_flux_mw_m2));
  shape.energy_flux_mw_m2 = flux * substorm_level(scene.substorm, instant_s);
  shape.arc_offset_km = number(s.arc_spacing_km) * (arc - 0.5 * (s.arcs - 1));
  shape.side = falls_along_field(scene) ? 1.0 : -1.0;
  shape.fold_stage = number(s.fold_stage);
  return shape;
}

}  // namespace vegard::sim
