// [[corona]]: the corona at large.
#include <algorithm>

#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"

namespace vegard::sim {
namespace {

template <class Value>
Row<Corona> row(const char* key, Value Corona::*value) {
  return Row("corona", key, &Scene::coronae, value);
}

std::vector<Declaration> corona_rows() {
  using C = Corona;
  const auto has_no_share = [](const C& c, const Scene& scene, const ParameterPath& path) {
    const auto term = static_cast<std::size_t>(std::max(0, path.component));
    return term < c.share.size() && c.share[term] == 0.0 && !frees(scene, "corona." + c.name + ".share");
  };
  // clang-format off
  return {
      row("name", &C::name).means("name in paths"),
      row("density", &C::density).within(0, 1e18).may_be_free(ParameterScale::logarithmic).means("density·Σshare·(r/R)^-power"),
      row("share", &C::share).numbered().within(0, 1e6).may_be_free(ParameterScale::linear).means("of the falloff's terms"),
      row("power", &C::power).numbered().within(0, 100).may_be_free(ParameterScale::linear).means("of the falloff's terms")
          .inert_if(has_no_share, "its share is 0", "give it a share"),
      row("polar", &C::polar).within(0, 10).may_be_free(ParameterScale::linear).means("density over the poles over that over the equator (sin² of latitude between)"),
      row("reach", &C::reach).within(1.001, 1000).means("its end, in radii of the photosphere"),
      row("light", &C::light).one_of<CoronaLight>({{"density", CoronaLight::density}, {"square", CoronaLight::square}, {"scattered", CoronaLight::scattered}}).means("light as density, as its square (collisions), or scattered from the photosphere (Thomson)"),
      row("rayleigh", &C::rayleigh).by_line().in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light of density 1 per unit of path and line; scattered light: at the photosphere"),
      responding(row("temperature_mk", &C::temperature_mk).in("MK").within(0, 100).may_be_free(ParameterScale::logarithmic).means("for lines that respond to it (docs/lines.md); 0: none")),
  };
  // clang-format on
}

void check_the_corona(const Scene& scene, const Corona& c) {
  const ElementCheck check(scene, "corona." + c.name);
  check.check_shown();
  check.check_lines(c.rayleigh, false, "rayleigh");
  if (c.share.empty() || c.share.size() != c.power.size())
    throw check.error_at(
        {std::to_string(c.share.size()) + " of share for " + std::to_string(c.power.size()) + " of power",
         "as many of one as of the other, and at least one", ""},
        "share");
}

OnSun coronae_on_sun(const Scene& scene) {
  if (!scene.sun.shown || scene.coronae.empty()) return OnSun::nothing;
  const bool has_poles = std::any_of(scene.coronae.begin(), scene.coronae.end(), [&](const Corona& c) {
    return c.polar != 1.0 || frees(scene, "corona." + c.name + ".polar");
  });
  return has_poles ? OnSun::alike_about_axis : OnSun::alike_all_round;
}

}  // namespace

EmitterKind corona_kind() {
  EmitterKind kind;
  kind.table = "corona";
  kind.repeated = {repeated_table_of(kind.table, &Scene::coronae)};
  kind.rows = corona_rows;
  kind.light = LightKind::sun;
  kind.check = check_each<&Scene::coronae, check_the_corona>;
  kind.on_sun = coronae_on_sun;
  kind.place_in_preview = 4;
  return kind;
}

}  // namespace vegard::sim
