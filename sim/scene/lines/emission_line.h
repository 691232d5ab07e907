// An emission line: what is known of it; and the lines of the aurora. The one list of all lines, of nebulae
// and the Sun too, is emission_lines() (sim/scene/lines/emission_lines.h): a scene may name these, and their
// light and colour follow from the row.
//
// Most lines have a column of their own in the emission tables (sim/light/tables/emission_tables.h). Where
// tables have none, a line comes from the same upper state as one that has, or goes with it by a ratio from
// the literature: its light is that column's times `ratio`. Those of nebulae
// (sim/scene/lines/nebular_lines.h) have no column: electrons in the air leave them dark. docs/lines.md
// prints the list.
#pragma once

#include <vector>

namespace vegard::sim {

/// The green line of oxygen, which brightness is told by.
inline constexpr double kGreenNm = 557.7;

/// A wavelength at which a line, or a set of bands under one name, shines, and its share of the photons.
struct LineComponent {
  double wavelength_nm;
  double share;
};

struct EmissionLine {
  double wavelength_nm = 0.0;  ///< its name; of a set of bands that of one of them
  const char* species = "";
  const char* transition = "";
  double lifetime_s = 0.0;                ///< of the upper state, without collisions
  const char* table_column = "";          ///< of emission tables without its own; empty: not of the aurora
  double ratio = 0.0;                     ///< of its photons to that column's
  const char* ratio_source = "";          ///< empty for a line with a column of its own; else with the spread
  const char* blended_with = "";          ///< what stands so near that a colour filter of some nm has both
  std::vector<LineComponent> components;  ///< shares add up to 1; the wavelength alone for a single line
  const char* components_source = "";     ///< where the shares come from; empty for a single line
  bool is_own = false;                    ///< of the scene's own (sim/scene/lines/scene_lines.h)
};

/// Whether it is emitted by what electrons strike in the air. The others are of nebulae and the Sun; in an
/// aurora only a profile of the user's own makes them shine.
bool is_auroral(const EmissionLine& line);

/// Those of the aurora: the lines and bands of oxygen and nitrogen.
std::vector<EmissionLine> auroral_lines();

}  // namespace vegard::sim
