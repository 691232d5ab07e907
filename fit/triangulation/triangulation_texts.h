// A triangulation as text: tables, JSON, and the files of maps, GeoJSON (RFC 7946) and KML (OGC 12-007r2).
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "fit/triangulation/triangulation.h"

namespace vegard::fit {

/// A line for each point, for each curve with the heights of its possible matches, and for what is refused.
std::string triangulation_table(const Triangulation& all);

/// A row for each row of the triangulation; units are in the columns' names, unknown numbers are NaN.
std::string triangulation_csv(const Triangulation& all);

nlohmann::ordered_json triangulation_json(const Triangulation& all);

/// Places with heights above the ellipsoid in metres, curves by their most probable match, the cameras, and
/// the ground below each point's lines of sight.
std::string triangulation_geojson(const Triangulation& all);
std::string triangulation_kml(const Triangulation& all);

}  // namespace vegard::fit
