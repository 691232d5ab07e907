// [[line]]: lines of the scene's own.
#include <algorithm>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

template <class Value>
Row<OwnLine> row(const char* key, Value OwnLine::*value) {
  return Row("line", key, &Scene::own_lines, value);
}

bool is_not_drawn(const OwnLine& line, const Scene& scene) {
  return line_index(scene.emission.lines, line.wavelength_nm) < 0;
}

bool nothing_makes_it_shine(const OwnLine& line, const Scene& scene) {
  const bool may_be_dark = std::all_of(scene.sheets.begin(), scene.sheets.end(), [](const Sheet& sheet) {
    return sheet.profile != ProfileKind::file && sheet.profile != ProfileKind::spline;
  });
  const bool shines_otherwise = scene.sun.shown || !scene.nebulae.empty() || !scene.volumes.empty() ||
                                !scene.loops.empty() || !scene.coronae.empty() || !scene.bundles.empty() ||
                                !scene.ejections.empty();
  return line.follows_nm <= 0.0 && line.rayleigh_per_mw_m2 <= 0.0 && may_be_dark && !shines_otherwise &&
         !(scene.sheets.empty() && scene.footprints.empty());
}

/// A row of the line's own layer.
Row<OwnLine> of_layer(Row<OwnLine> row) {
  return row.inert_if([](const OwnLine& line) { return line.rayleigh_per_mw_m2 <= 0.0; },
                      {"the line has no layer of its own, so {key} has no effect",
                       "a number that the light depends on", "set rayleigh_per_mw_m2"});
}

}  // namespace

std::vector<Declaration> own_line_rows() {
  using L = OwnLine;
  // clang-format off
  return {
      row("name", &L::name).means("by which paths call the line"),
      row("wavelength_nm", &L::wavelength_nm).in("nm").within(10, 30000)
          .means("its name in emission.lines, and its colour; replaces the program's line of the same wavelength")
          .inert_if(is_not_drawn, {"the line is not among emission.lines, so it is not drawn", "its wavelength there", ""})
          .inert_if(nothing_makes_it_shine, {"nothing makes the line shine", "follows_nm and ratio, rayleigh_per_mw_m2, or a column of it in a sheet's profile_file", ""}),
      row("lifetime_s", &L::lifetime_s).in("s").within(0, 1e6)
          .means("of the upper state, without collisions; below 0.001 the light is prompt"),
      row("follows_nm", &L::follows_nm).in("nm").within(0, 30000)
          .means("line of the emission tables to which ratio applies, with its quenching; 0: none"),
      row("ratio", &L::ratio).within(0, 1000).means("photons for each photon of the line that it follows")
          .inert_if([](const L& line) { return line.follows_nm <= 0.0; }, {"the line follows no other, so its ratio has no effect", "a number that the light depends on", "set follows_nm"}),
      row("rayleigh_per_mw_m2", &L::rayleigh_per_mw_m2).in("R per mW m⁻²").within(0, 1e9)
          .means("brightness of a layer of its own, from straight below; 0: none"),
      of_layer(row("peak_km", &L::peak_km)).in("km").within(80, 640).means("altitude at which that layer is brightest"),
      of_layer(row("scale_height_km", &L::scale_height_km)).in("km").within(0, 500).rule(layer_complaint)
          .means("scale height of that Chapman layer; 0: that of the air of [body]"),
  };
  // clang-format on
}

}  // namespace vegard::sim
