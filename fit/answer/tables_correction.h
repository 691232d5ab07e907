// What a picture says of the emission tables: by how much the light of each line would have to change. The
// answer and its error bars do without it (fit/uncertainty/physics_uncertainty.h).
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/uncertainty/physics_uncertainty.h"

namespace vegard::fit {

/// Returns how the columns of the scene's lines over that of a reference line follow the modes, for the
/// electrons in the first sheet whose light comes from the tables; a gain or an energy flux that is too high
/// cannot be told from too little light of all lines. The reference is 557.7 nm if the scene has it, else the
/// line with the largest column.
std::vector<LineByModes> lines_by_modes(const sim::Scene& best, const std::vector<int>& modes);

/// Returns the corrections of these ratios. To first order, ln(factor) is the sum of the learnt coefficients
/// times what their modes make of the ratio's logarithm. Left out are lines of which the data say too little:
/// those whose correction is within two standard deviations and whose error is above half of the tables'.
std::vector<TablesCorrection> tables_corrections(const std::vector<LineByModes>& lines,
                                                 const LearntModes& learnt);

/// Returns "630.0 nm over 557.7 nm: these data ask for 0.83 ± 0.06 of the tables' light, which is known to 30
/// %", for `what` of the first words.
std::string correction_words(const std::string& what, double factor, double ln_sigma,
                             double ln_sigma_of_tables);
std::string correction_words(const TablesCorrection& correction);

}  // namespace vegard::fit
