// A column-ratio inversion as text and as JSON.
#pragma once

#include <string>

#include "fit/columns/column_inversion.h"

namespace vegard::fit {

/// The assumptions of an inversion.
struct InversionFacts {
  std::string spectrum;      ///< "maxwellian"
  std::string tables;        ///< "glow"
  double model_error = 0.0;  ///< relative error of the tables, included in the lines' errors
};

/// Returns a table of the lines, a table of each solution, chi2, the verdict and the degeneracies.
std::string inversion_text(const ColumnInversion& inversion, const InversionFacts& facts);

/// Returns JSON (RFC 8259) with a fixed order of keys; null for an open end of an interval or an unknown
/// value.
std::string inversion_json(const ColumnInversion& inversion, const InversionFacts& facts);

}  // namespace vegard::fit
