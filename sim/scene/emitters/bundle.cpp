// [[bundle]]: straight lines that stand on the Sun.
#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/value_words.h"

namespace vegard::sim {
namespace {

template <class Value>
Row<Bundle> row(const char* key, Value Bundle::*value) {
  return Row("bundle", key, &Scene::bundles, value);
}

std::vector<Declaration> bundle_rows() {
  using B = Bundle;
  // clang-format off
  return {
      row("name", &B::name).means("name in paths"),
      row("count", &B::count).within(1, 100000).means("how many"),
      row("length", &B::length).within(1e-6, 1e9).may_be_free(ParameterScale::logarithmic).means("of a line, in sun.unit_km"),
      row("gradient_deg", &B::gradient_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("angle of a line from the vertical towards the equator, at its foot"),
      row("slope_noise_deg", &B::slope_noise_deg).in("deg").within(0, 90).may_be_free(ParameterScale::linear).means("standard deviation of a line's slope, in either direction"),
      row("position_noise_deg", &B::position_noise_deg).in("deg").within(0, 90).may_be_free(ParameterScale::linear).means("standard deviation of a foot's place about an even spread"),
      row("density_noise", &B::density_noise).within(0, 5).may_be_free(ParameterScale::linear).means("standard deviation of ln(density) of lines"),
      row("density", &B::density).within(0, 1e18).may_be_free(ParameterScale::logarithmic).means("density in the middle of a line at its foot"),
      row("falloff_length", &B::falloff_length).within(1e-6, 1e9).may_be_free(ParameterScale::logarithmic).means("along a line, to a density of 1/e"),
      row("foot_fade", &B::foot_fade).within(0, 1e9).means("length in which a line brightens from its foot"),
      row("foot_radius", &B::foot_radius).within(1e-9, 1e9).may_be_free(ParameterScale::logarithmic).means("of a line at its foot"),
      row("top_radius", &B::top_radius).within(1e-9, 1e9).may_be_free(ParameterScale::logarithmic).means("the same at its end"),
      row("density_falloff", &B::density_falloff).one_of<RadialFalloff>({{"smooth", RadialFalloff::smooth}, {"linear", RadialFalloff::linear}, {"gaussian", RadialFalloff::gaussian}}).means("density across a line, as of a loop's strand"),
      row("filaments", &B::filaments).within(0, 10000).means("places that feet gather at"),
      row("filament_pull", &B::filament_pull).within(0, 1).may_be_free(ParameterScale::linear).means("0 none, 1 complete")
          .inert_if([](const B& b) { return b.filaments == 0; }, "the bundle has no filaments", "give it filaments"),
      row("lowest_latitude_deg", &B::lowest_latitude_deg).in("deg").within(-90, 90).means("of feet"),
      row("highest_latitude_deg", &B::highest_latitude_deg).in("deg").within(-90, 90).means("of feet"),
      row("horizon_deg", &B::horizon_deg).in("deg").within(0.1, 90).means("of feet from the limb, at most; 90: anywhere"),
      row("rayleigh", &B::rayleigh).by_line().in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light of density 1 per unit of path and line"),
      responding(row("temperature_mk", &B::temperature_mk).in("MK").within(0, 100).may_be_free(ParameterScale::logarithmic).means("for lines that respond to it (docs/lines.md); 0: none")),
  };
  // clang-format on
}

void check_the_bundle(const Scene& scene, const Bundle& b) {
  const ElementCheck check(scene, "bundle." + b.name);
  check.check_shown();
  check.check_lines(b.rayleigh, false, "rayleigh");
  check.check_below(b.lowest_latitude_deg, "lowest_latitude_deg", b.highest_latitude_deg,
                    "highest_latitude_deg");
  // Places of a latitude are from |latitude - B0| to 180° - |latitude + B0| off the middle of the disc.
  const double b0 = scene.sun.latitude_deg;
  const auto within = [&](double latitude) {
    return std::clamp(latitude, b.lowest_latitude_deg, b.highest_latitude_deg);
  };
  const double least = std::abs(within(b0) - b0), most = 180.0 - std::abs(within(-b0) + b0);
  const double limb = std::acos(std::min(1.0, scene.sun.radius * scene.sun.unit_km / scene.sun.distance_km)) /
                      kRadiansPerDegree;
  if (limb + b.horizon_deg < least || limb - b.horizon_deg > most)
    throw check.error_at({"no place between these latitudes is within " + short_real_text(b.horizon_deg) +
                              " degrees of the limb",
                          "a larger horizon_deg, or other latitudes", ""},
                         "horizon_deg");
}

}  // namespace

EmitterKind bundle_kind() {
  EmitterKind kind;
  kind.table = "bundle";
  kind.repeated = {repeated_table_of(kind.table, &Scene::bundles)};
  kind.rows = bundle_rows;
  kind.light = LightKind::sun;
  kind.check = check_each<&Scene::bundles, check_the_bundle>;
  kind.moves = turns_with_sun;
  kind.place_in_preview = 5;
  return kind;
}

}  // namespace vegard::sim
