// [[chromosphere]]: noise between two concentric spheres of the Sun.
#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/value_words.h"

namespace vegard::sim {
namespace {

/// Whether it neither shines nor absorbs, nor is fitted to.
bool is_unseen(const Chromosphere& c, const Scene& scene) {
  const std::string path = "chromosphere." + c.name + ".";
  return all_zero(c.rayleigh) && !frees(scene, path + "rayleigh") && c.extinction == 0.0 &&
         !frees(scene, path + "extinction");
}

/// A row whose number has no effect where nothing is seen, after what its own rule says.
Row<Chromosphere> seen(Row<Chromosphere> row) {
  return row.inert_if(is_unseen, "the chromosphere neither shines nor absorbs",
                      "give it rayleigh or extinction");
}

template <class Value>
Row<Chromosphere> row(const char* key, Value Chromosphere::*value) {
  return Row("chromosphere", key, &Scene::chromospheres, value);
}

std::vector<Declaration> chromosphere_rows() {
  using C = Chromosphere;
  // clang-format off
  return {
      seen(row("name", &C::name).means("name in paths")),
      seen(row("innerradius", &C::innerradius).called("inner radius").within(1e-3, 1e9).means("of the sphere below it, in sun.unit_km")),
      seen(row("outerradius", &C::outerradius).called("outer radius").within(1e-3, 1e9).means("of the sphere above it")),
      seen(row("roughness", &C::roughness).within(0, 1).may_be_free(ParameterScale::linear).means("amplitude of each octave over the last (ω)")
          .inert_if([](const C& c) { return c.octaves == 1; }, "the turbulence has one octave", "give it more octaves")),
      seen(row("octaves", &C::octaves).within(1, 12).means("octaves of its turbulence")),
      seen(row("scale", &C::scale).called("size of the granules").as(ParameterRole::granule_size).within(1e-3, 1e6).may_be_free(ParameterScale::logarithmic).means("largest waves: size of the granules")),
      seen(row("shift", &C::shift).as(ParameterRole::granule_shift).of({"x", "y", "z"}).within(-1e6, 1e6).may_be_free(ParameterScale::linear).means("of the turbulence, in lengths of its largest waves")),
      seen(row("coverage", &C::coverage).within(-1, 10).may_be_free(ParameterScale::linear).means("threshold of the cutoff F(x) = max(0, amplitude·(1−exp(−(x−coverage)·sharpness)))")
          .inert_if([](const C& c) { return !c.cutoff; }, "the chromosphere has no cutoff", "set cutoff = true")),
      seen(row("sharpness", &C::sharpness).within(0, 1000).may_be_free(ParameterScale::logarithmic).means("rate at which the cutoff approaches its amplitude")
          .inert_if([](const C& c) { return !c.cutoff; }, "the chromosphere has no cutoff", "set cutoff = true")),
      seen(row("amplitude", &C::amplitude).within(0, 1e6).may_be_free(ParameterScale::logarithmic).means("density that the cutoff approaches")
          .inert_if([](const C& c) { return !c.cutoff; }, "the chromosphere has no cutoff", "set cutoff = true")),
      seen(row("biasmap", &C::biasmap).names_file().means("equirectangular picture, north up")),
      seen(row("peak", &C::peak).within(-1e6, 1e6).may_be_free(ParameterScale::linear).means("added density where biasmap is white")
          .inert_if([](const C& c) { return c.biasmap.empty(); }, "the chromosphere has no map", "name a biasmap")),
      seen(row("cutoff", &C::cutoff).means("false: the density is the turbulence as it is")),
      row("rayleigh", &C::rayleigh).by_line().in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light of density 1 per unit of path and line"),
      row("extinction", &C::extinction).within(0, 1e6).may_be_free(ParameterScale::linear).means("of density 1 per unit of path"),
      seen(row("step", &C::step).within(1e-3, 1e6).means("step of the march")),
  };
  // clang-format on
}

void check_the_chromosphere(const Scene& scene, const Chromosphere& c) {
  const ElementCheck check(scene, "chromosphere." + c.name);
  check.check_shown();
  check.check_lines(c.rayleigh, true, "rayleigh");
  check.check_below(c.innerradius, "innerradius", c.outerradius, "outerradius");
  constexpr double kMaxSteps = 100000.0;
  const double steps = 2.0 * c.outerradius / c.step;
  if (steps > kMaxSteps)
    throw check.error_at({short_real_text(steps) + " steps from side to side",
                          "at most " + short_real_text(kMaxSteps), "a larger step"},
                         "step");
  if (c.peak != 0.0 && c.biasmap.empty())
    throw check.error_at({"there is no map for the peak", "biasmap = \"a picture's name\"", "or peak = 0"},
                         "peak");
}

std::vector<PictureOfScene> pictures_of_chromospheres(const Scene& scene) {
  std::vector<PictureOfScene> all;
  for (const Chromosphere& c : scene.chromospheres)
    if (!c.biasmap.empty()) all.push_back({"chromosphere." + c.name + ".biasmap", c.biasmap});
  return all;
}

}  // namespace

EmitterKind chromosphere_kind() {
  EmitterKind kind;
  kind.table = "chromosphere";
  kind.repeated = {repeated_table_of(kind.table, &Scene::chromospheres)};
  kind.rows = chromosphere_rows;
  kind.light = LightKind::sun;
  kind.check = check_each<&Scene::chromospheres, check_the_chromosphere>;
  kind.moves = turns_with_sun;
  kind.pictures = pictures_of_chromospheres;
  kind.place_in_preview = 3;
  return kind;
}

}  // namespace vegard::sim
