// [[line]]: lines of the scene's own.
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value OwnLine::*value) {
  return Row("line", key, &Scene::own_lines, value);
}

}  // namespace

std::vector<Declaration> own_line_rows() {
  using L = OwnLine;
  // clang-format off
  return {
      row("name", &L::name).means("by which paths call the line"),
      row("wavelength_nm", &L::wavelength_nm).in("nm").within(10, 30000)
          .means("its name in emission.lines, and its colour; replaces the program's line of the same wavelength"),
      row("lifetime_s", &L::lifetime_s).in("s").within(0, 1e6)
          .means("of the upper state, without collisions; below 0.001 the light is prompt"),
      row("follows_nm", &L::follows_nm).in("nm").within(0, 30000)
          .means("line of the emission tables to which ratio applies, with its quenching; 0: none"),
      row("ratio", &L::ratio).within(0, 1000).means("photons for each photon of the line that it follows"),
      row("rayleigh_per_mw_m2", &L::rayleigh_per_mw_m2).in("R per mW m⁻²").within(0, 1e9)
          .means("brightness of a layer of its own, from straight below; 0: none"),
      row("peak_km", &L::peak_km).in("km").within(80, 640).means("altitude at which that layer is brightest"),
      row("scale_height_km", &L::scale_height_km).in("km").within(0, 500).rule(layer_complaint)
          .means("scale height of that Chapman layer; 0: that of the air of [body]"),
  };
  // clang-format on
}

}  // namespace vegard::sim
