#include "fit/report/curtain_places.h"

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/triangulation/map_marks.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_line.h"

namespace vegard::fit {
namespace curtain_places {

using Json = nlohmann::ordered_json;

struct Placed {
  GeodeticPlace place;
  const CurtainPoint* point;
};

/// The curtain's points that are on the Earth.
std::vector<Placed> placed(const sim::Scene& scene, const Curtain& curtain) {
  std::vector<Placed> points;
  for (const CurtainPoint& point : curtain.points) {
    const sim::PlaceOnEarth place = sim::place_of_foot(scene, point.foot_km);
    if (std::isnan(place.latitude_deg)) continue;
    points.push_back({{place.latitude_deg, place.longitude_deg, sim::kFootAltitudeKm}, &point});
  }
  return points;
}

std::string name_of(std::size_t index) { return "curtain " + std::to_string(index + 1); }

template <class Value>
Json along(const std::vector<Placed>& points, const Value& value) {
  Json values = Json::array();
  for (const Placed& p : points) values.push_back(number_or_null(value(*p.point)));
  return values;
}

std::vector<GeodeticPlace> places_of(const std::vector<Placed>& points) {
  std::vector<GeodeticPlace> places;
  for (const Placed& p : points) places.push_back(p.place);
  return places;
}

Json properties_of(bool flux_is_absolute, const Curtain& curtain, const std::vector<Placed>& points,
                   std::size_t index) {
  const std::string flux = flux_is_absolute ? "energy_flux_mw_m2" : "relative_energy_flux";
  const auto value = [&](WithError CurtainPoint::*of) {
    return along(points, [&](const CurtainPoint& p) { return (p.*of).value; });
  };
  const auto error = [&](WithError CurtainPoint::*of) {
    return along(points, [&](const CurtainPoint& p) { return (p.*of).error; });
  };
  Json json = {{"name", name_of(index)}, {"length_km", number_or_null(curtain.length_km)}};
  json["probability"] = number_or_null(curtain.probability);
  json["is_diffuse_patch"] = curtain.is_diffuse_patch;
  json[flux] = value(&CurtainPoint::flux_mw_m2);
  json[flux + "_error"] = error(&CurtainPoint::flux_mw_m2);
  json["energy_kev"] = value(&CurtainPoint::energy_kev);
  json["energy_error_kev"] = error(&CurtainPoint::energy_kev);
  json["width_km"] = value(&CurtainPoint::width_km);
  json["width_error_km"] = error(&CurtainPoint::width_km);
  json["lower_border_km"] = value(&CurtainPoint::lower_border_km);
  json["lower_border_error_km"] = error(&CurtainPoint::lower_border_km);
  json["lateral_error_km"] = along(points, [](const CurtainPoint& p) { return p.lateral_error_km; });
  return json;
}

}  // namespace curtain_places

std::string curtains_geojson(const sim::Scene& scene, bool flux_is_absolute,
                             const std::vector<Curtain>& curtains) {
  auto features = nlohmann::ordered_json::array();
  for (std::size_t c = 0; c < curtains.size(); ++c) {
    const auto points = curtain_places::placed(scene, curtains[c]);
    if (points.empty()) continue;
    features.push_back(
        geojson_feature(geojson_line(curtain_places::places_of(points), false),
                        curtain_places::properties_of(flux_is_absolute, curtains[c], points, c)));
  }
  return geojson_text(features);
}

std::string curtains_kml(const sim::Scene& scene, const std::vector<Curtain>& curtains) {
  std::string marks;
  for (std::size_t c = 0; c < curtains.size(); ++c) {
    const std::vector<GeodeticPlace> places =
        curtain_places::places_of(curtain_places::placed(scene, curtains[c]));
    if (places.empty()) continue;
    const std::string geometry = places.size() > 1
                                     ? kml_line(places, false)
                                     : "<Point><altitudeMode>absolute</altitudeMode><coordinates>" +
                                           kml_coordinates(places.front()) + "</coordinates></Point>";
    marks +=
        kml_mark(curtain_places::name_of(c),
                 sim::short_number(curtains[c].length_km, 3) + " km long, feet at 110 km altitude", geometry);
  }
  return kml_text("vegard map", marks);
}

}  // namespace vegard::fit
