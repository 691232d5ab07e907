// The verdicts on a map, one for each quantity.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/answer/trust.h"
#include "fit/map/curtains/curtains.h"
#include "fit/map/map_result.h"

namespace vegard::fit {

struct QuantityVerdict {
  std::string quantity;  ///< "distance of the lower border"
  Trust trust = Trust::unconstrained;
  std::string value;   ///< the result in words, with errors
  std::string reason;  ///< the reason for `trust`
};

/// Returns verdicts on the picture, on how much of the light has its lower border in view, and on the
/// distance, the energy, the energy flux and the height of the brightest curtain. Light in the farthest
/// cells, and energies at either end of the map's, constrain nothing. If a map explains the picture but
/// constrains no distance, this is said.
std::vector<QuantityVerdict> map_verdicts(const MapResult& result, const std::vector<Curtain>& curtains);

/// Returns what the pictures ask of the emission tables' light, at the energy of the brightest curtain whose
/// lower border is in view (fit/answer/tables_correction.h): none where the tables are taken as exact,
/// without such a curtain, or without error bars.
std::vector<TablesCorrection> map_corrections(const MapResult& result, const std::vector<Curtain>& curtains);

/// Returns the worst of the verdicts that are not good, in one line.
std::string verdict_line(const std::vector<QuantityVerdict>& verdicts);

/// Whether the sensor's scale is known, so that Q is absolute.
bool is_absolute(const MapResult& result);

}  // namespace vegard::fit
