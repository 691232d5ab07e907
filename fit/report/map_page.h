// A map of precipitation as one page that needs nothing else: report.html.
#pragma once

#include <string>
#include <vector>

#include "fit/map/curtains.h"
#include "fit/map/map_fit.h"
#include "fit/map/map_verdicts.h"
#include "fit/report/map_run.h"

namespace vegard::fit {

/// The same result gives the same bytes.
std::string map_page(const MapResult& result, const std::vector<Curtain>& curtains,
                     const std::vector<QuantityVerdict>& verdicts, const MapRunFacts& facts);

}  // namespace vegard::fit
