// The directory of traced borders: border.csv, border.json, border.svg, and one self-contained page,
// report.html.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/border/border.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// What is reported of a traced border beside it.
struct BorderRunFacts {
  std::string command;
  std::vector<InputFile> inputs;
  std::string decoding;
};

/// Over azimuths that may pass through north: 350 to 10°, as the first and the last point have it.
struct BorderSummary {
  double from_azimuth_deg = 0.0, to_azimuth_deg = 0.0;  ///< of the points given
  double lowest_deg = 0.0, highest_deg = 0.0;           ///< elevations of the border
  /// The point nearest to the observer: the highest one.
  double nearest_azimuth_deg = 0.0, nearest_error_deg = 0.0;
  /// km, of the nearest point, for each of kBorderAltitudesKm, and the error at each by the elevation's.
  std::array<double, 4> distance_km{}, distance_error_km{};
};

/// All NaN without a point that is given.
BorderSummary border_summary(const BorderTrace& trace, const sim::Scene& scene);

/// "Trace 1: azimuths 130 to 265°, elevations 9.1 to 17.2°; nearest 251 km away at azimuth 188°, if it is 105
/// km high (219 to 267 km for 95 to 110 km)". Why not, of one that is not given.
std::string border_sentence(const Border& border, std::size_t trace, const sim::Scene& scene);

/// The answer in one sentence: where the nearest point of the most probable border is, or that none is
/// claimed.
std::string border_answer(const Border& border, const sim::Scene& scene);

/// The photograph with the traces, elevation against azimuth, and the map for the four altitudes.
std::string border_svg(const Border& border, const Photo& photo, const sim::Scene& scene);

/// The same border gives the same bytes.
std::string border_page(const Border& border, const Photo& photo, const sim::Scene& scene,
                        const BorderRunFacts& facts);

/// Returns a table with a row for each point, with distances and places for each of kBorderAltitudesKm.
/// Unknown values are empty cells; so are places if the scene does not give the site's position.
std::string border_csv(const Border& border, const sim::Scene& scene);

std::string border_json(const Border& border, const sim::Scene& scene, const BorderRunFacts& facts);

/// Throws as write_border_run() would, without writing; to be called before the work.
void check_border_directory(const std::string& directory, bool overwrite);

/// Writes the directory, completely or not at all. Throws sim::Error(existing_output, unwritable_output).
void write_border_run(const std::string& directory, bool overwrite, const Border& border, const Photo& photo,
                      const sim::Scene& scene, const BorderRunFacts& facts);

}  // namespace vegard::fit
