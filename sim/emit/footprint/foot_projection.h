// The rule by which the feet of a footprint's light are found.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/footprint/march_span.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the rule for the feet of a footprint of the scene, in the axes of the footprint's own site (a
/// uniform field has the same components in the axes of every site). A uniform field is valid only near the
/// observer, so with it the feet of a shell are vertically below; a curtain around the Earth is always
/// upright. A shell's rotation to the east turns its pattern, but not the field.
template <class T>
FootRule<T> rule_of_foot(const Scene& scene, const Footprint& footprint, const NumberAs<T>& number,
                         double turned_deg = 0.0) {
  FootRule<T> rule;
  rule.sphere_km = scene.body.radius_km;
  std::fill_n(rule.axis, 3, T(0.0));
  const bool is_shell = footprint.shape == FootprintShape::shell;
  rule.projection = is_shell ? FootProjection::shell : FootProjection::vertical;
  if (footprint.fall != FootprintFall::field) return rule;
  if (is_shell && (scene.field.model == FieldModel::uniform || footprint.model == FootprintModel::curtain))
    return rule;
  const Site& home = footprint.home ? *footprint.home : scene.site;
  switch (scene.field.model) {
    case FieldModel::dipole:
      rule.projection = is_shell ? FootProjection::shell_dipole : FootProjection::dipole;
      if (is_shell) {
        const double latitude = scene.field.pole_latitude_deg * kRadiansPerDegree,
                     longitude = (scene.field.pole_longitude_deg - turned_deg) * kRadiansPerDegree;
        rule.axis[0] = T(std::cos(latitude) * std::cos(longitude));
        rule.axis[1] = T(std::cos(latitude) * std::sin(longitude));
        rule.axis[2] = T(std::sin(latitude));
      } else {
        const DipoleAxis dipole = dipole_axis(scene.field, home, scene.body.radius_km);
        std::copy_n(dipole.in_enu, 3, rule.axis);
      }
      break;
    case FieldModel::igrf:
      rule.projection = is_shell ? FootProjection::shell_reference : FootProjection::reference;
      if (is_shell) {
        rule.patches = face_fields(Igrf(igrf_year(scene)), turned_deg);
      } else {
        auto patches = std::make_shared<std::array<FieldPatch, 6>>();
        (*patches)[0] = *reference_field(scene, home);
        rule.patches = std::move(patches);
      }
      break;
    case FieldModel::uniform: {
      const FallFrame<T> frame = fall_frame<T>(number(scene.field.inclination_deg) * kRadiansPerDegree,
                                               number(scene.field.declination_deg) * kRadiansPerDegree);
      std::copy_n(frame.along, 3, rule.axis);
      rule.projection = FootProjection::field;
      break;
    }
  }
  return rule;
}

/// Returns the rule without derivatives.
template <class T>
FootRule<double> plain_rule(const FootRule<T>& rule) {
  FootRule<double> plain;
  plain.projection = rule.projection;
  plain.sphere_km = rule.sphere_km;
  for (int i = 0; i < 3; ++i) plain.axis[i] = value_of(rule.axis[i]);
  plain.patches = rule.patches;
  return plain;
}

}  // namespace vegard::sim
