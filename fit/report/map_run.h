// The directory of a map of precipitation: map.json, precipitation.fits, curtains.csv, faint_curtains.csv,
// model.exr, residual.exr, report.html (one self-contained page), and precipitation.nc, curtains.geojson and
// curtains.kml if requested. With several photographs: model-NAME.exr and residual-NAME.exr for each.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/curtains/curtains.h"
#include "fit/map/curtains/map_verdicts.h"
#include "fit/map/map_result.h"

namespace vegard::fit {

/// Facts about a run that are reported in addition to its result.
struct MapRunFacts {
  std::string command;
  std::vector<InputFile> inputs;
  std::vector<PhotoFact> from_photograph;
  std::vector<std::pair<std::string, std::string>> decodings;  ///< photographs' names and decodings
  std::vector<Curtain> faint;  ///< find_faint_curtains(): for a fit that may add them
  bool netcdf = false;  ///< whether precipitation.nc is written beside the FITS file (fit/report/netcdf)
  bool geojson = false, kml = false;  ///< whether curtains.geojson and curtains.kml are (curtain_places.h)
  bool magnetic_grid = false;         ///< whether the page's maps have one (ground_lattice.h)
};

/// Returns the page. The same result gives the same bytes.
std::string map_page(const MapResult& result, const std::vector<Curtain>& curtains,
                     const std::vector<QuantityVerdict>& verdicts, const MapRunFacts& facts);

/// Throws as write_map_run() would, without writing; to be called before the long work.
void check_map_directory(const std::string& directory, bool overwrite);

/// Whether the directory holds a map that was interrupted, which --resume may replace.
bool is_interrupted_map(const std::string& directory);

/// Writes the directory, completely or not at all; the same map gives the same bytes. Throws
/// sim::Error(existing_output), sim::Error(unwritable_output).
///
/// precipitation.fits: 32-bit floats on linear axes EAST and NORTH, km in the site's tangent plane, for feet
/// at 110 km altitude, in five planes: energy flux in mW m^-2, E0 in keV, relative standard error of the
/// flux, standard error of ln(E0), sensitivity. NaN where no picture constrains a value, because light at the
/// lower border would be out of view; the energy is also NaN where there is no flux.
void write_map_run(const std::string& directory, bool overwrite, const MapResult& result,
                   const std::vector<Curtain>& curtains, const MapRunFacts& facts);

/// The text of map.json.
std::string map_json(const MapResult& result, const std::vector<Curtain>& curtains,
                     const std::vector<QuantityVerdict>& verdicts, const MapRunFacts& facts);

/// The text of curtains.csv, and of faint_curtains.csv.
std::string curtains_csv(const std::vector<Curtain>& curtains);

}  // namespace vegard::fit
