// [sun]: where the Sun stands, and its photosphere.
#include <algorithm>

#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"

namespace vegard::sim {
namespace {

template <class Value>
Row<Sun> row(const char* key, Value Sun::*value) {
  return Row("sun", key, &Scene::sun, value)
      .inert_if([](const Sun& sun) { return !sun.shown; }, "the Sun is not in the scene",
                "set sun.shown = true");
}

/// What the light of a lamp is worked out from is known by its value alone: the Sun's own light for every
/// volume that it lights, its place for those about the site.
std::optional<Complaint> why_lamp_unknown(const Scene& scene, bool is_place) {
  for (const Volume& volume : scene.volumes)
    if (volume.lamp == VolumeLamp::sun && (!is_place || volume.frame == VolumeFrame::site))
      return Complaint{
          "the Sun lights the volume '" + volume.name + "', whose derivative by {key} is not known",
          "another number", "leave it out of fit.free, or set the volume's lamp to another"};
  return std::nullopt;
}
std::optional<Complaint> why_light_unknown(const Sun&, const Scene& scene) {
  return why_lamp_unknown(scene, false);
}
std::optional<Complaint> why_place_unknown(const Sun&, const Scene& scene) {
  return why_lamp_unknown(scene, true);
}

bool is_photosphere_unseen(const Sun& sun, const Scene& scene) {
  const bool scatters = std::any_of(scene.coronae.begin(), scene.coronae.end(),
                                    [](const Corona& c) { return c.light == CoronaLight::scattered; });
  return !scatters && all_zero(sun.photosphere_rayleigh) && !frees(scene, "sun.photosphere_rayleigh");
}

/// The least symmetry under rotation of what stands on the Sun.
OnSun least_alike(const Scene& scene) {
  OnSun least = OnSun::nothing;
  for (const EmitterKind& kind : emitter_kinds()) least = std::max(least, what_is_on_sun(kind, scene));
  return least;
}

std::vector<Declaration> sun_rows() {
  const char* const same_from_all_sides = "what shines on the Sun is alike all round";
  // clang-format off
  return {
      row("shown", &Sun::shown).means("the Sun and all on it are in the scene"),
      row("azimuth_deg", &Sun::azimuth_deg).as(ParameterRole::sun_azimuth).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("azimuth of its middle")
          .not_free_if(why_place_unknown),
      row("elevation_deg", &Sun::elevation_deg).as(ParameterRole::sun_elevation).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("elevation of its middle")
          .not_free_if(why_place_unknown),
      row("distance_km", &Sun::distance_km).in("km").within(1, 1e12).may_be_free(ParameterScale::logarithmic).means("distance of its middle")
          .not_free_if(why_place_unknown),
      row("position_angle_deg", &Sun::position_angle_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("of its north pole, anticlockwise (P)")
          .inert_if([](const Sun&, const Scene& scene) { return least_alike(scene) < OnSun::alike_about_axis; }, same_from_all_sides, "set something on it"),
      row("latitude_deg", &Sun::latitude_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("heliographic, of its disc's middle (B0)")
          .inert_if([](const Sun&, const Scene& scene) { return least_alike(scene) < OnSun::alike_about_axis; }, same_from_all_sides, "set something on it"),
      row("longitude_deg", &Sun::longitude_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("heliographic, of its disc's middle, westwards (L0)")
          .inert_if([](const Sun&, const Scene& scene) { return least_alike(scene) < OnSun::uneven; }, same_from_all_sides, "set something on it"),
      row("unit_km", &Sun::unit_km).in("km").within(1e-3, 1e9).means("unit of all lengths on the Sun"),
      row("radius", &Sun::radius).within(1e-3, 1e9).means("radius of the photosphere"),
      row("photosphere_rayleigh", &Sun::photosphere_rayleigh).by_line().in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("at the disc's middle, per line; empty: dark")
          .not_free_if(why_light_unknown),
      row("limb_darkening", &Sun::limb_darkening).within(0, 1).may_be_free(ParameterScale::linear).means("u of the law 1−u(1−μ)−v(1−μ)²; 0: uniform")
          .not_free_if(why_light_unknown)
          .inert_if(is_photosphere_unseen, "the photosphere is dark", "give it sun.photosphere_rayleigh"),
      row("limb_darkening_square", &Sun::limb_darkening_square).within(-1, 1).may_be_free(ParameterScale::linear).means("v of that law")
          .not_free_if(why_light_unknown)
          .inert_if(is_photosphere_unseen, "the photosphere is dark", "give it sun.photosphere_rayleigh"),
      row("rotation", &Sun::rotation).one_of<SolarRotation>({{"none", SolarRotation::none}, {"rigid", SolarRotation::rigid}, {"differential", SolarRotation::differential}})
          .means("with the scene's clock (docs/corona/time.md): none; at Carrington's rate; or slower towards the poles"),
      row("rotation_frame", &Sun::rotation_frame).one_of<RotationFrame>({{"synodic", RotationFrame::synodic}, {"sidereal", RotationFrame::sidereal}})
          .means("as seen from the Earth, or from the stars"),
  };
  // clang-format on
}

void check_sun(const Scene& scene) {
  if (!scene.sun.shown) return;
  const ElementCheck check(scene, "sun");
  check.check_lines(scene.sun.photosphere_rayleigh, true, "photosphere_rayleigh");
  if (scene.sun.limb_darkening + scene.sun.limb_darkening_square > 1.0)
    throw check.error_at(
        {"the limb would be darker than black", "limb_darkening + limb_darkening_square of at most 1", ""},
        "limb_darkening");
  if (scene.sun.distance_km <= scene.sun.radius * scene.sun.unit_km)
    throw check.error_at({"the observer is inside of the Sun", "a distance above radius times unit_km", ""},
                         "distance_km");
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
  kind.on_sun = photosphere_on_sun;
  kind.light_locations = where_sun_are;
  kind.spoken = "Sun";
  kind.place_in_preview = 6;
  return kind;
}

}  // namespace vegard::sim
