// The verdicts on a map, one for each quantity.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/trust.h"
#include "fit/map/curtains.h"
#include "fit/map/map_fit.h"

namespace vegard::fit {

struct QuantityVerdict {
  std::string quantity;  ///< "distance of the lower border"
  Trust trust = Trust::unconstrained;
  std::string value;   ///< what was found, in words with errors
  std::string reason;  ///< why so
};

/// The picture, the distance, the energy and the energy flux of the curtains, and how much of the light has
/// its lower border in view. A map that explains the picture but constrains no distance says so.
std::vector<QuantityVerdict> map_verdicts(const MapResult& result, const std::vector<Curtain>& curtains);

/// The worst of those that are not good, in one line.
std::string verdict_line(const std::vector<QuantityVerdict>& verdicts);

/// Whether the sensor's scale is known, so that Q is absolute.
bool is_absolute(const MapResult& result);

}  // namespace vegard::fit
