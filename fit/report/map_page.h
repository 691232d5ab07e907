// A map of precipitation as one page that needs nothing else: report.html.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/curtains.h"
#include "fit/map/map_fit.h"
#include "fit/map/map_verdicts.h"

namespace vegard::fit {

/// What is reported of a run beside its result.
struct MapRunFacts {
  std::string command;
  std::vector<InputFile> inputs;
  std::vector<PhotoFact> from_photograph;
  std::vector<std::pair<std::string, std::string>> decodings;  ///< of each photograph: its name, and how
  std::vector<Curtain> faint;  ///< find_faint_curtains(): for a fit that may add them
  bool netcdf = false;         ///< precipitation.nc beside the FITS file (fit/report/netcdf)
};

/// The same result gives the same bytes.
std::string map_page(const MapResult& result, const std::vector<Curtain>& curtains,
                     const std::vector<QuantityVerdict>& verdicts, const MapRunFacts& facts);

}  // namespace vegard::fit
