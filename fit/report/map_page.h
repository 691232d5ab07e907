// The report of a map of precipitation as one self-contained page: report.html.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/curtains.h"
#include "fit/map/map_fit.h"
#include "fit/map/map_verdicts.h"

namespace vegard::fit {

/// Facts about a run that are reported in addition to its result.
struct MapRunFacts {
  std::string command;
  std::vector<InputFile> inputs;
  std::vector<PhotoFact> from_photograph;
  std::vector<std::pair<std::string, std::string>> decodings;  ///< photographs' names and decodings
  std::vector<Curtain> faint;  ///< find_faint_curtains(): for a fit that may add them
  bool netcdf = false;  ///< whether precipitation.nc is written beside the FITS file (fit/report/netcdf)
};

/// Returns the page. The same result gives the same bytes.
std::string map_page(const MapResult& result, const std::vector<Curtain>& curtains,
                     const std::vector<QuantityVerdict>& verdicts, const MapRunFacts& facts);

}  // namespace vegard::fit
