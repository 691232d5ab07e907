// A column-ratio inversion as text, as JSON and as a plot, and maps of one as files.
#pragma once

#include <string>

#include "fit/columns/column_inversion.h"
#include "fit/columns/column_maps.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// The assumptions of an inversion.
struct InversionFacts {
  std::string spectrum;              ///< "maxwellian"
  double soft_kev = 0.0;             ///< E0 of a soft component; 0: there is none
  std::string tables;                ///< "glow"
  double model_error = 0.0;          ///< relative error of the tables, included in the lines' errors
  std::string uncertainty = "none";  ///< "modes": the tables' modes are solved for; "none": they are exact
};

/// Returns a table of the lines, a table of each solution, chi2, the verdict and the degeneracies.
std::string inversion_text(const ColumnInversion& inversion, const InversionFacts& facts);

/// Returns JSON (RFC 8259) with a fixed order of keys; null for an open end of an interval or an unknown
/// value.
std::string inversion_json(const ColumnInversion& inversion, const InversionFacts& facts);

/// Returns a FITS file with one plane each for energy flux, E0, relative error of the flux, error of ln E0,
/// oxygen factor, error of its logarithm, the second energy, chi2, consistency, quality, and of a soft
/// component its ratio and the error of its logarithm. NaN where there is no answer.
std::string encode_column_maps(const ColumnMaps& maps, const InversionFacts& facts, const std::string& name);

/// Writes netCDF-4 by the CF conventions with the same quantities, completely or not at all.
void write_column_maps_netcdf(const ColumnMaps& maps, const InversionFacts& facts, const std::string& path,
                              const std::string& shown_name);

/// The number of pixels of each quality, one line each.
std::string column_maps_text(const ColumnMaps& maps);

/// Returns a plot with contours of chi2 at 2.30, 6.18 and 11.83 above the minimum (68.3, 95.4 and 99.7 % for
/// two parameters jointly; a free oxygen factor or soft component is at its best value), the curves on which
/// each single line has its measured brightness, and the solutions with their 68 % intervals. Energy and flux
/// must both be free.
Plot inversion_plot(const ColumnChi2& chi2, const ColumnInversion& inversion, const std::string& note);

}  // namespace vegard::fit
