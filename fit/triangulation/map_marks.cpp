#include "fit/triangulation/map_marks.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace vegard::fit {
namespace {

using MapJson = nlohmann::ordered_json;

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      out += c;
  }
  return out;
}

}  // namespace

double rounded_to(double value, int decimals) {
  const double power = std::pow(10.0, decimals);
  return std::round(value * power) / power;
}

MapJson number_or_null(double value) { return std::isfinite(value) ? MapJson(value) : MapJson(nullptr); }

MapJson geojson_coordinates(const GeodeticPlace& place) {
  return {rounded_to(place.longitude_deg, 6), rounded_to(place.latitude_deg, 6),
          rounded_to(1e3 * place.height_km, 1)};
}

MapJson geojson_line(const std::vector<GeodeticPlace>& places, bool is_on_ground) {
  const auto coordinates = [&](const GeodeticPlace& place) {
    MapJson at = geojson_coordinates(place);
    if (is_on_ground) at.erase(2);
    return at;
  };
  if (places.size() == 1) return {{"type", "Point"}, {"coordinates", coordinates(places[0])}};
  MapJson lines = MapJson::array({MapJson::array()});
  for (std::size_t i = 0; i < places.size(); ++i) {
    const GeodeticPlace& at = places[i];
    if (i > 0 && std::abs(at.longitude_deg - places[i - 1].longitude_deg) > 180.0) {
      const GeodeticPlace& before = places[i - 1];
      const double edge = before.longitude_deg > 0.0 ? 180.0 : -180.0;
      const double there = edge - before.longitude_deg,
                   whole = at.longitude_deg + 2.0 * edge - before.longitude_deg;
      const double part = whole != 0.0 ? there / whole : 0.0;
      GeodeticPlace cut{before.latitude_deg + part * (at.latitude_deg - before.latitude_deg), edge,
                        before.height_km + part * (at.height_km - before.height_km)};
      lines.back().push_back(coordinates(cut));
      cut.longitude_deg = -edge;
      lines.push_back(MapJson::array({coordinates(cut)}));
    }
    lines.back().push_back(coordinates(at));
  }
  if (lines.size() == 1) return {{"type", "LineString"}, {"coordinates", lines[0]}};
  return {{"type", "MultiLineString"}, {"coordinates", lines}};
}

std::string kml_coordinates(const GeodeticPlace& place) {
  return fmt::format("{:.6f},{:.6f},{:.1f}", place.longitude_deg, place.latitude_deg, 1e3 * place.height_km);
}

MapJson geojson_feature(MapJson geometry, MapJson properties) {
  return {{"type", "Feature"}, {"geometry", std::move(geometry)}, {"properties", std::move(properties)}};
}

std::string kml_mark(const std::string& name, const std::string& words, const std::string& geometry) {
  return "<Placemark><name>" + xml_text(name) + "</name>" +
         (words.empty() ? "" : "<description>" + xml_text(words) + "</description>") + geometry +
         "</Placemark>\n";
}

std::string kml_line(const std::vector<GeodeticPlace>& places, bool is_on_ground) {
  std::string text = is_on_ground ? "<LineString><tessellate>1</tessellate><coordinates>"
                                  : "<LineString><altitudeMode>absolute</altitudeMode><coordinates>";
  for (const GeodeticPlace& place : places) text += kml_coordinates(place) + " ";
  return text + "</coordinates></LineString>";
}

std::string geojson_text(const MapJson& features) {
  return MapJson({{"type", "FeatureCollection"}, {"features", features}})
             .dump(1, ' ', false, MapJson::error_handler_t::replace) +
         "\n";
}

std::string kml_text(const std::string& name, const std::string& marks) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml "
         "xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document>\n<name>" +
         xml_text(name) + "</name>\n" + marks + "</Document>\n</kml>\n";
}

}  // namespace vegard::fit
