// [[ejection]]: mass ejections, by a model of our own.
#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"

namespace vegard::sim {
namespace {

template <class Value>
Row<Ejection> row(const char* key, Value Ejection::*value) {
  return Row("ejection", key, &Scene::ejections, value);
}

std::vector<Declaration> ejection_rows() {
  using E = Ejection;
  const auto is_shell = [](const E& e) { return e.kind == EjectionKind::shell; };
  const auto is_new = [](const E& e, const Scene& scene) {
    return e.age_s + scene.time.start_s <= 0.0 && !frees(scene, "ejection." + e.name + ".age_s");
  };
  // clang-format off
  return {
      row("name", &E::name).means("name in paths"),
      row("kind", &E::kind).one_of<EjectionKind>({{"rope", EjectionKind::rope}, {"shell", EjectionKind::shell}}).means("a flux rope of twisted strands, or a shell"),
      row("latitude_deg", &E::latitude_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("heliographic, of the place that it leaves"),
      row("longitude_deg", &E::longitude_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("the same, growing to the west"),
      row("bearing_deg", &E::bearing_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("of a rope from foot to foot, from solar north to the west")
          .inert_if(is_shell, "the ejection is a shell", "set kind = \"rope\""),
      row("width_deg", &E::width_deg).in("deg").within(0.1, 120).may_be_free(ParameterScale::linear).means("at the Sun's middle, between a rope's feet or that a shell spans"),
      row("speed_km_s", &E::speed_km_s).called("speed").in("km/s").within(0, 1e5).may_be_free(ParameterScale::logarithmic).means("of its front at age 0")
          .inert_if(is_new, "the ejection is of age 0", "give it an age_s"),
      row("acceleration_m_s2", &E::acceleration_m_s2).in("m/s²").within(-1e4, 1e4).may_be_free(ParameterScale::linear).means("of its front, until it comes to rest")
          .inert_if(is_new, "the ejection is of age 0", "give it an age_s"),
      row("start_height", &E::start_height).within(1e-6, 1e9).may_be_free(ParameterScale::logarithmic).means("of its front at age 0, in sun.unit_km"),
      row("age_s", &E::age_s).in("s").within(0, 1e9).may_be_free(ParameterScale::linear).means("age at time 0"),
      row("aspect", &E::aspect).within(1e-3, 0.9).may_be_free(ParameterScale::linear).means("a rope's radius at its top or a shell's thickness, over the front's height"),
      row("turns", &E::turns).within(-100, 100).may_be_free(ParameterScale::linear).means("of a strand about the rope's axis")
          .inert_if(is_shell, "the ejection is a shell", "set kind = \"rope\""),
      row("strands", &E::strands).within(1, 10000).means("of a rope"),
      row("strand_radius", &E::strand_radius).within(1e-4, 1).may_be_free(ParameterScale::logarithmic).means("relative to the rope's")
          .inert_if(is_shell, "the ejection is a shell", "set kind = \"rope\""),
      row("density", &E::density).within(0, 1e18).may_be_free(ParameterScale::logarithmic).means("at age 0; it falls as the volume grows"),
      row("rayleigh", &E::rayleigh).by_line().in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light of density 1 per unit of path and line"),
      responding(row("temperature_mk", &E::temperature_mk).in("MK").within(0, 100).may_be_free(ParameterScale::logarithmic).means("for lines that respond to it (docs/lines.md); 0: none")),
  };
  // clang-format on
}

void check_ejections(const Scene& scene) {
  for (const Ejection& ejection : scene.ejections) {
    const ElementCheck check(scene, "ejection." + ejection.name);
    check.check_shown();
    check.check_lines(ejection.rayleigh, false, "rayleigh");
  }
}

bool ejections_move(const Scene& scene) { return scene.sun.shown && !scene.ejections.empty(); }

}  // namespace

EmitterKind ejection_kind() {
  EmitterKind kind;
  kind.table = "ejection";
  kind.repeated = {repeated_table_of(kind.table, &Scene::ejections)};
  kind.rows = ejection_rows;
  kind.light = LightKind::sun;
  kind.check = check_ejections;
  kind.moves = ejections_move;
  return kind;
}

}  // namespace vegard::sim
