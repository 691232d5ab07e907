// [[loop]]: macro-loops of strands.
#include <algorithm>
#include <cmath>

#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/value_words.h"

namespace vegard::sim {
namespace {

template <class Value>
Row<Loop> row(const char* key, Value Loop::*value) {
  return Row("loop", key, &Scene::loops, value)
      .none_free_if([](const Loop& l) { return l.voxel != 0.0; },
                    {"the loop is drawn by a grid, whose derivative by {key} is not known",
                     "a number of a loop that is drawn strand by strand",
                     "set its voxel = 0, or leave it out of fit.free"});
}

std::vector<Declaration> loop_rows() {
  using L = Loop;
  const auto is_even = [](const L& l, const Scene& scene) {
    return l.brightening == 0.0 && !frees(scene, "loop." + l.name + ".brightening");
  };
  // clang-format off
  return {
      row("name", &L::name).means("name in paths"),
      row("latitude_deg", &L::latitude_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("heliographic, of the middle between its feet"),
      row("longitude_deg", &L::longitude_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("the same, growing to the west"),
      row("bearing_deg", &L::bearing_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("of the second foot, from solar north to the west"),
      row("height", &L::height).within(0, 1e9).may_be_free(ParameterScale::logarithmic).means("of its top over the middle between the feet, in sun.unit_km"),
      row("width", &L::width).within(1e-6, 1e9).may_be_free(ParameterScale::logarithmic).means("from foot to foot"),
      row("sharpness", &L::sharpness).within(-2, 1).may_be_free(ParameterScale::linear).means("0: round; 1: pointed; below 0: leaning outwards"),
      row("skew", &L::skew).within(-1e9, 1e9).may_be_free(ParameterScale::linear).means("shift of the two control points across the loop's plane, to opposite sides"),
      row("tilt_deg", &L::tilt_deg).in("deg").within(-180, 180).may_be_free(ParameterScale::linear).means("of its plane from the vertical, to the right of the bearing"),
      row("tilt_per_distance_deg", &L::tilt_per_distance_deg).in("deg").within(-1e6, 1e6).may_be_free(ParameterScale::linear).means("additional tilt of a strand by its distance from the loop's middle")
          .inert_if([](const L& l) { return l.strands == 1; }, "the loop is a single strand", "give it more strands"),
      row("strands", &L::strands).within(1, 100000).means("how many"),
      row("spread", &L::spread).within(0, 1e9).may_be_free(ParameterScale::linear).means("largest distance of strands from its middle plane")
          .inert_if([](const L& l) { return l.strands == 1; }, "the loop is a single strand", "give it more strands"),
      row("strand_radius", &L::strand_radius).within(1e-9, 1e9).may_be_free(ParameterScale::logarithmic).means("radius of a strand"),
      row("density_falloff", &L::density_falloff).one_of<RadialFalloff>({{"smooth", RadialFalloff::smooth}, {"linear", RadialFalloff::linear}, {"gaussian", RadialFalloff::gaussian}}).means("density across a strand, q = distance/strand_radius < 1: (1−q²)², 1−q, exp(−4.5q²)"),
      row("height_falloff", &L::height_falloff).one_of<HeightFalloff>({{"none", HeightFalloff::none}, {"grow", HeightFalloff::grow}, {"fade", HeightFalloff::fade}, {"logarithmic", HeightFalloff::logarithmic}, {"inverse-square", HeightFalloff::inverse_square}}).means("density against height: linear (growing or fading), logarithmic, or inverse square"),
      row("falloff_least", &L::falloff_least).within(0, 1).may_be_free(ParameterScale::linear).means("smallest over largest density of the height falloff")
          .inert_if([](const L& l) { return l.height_falloff == HeightFalloff::none; }, "the loop's light does not fall off along it", "name a height_falloff"),
      row("foot_fade", &L::foot_fade).within(0, 1).means("share of the height in which strands brighten from their feet"),
      row("base_density", &L::base_density).within(0, 1e9).may_be_free(ParameterScale::logarithmic).means("density in the middle of a strand without falloff"),
      row("root_noise", &L::root_noise).within(0, 1e9).may_be_free(ParameterScale::linear).means("standard deviation of the feet's places"),
      row("height_noise", &L::height_noise).within(0, 1).may_be_free(ParameterScale::linear).means("relative standard deviation of the height"),
      row("tilt_noise_deg", &L::tilt_noise_deg).in("deg").within(0, 90).may_be_free(ParameterScale::linear).means("standard deviation of the tilt"),
      row("density_noise", &L::density_noise).within(0, 5).may_be_free(ParameterScale::linear).means("standard deviation of ln(density) of strands"),
      row("filaments", &L::filaments).within(0, 10000).means("bunches that strands gather in near the top"),
      row("filament_pull", &L::filament_pull).within(0, 1).may_be_free(ParameterScale::linear).means("gathering into them: 0 none, 1 complete")
          .inert_if([](const L& l) { return l.filaments == 0; }, "the loop has no filaments", "give it filaments")
          .inert_if([](const L& l) { return l.filaments >= l.strands; }, "every strand is a filament of its own", "give it fewer filaments"),
      row("brightening", &L::brightening).within(0, 1e6).may_be_free(ParameterScale::linear).means("added density at its height, in base_density"),
      row("brightening_at", &L::brightening_at).within(0, 1).may_be_free(ParameterScale::linear).means("its height: 0 at the feet, 1 at the top")
          .inert_if(is_even, "the loop is nowhere brightened", "give it a brightening"),
      row("brightening_width", &L::brightening_width).within(1e-3, 10).may_be_free(ParameterScale::logarithmic).means("its standard deviation, relative to the strand's height")
          .inert_if(is_even, "the loop is nowhere brightened", "give it a brightening"),
      row("rayleigh", &L::rayleigh).by_line().in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light of density 1 per unit of path and line"),
      responding(row("temperature_mk", &L::temperature_mk).in("MK").within(0, 100).may_be_free(ParameterScale::logarithmic).means("for lines that respond to it (docs/lines.md); 0: none")
          .inert_if([](const L& l) { return l.heating_interval_s > 0.0; }, "flares heat the loop, which cools from its heating_temperature_mk", "leave it out, or set heating_interval_s = 0")),
      row("heating_interval_s", &L::heating_interval_s).in("s").within(0, 1e8).means("mean time between a strand's random flares (docs/corona/time.md); 0: none"),
      row("heating_temperature_mk", &L::heating_temperature_mk).in("MK").within(1, 100).means("to which a flare heats a strand, which then cools")
          .inert_if([](const L& l) { return l.heating_interval_s == 0.0; }, "no flares heat the loop", "give it a heating_interval_s"),
      row("heating_density_cm3", &L::heating_density_cm3).in("cm⁻³").within(1e7, 1e12).means("electrons of a strand when a flare heats it")
          .inert_if([](const L& l) { return l.heating_interval_s == 0.0; }, "no flares heat the loop", "give it a heating_interval_s"),
      row("voxel", &L::voxel).within(0, 1e9).means("edge of a voxel; 0: drawn strand by strand"),
      row("blur", &L::blur).within(0, 20).means("blurs of that grid"),
      row("sharpen", &L::sharpen).within(0, 20).means("sharpenings after that"),
  };
  // clang-format on
}

void check_the_loop(const Scene& scene, const Loop& l) {
  const ElementCheck check(scene, "loop." + l.name);
  check.check_shown();
  check.check_lines(l.rayleigh, false, "rayleigh");
  const double reach = std::hypot(0.5 * l.width, l.spread);
  if (scene.sun.shown && reach >= scene.sun.radius)
    throw check.error_at(
        {"its feet would stand " + short_real_text(reach) +
             " from the middle between them, beside a Sun of radius " + short_real_text(scene.sun.radius),
         "half the width and the spread together below the Sun's radius", ""},
        "width");
  if (l.voxel > l.strand_radius)
    throw check.error_at({"strands of radius " + short_real_text(l.strand_radius) +
                              " would fall between voxels of " + short_real_text(l.voxel),
                          "at most strand_radius", "half of it shows the falloff"},
                         "voxel");
  constexpr double kMinInterval_s = 1.0;
  if (l.heating_interval_s > 0.0 && l.heating_interval_s < kMinInterval_s)
    throw check.error_at(
        {"too many flares to count", "at least a second between them", "0 for a loop that shines steadily"},
        "heating_interval_s");
  if (l.heating_interval_s > 0.0 && l.voxel > 0.0)
    throw check.error_at({"flares heat strand by strand, and the loop is drawn by a grid", "voxel = 0",
                          "or heating_interval_s = 0"},
                         "heating_interval_s");
  if (l.voxel == 0.0 && (l.blur > 0 || l.sharpen > 0))
    throw check.error_at({"there is no grid to filter", "voxel above 0", "or blur = 0 and sharpen = 0"},
                         l.blur > 0 ? "blur" : "sharpen");
}

bool loops_move(const Scene& scene) {
  return turns_with_sun(scene) || std::any_of(scene.loops.begin(), scene.loops.end(),
                                              [](const Loop& loop) { return loop.heating_interval_s > 0.0; });
}

}  // namespace

EmitterKind loop_kind() {
  EmitterKind kind;
  kind.table = "loop";
  kind.repeated = {repeated_table_of(kind.table, &Scene::loops)};
  kind.rows = loop_rows;
  kind.light = LightKind::sun;
  kind.check = check_each<&Scene::loops, check_the_loop>;
  kind.moves = loops_move;
  kind.place_in_preview = 2;
  return kind;
}

}  // namespace vegard::sim
