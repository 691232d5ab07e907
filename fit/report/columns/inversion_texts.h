// A column-ratio inversion in words and for machines.
#pragma once

#include <string>

#include "fit/columns/column_inversion.h"

namespace vegard::fit {

/// What an answer rests on.
struct InversionFacts {
  std::string spectrum;      ///< "maxwellian"
  std::string tables;        ///< "glow"
  double model_error = 0.0;  ///< of the tables, a share of each brightness, which is in the lines' errors
};

/// A table of the lines, one of each solution, chi2, the verdict and what trades off.
std::string inversion_text(const ColumnInversion& inversion, const InversionFacts& facts);

/// JSON (RFC 8259) with a fixed order of keys; null for what is open or not known.
std::string inversion_json(const ColumnInversion& inversion, const InversionFacts& facts);

}  // namespace vegard::fit
