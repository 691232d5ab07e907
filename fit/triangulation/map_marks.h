// The files of maps: GeoJSON (RFC 7946) and KML (OGC 12-007r2) of places and lines.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fit/triangulation/earth_shape.h"

namespace vegard::fit {

/// Returns a number rounded to so many decimals.
double rounded_to(double value, int decimals);

/// Returns a number, or null for one that is not finite.
nlohmann::ordered_json number_or_null(double value);

/// Returns longitude and latitude to a micro-degree and the height in metres to a decimetre.
nlohmann::ordered_json geojson_coordinates(const GeodeticPlace& place);
std::string kml_coordinates(const GeodeticPlace& place);

/// Returns a line through places, without heights along the ground; of one place a point. Where it crosses
/// the date line it is cut, as RFC 7946 (3.1.9) asks.
nlohmann::ordered_json geojson_line(const std::vector<GeodeticPlace>& places, bool is_on_ground);

nlohmann::ordered_json geojson_feature(nlohmann::ordered_json geometry, nlohmann::ordered_json properties);

/// Returns a mark with a geometry. Markup in name and words is escaped.
std::string kml_mark(const std::string& name, const std::string& words, const std::string& geometry);

/// Returns a line through places, at their heights above the ellipsoid or along the ground.
std::string kml_line(const std::vector<GeodeticPlace>& places, bool is_on_ground);

/// Returns the whole file.
std::string geojson_text(const nlohmann::ordered_json& features);
std::string kml_text(const std::string& name, const std::string& marks);

}  // namespace vegard::fit
