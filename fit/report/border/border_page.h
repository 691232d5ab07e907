// Traced borders as pictures, and as one page that needs nothing else: report.html.
#pragma once

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

/// The answer in one sentence: where the nearest point of the measured borders is, or that there is none.
std::string border_answer(const Border& border, const sim::Scene& scene);

/// The photograph with the traces, elevation against azimuth, and the map for the four altitudes.
std::string border_svg(const Border& border, const Photo& photo, const sim::Scene& scene);

/// The same border gives the same bytes.
std::string border_page(const Border& border, const Photo& photo, const sim::Scene& scene,
                        const BorderRunFacts& facts);

}  // namespace vegard::fit
