#include "sim/emit/footprint/march_span.h"

#include "sim/emit/footprint/foot.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::sim {

MarchRays::MarchRays(const Scene& scene, const Footprint& footprint, double bottom_km, double turned_deg)
    : sphere_km_(scene.body.radius_km),
      observer_km_(scene.site.altitude_m * 1e-3),
      bottom_km_(bottom_km),
      top_km_(footprint.top_km),
      step_km_(scene.march.step_km),
      literal_ghosts_(scene.march.ghosts == GhostRule::literal),
      axes_{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}} {
  if (footprint.shape == FootprintShape::shell) {
    // A shell that has turned to the east is seen as from a site that is farther west by the same angle.
    Site site = scene.site;
    site.longitude_deg -= turned_deg;
    const SiteAxes axes = axes_at(site);
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 3; ++a) axes_[i][a] = axes.axis[i][a];
  } else if (is_given_elsewhere(scene, footprint)) {
    const SiteTurn home = turn_between(scene.site, *footprint.home, sphere_km_);
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 3; ++a) axes_[i][a] = home.turn[a][i];
  }
}

void fall_at_place(const FootRule<double>& rule, const double up[3], double fall[3]) {
  const double radius = rule.sphere_km + kFootAltitudeKm;
  const PlaneFoot<double> foot{up[0] * radius, up[1] * radius, true};
  switch (rule.projection) {
    case FootProjection::vertical:
    case FootProjection::shell:
      for (int a = 0; a < 3; ++a) fall[a] = -up[a];
      break;
    case FootProjection::field:
      std::copy_n(rule.axis, 3, fall);
      break;
    case FootProjection::dipole:
      dipole_fall(rule.axis, foot, rule.sphere_km, fall);
      break;
    case FootProjection::reference:
      patch_fall((*rule.patches)[0].numbers<double>(), (*rule.patches)[0].per_place, foot, fall);
      break;
    case FootProjection::shell_dipole: {
      const double along = up[0] * rule.axis[0] + up[1] * rule.axis[1] + up[2] * rule.axis[2];
      const double size = std::copysign(std::sqrt(3.0 * along * along + 1.0), along);
      for (int a = 0; a < 3; ++a) fall[a] = (rule.axis[a] - 3.0 * along * up[a]) / size;
      break;
    }
    case FootProjection::shell_reference: {
      AirPoint<double> place;
      for (int a = 0; a < 3; ++a) place.x[a] = up[a] * radius;
      place.square = kFootAltitudeKm * (kFootAltitudeKm + 2.0 * rule.sphere_km);
      const int face = static_cast<int>(face_number(place));
      const FacePlace<double> at = place_on_face(place, face);
      const FieldPatch& patch = (*rule.patches)[static_cast<std::size_t>(face)];
      double field[3];
      field_of_patch(patch.numbers<double>(), evened(at.u) * patch.per_place, evened(at.v) * patch.per_place,
                     field);
      fall_in_field(field, up, fall);
      break;
    }
  }
}

double MarchRays::foot_share(const double place_km[3], const double direction[3]) const {
  const double radius = std::hypot(place_km[0], place_km[1], place_km[2]);
  double up[3], fall[3];
  for (int a = 0; a < 3; ++a) up[a] = place_km[a] / radius;
  fall_at_place(rule_, up, fall);
  const auto along_up = [&](const double x[3]) { return x[0] * up[0] + x[1] * up[1] + x[2] * up[2]; };
  // Back to the height that the point came from, along the fall.
  const double back = along_up(direction) / std::min(along_up(fall), -1.0 / kMaxFootShare);
  return std::hypot(direction[0] - back * fall[0], direction[1] - back * fall[1],
                    direction[2] - back * fall[2]);
}

}  // namespace vegard::sim
