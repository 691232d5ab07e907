// [sun]: where the Sun stands, and its photosphere.
#include <algorithm>

#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/row.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value Sun::*value) {
  return Row("sun", key, &Scene::sun, value);
}

std::vector<Declaration> sun_rows() {
  // clang-format off
  return {
      row("shown", &Sun::shown).means("whether the Sun and all on it are in the scene"),
      row("azimuth_deg", &Sun::azimuth_deg).as(ParameterRole::sun_azimuth).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("direction of its middle, from north to the east"),
      row("elevation_deg", &Sun::elevation_deg).as(ParameterRole::sun_elevation).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("direction of its middle above the horizon"),
      row("distance_km", &Sun::distance_km).in("km").within(1, 1e12).may_be_free(ParameterScale::logarithmic).means("distance of its middle"),
      row("position_angle_deg", &Sun::position_angle_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("anticlockwise rotation of its north pole as seen by the observer (P)"),
      row("latitude_deg", &Sun::latitude_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("heliographic latitude of the middle of its disc (B0)"),
      row("longitude_deg", &Sun::longitude_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("heliographic longitude of the middle of its disc (L0), westwards"),
      row("unit_km", &Sun::unit_km).in("km").within(1e-3, 1e9).means("unit of all lengths on the Sun"),
      row("radius", &Sun::radius).within(1e-3, 1e9).means("radius of the photosphere"),
      row("photosphere_rayleigh", &Sun::photosphere_rayleigh).by_line().in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light at the middle of the disc, per line; empty: dark"),
      row("limb_darkening", &Sun::limb_darkening).within(0, 1).may_be_free(ParameterScale::linear).means("u of the law 1 - u (1 - μ) - v (1 - μ)²; 0: uniform"),
      row("limb_darkening_square", &Sun::limb_darkening_square).within(-1, 1).may_be_free(ParameterScale::linear).means("v of that law"),
      row("rotation", &Sun::rotation).one_of<SolarRotation>({{"none", SolarRotation::none}, {"rigid", SolarRotation::rigid}, {"differential", SolarRotation::differential}})
          .means("rotation with the scene's clock (docs/corona/time.md): none; at Carrington's rate; or slower towards the poles"),
      row("rotation_frame", &Sun::rotation_frame).one_of<RotationFrame>({{"synodic", RotationFrame::synodic}, {"sidereal", RotationFrame::sidereal}})
          .means("frame of that rotation: as seen from the Earth, or from the stars"),
  };
  // clang-format on
}

void check_sun(const Scene& scene) {
  if (!scene.sun.shown) return;
  const ElementCheck check(scene, "sun");
  check.check_lines(scene.sun.photosphere_rayleigh, true, "photosphere_rayleigh");
  if (scene.sun.limb_darkening + scene.sun.limb_darkening_square > 1.0)
    check.refuse(
        {"the limb would be darker than black", "limb_darkening + limb_darkening_square of at most 1", ""},
        "limb_darkening");
  if (scene.sun.distance_km <= scene.sun.radius * scene.sun.unit_km)
    check.refuse({"the observer is inside of the Sun", "a distance above radius times unit_km", ""},
                 "distance_km");
}

std::optional<Complaint> why_sun_inert(const Scene& scene, const ParameterPath& path) {
  if (path.row->table != "sun") return std::nullopt;
  const std::string& key = path.row->key;
  if (!scene.sun.shown) return inert("the Sun is not in the scene", key, "set sun.shown = true");
  const bool scatters = std::any_of(scene.coronae.begin(), scene.coronae.end(),
                                    [](const Corona& c) { return c.light == CoronaLight::scattered; });
  if (is_one_of(key, {"limb_darkening", "limb_darkening_square"}) && !scatters &&
      all_zero(scene.sun.photosphere_rayleigh) && !frees(scene, "sun.photosphere_rayleigh"))
    return inert("the photosphere is dark", key, "give it sun.photosphere_rayleigh");
  // What is alike all round looks the same from all sides.
  OnSun least_alike = OnSun::nothing;
  for (const EmitterKind& kind : emitter_kinds())
    least_alike = std::max(least_alike, what_is_on_sun(kind, scene));
  if ((key == "longitude_deg" && least_alike < OnSun::uneven) ||
      (is_one_of(key, {"position_angle_deg", "latitude_deg"}) && least_alike < OnSun::alike_about_axis))
    return inert("what shines on the Sun is alike all round", key, "set something on it");
  return std::nullopt;
}

bool sun_is_shown(const Scene& scene) { return scene.sun.shown; }

/// The photosphere is what the others stand on.
OnSun photosphere_on_sun(const Scene&) { return OnSun::nothing; }

std::vector<LightLocation> where_sun_are(const Scene& scene) {
  if (!scene.sun.shown) return {};
  return {{LightLocation::Known::direction, "the Sun", {}, scene.sun.azimuth_deg, scene.sun.elevation_deg}};
}

}  // namespace

EmitterKind sun_kind() {
  EmitterKind kind;
  kind.table = "sun";
  kind.rows = sun_rows;
  kind.light = LightKind::sun;
  kind.is_drawn = sun_is_shown;
  kind.check = check_sun;
  kind.why_inert = why_sun_inert;
  kind.on_sun = photosphere_on_sun;
  kind.light_locations = where_sun_are;
  kind.spoken = "Sun";
  kind.place_in_preview = 6;
  return kind;
}

}  // namespace vegard::sim
