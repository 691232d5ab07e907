// How the light of electrons may differ from the emission tables: the modes of its uncertainty.
//
// The numbers of physics, each within its uncertainty, change the light of all lines, energies and altitudes
// together. Of a large number of draws the changes of the logarithm of the light are nearly spanned by a few
// modes (principal components; Jolliffe 2002, "Principal Component Analysis"), scaled such that their
// coefficients a_k are independent with mean 0 and standard deviation 1:
//
//     ln v(line, h; E0) = ln v_table(line, h; E0) + sum over k of a_k m_k(line, h; E0).
//
// The file is modes.csv of a folder of tables (docs/file_formats.md, "Emission tables"), which `vegard tables
// --ensemble` writes. The modes are those of Maxwellian electrons; electrons of one energy E have those of E0
// = E/2, whose mean energy is E.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/base/file/csv_table.h"

namespace vegard::sim {

/// Largest number of modes.
inline constexpr int kMaxLightModes = 16;

/// A mode at an altitude, and its derivative by the logarithm of E0.
struct ModeValue {
  double value = 0.0;
  double slope = 0.0;
};

class LightModes {
 public:
  /// No modes: the tables are exact.
  LightModes() = default;

  /// Reads a table with the columns mode (1, 2 ...), E0_keV, altitude_km; all other columns are lines. Rows
  /// are ordered by mode, energy, altitude, with the same energies and altitudes throughout. Throws
  /// Error(unreadable_input) with the row unless all rows are present in this order, modes are at most
  /// kMaxLightModes, and no value is beyond +-20.
  explicit LightModes(const CsvTable& table);

  int count() const { return count_; }

  /// Returns a mode, from 0, of a column ("ver_5577") at each of the altitudes: linear between the table's
  /// altitudes and, in the logarithm, between its energies; constant beyond. 0 for a column without modes.
  std::vector<ModeValue> at(int mode, const std::string& column, double energy_kev,
                            const std::vector<double>& altitudes_km) const;

 private:
  int count_ = 0;
  std::vector<double> log_energies_, altitudes_km_;
  std::map<std::string, std::vector<double>>
      values_;  ///< [(mode * energies + energy) * altitudes + altitude]
};

}  // namespace vegard::sim
