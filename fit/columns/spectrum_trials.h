// Other spectra of the electrons, tried where one of them leaves the lines unexplained.
//
// Lines that a Maxwellian does not make may be those of a Gaussian, of a kappa distribution, or of a
// Maxwellian with a soft component, as they are seen side by side above one arc (Evans 1974,
// doi:10.1029/JA079i019p02853). A trial counts if chi2 falls by more than noise does once in a hundred times
// for one number more (6.63).
#pragma once

#include <string>
#include <vector>

#include "fit/columns/column_inversion.h"

namespace vegard::fit {

inline constexpr double kAskedFall = 6.63;

/// Whether chi2 and the degrees of freedom leave room for another spectrum.
bool asks_for_trials(double chi2, int degrees_of_freedom);

/// Inverts the lines with other spectra if their chi2 asks for it, and puts what they gave into `inversion`;
/// the verdict becomes ColumnVerdict::other_spectrum if one of them explains the lines better. `chi2` made
/// the inversion, of a model with `options`.
void try_spectra(const sim::EmissionTables& tables, const ColumnModelOptions& options, const ColumnChi2& chi2,
                 int threads, ColumnInversion& inversion);

}  // namespace vegard::fit
