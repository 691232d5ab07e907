// The emission lines of the aurora: what is known of each, one row a line.
#pragma once

#include <vector>

namespace vegard::sim {

struct EmissionLine {
  double wavelength_nm;
  const char* species;
  const char* transition;
  double lifetime_s;         ///< of the upper state, without collisions
  const char* table_column;  ///< in data/glow/ver_maxwellian.csv
};

/// Every line that the emission tables hold, by increasing wavelength. Lifetimes: 630.0 nm 110 s, 557.7 nm
/// 0.7 s and 427.8 nm below 1 ms as in Baranoski et al. 2000, section 2.1; the N2 bands and the allowed lines
/// of O are prompt (below 1 microsecond); 520.0 nm, N(2D), 26 hours.
const std::vector<EmissionLine>& emission_lines();

/// The line within 0.05 nm of this wavelength, or nullptr.
const EmissionLine* find_emission_line(double wavelength_nm);

}  // namespace vegard::sim
