// Profiles of electron density as radars measure them, with errors, at one time or at several.
//
// Read from CSV (columns altitude_km; density_m3 or density_cm3; the same name with _error; time_s of several
// profiles; latitude_deg and longitude_deg of each place) and from Madrigal's HDF5 (the table "Data/Table
// Layout": gdalt in km; ne or nel, m^-3 or its log10; dne or dnel; ut1_unix and ut2_unix; beamid; gdlat and
// glon). A dnel of 4 or more is the log10 of the error in m^-3,
// which no radar has below 10^4; less is the error of the log10. Rows of Madrigal without a time or, where
// there are beams, without a beam are left out.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

/// Densities in cm^-3 and their standard deviations at the table's altitudes; NaN, both, where not measured.
struct DensityProfile {
  double time_s = 0.0;  ///< middle of the integration; NaN if the file has no times
  std::vector<double> density_cm3, sigma_cm3;
  std::vector<double> latitude_deg = {}, longitude_deg = {};  ///< NaN where the file does not tell

  int measured() const;  ///< altitudes
};

struct DensityTable {
  std::string file;
  std::vector<double> altitude_km;       ///< of all profiles, increasing
  std::vector<DensityProfile> profiles;  ///< in the order of their times, at least one

  bool has_times() const;
};

/// A profile of fewer does not determine a spectrum.
inline constexpr int kLeastAltitudes = 5;

/// Reads the profiles between two altitudes. `beam`: which of a Madrigal file's. Throws
/// Error(unreadable_input) for a file without densities in a known unit or without errors, an error that is
/// not above 0, densities above 1e14 m^-3 or errors below 1e-4 of them, two densities at one place, fewer
/// than kLeastAltitudes altitudes in each profile, and several beams none of which is chosen.
DensityTable read_density_table(const std::string& file, double least_km, double most_km,
                                std::optional<double> beam = {});

/// Reads the same of the text of a CSV file.
DensityTable density_table_of_csv(const std::string& text, const std::string& name, double least_km,
                                  double most_km);

}  // namespace vegard::fit
