#include "fit/triangulation/triangulation_texts.h"

#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/triangulation/map_marks.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/number_text.h"
#include "sim/base/text.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kGroundPoints = 16;  ///< along the ground below a line of sight

std::string number_cell(double value) { return std::isfinite(value) ? sim::csv_number(value) : "NaN"; }

std::string names_of(const Triangulation& all, const std::vector<std::size_t>& cameras) {
  std::string names;
  for (const std::size_t camera : cameras)
    names += (names.empty() ? "" : "+") + all.cameras[camera].camera().name;
  return names;
}

std::string note_of(const TriangulatedRow& row) {
  if (!row.point.is_given()) return words_of(row.point.reason);
  if (is_contradicted(row.point)) return "the lines of sight miss each other beyond their errors";
  return row.doubt;
}

/// The rows that a map shows: all points, and of curves the most probable match.
bool is_shown(const TriangulatedRow& row) { return row.point.is_given() && row.branch == 0; }

struct ShownCurve {
  std::string name;
  std::vector<const TriangulatedRow*> rows;
};

/// The shown rows of each curve and pair of cameras.
std::vector<ShownCurve> shown_curves(const Triangulation& all) {
  std::vector<ShownCurve> curves;
  for (const TriangulatedRow& row : all.rows) {
    if (!row.is_curve || !is_shown(row)) continue;
    if (curves.empty() || curves.back().name != row.name || curves.back().rows.back()->cameras != row.cameras)
      curves.push_back({row.name, {}});
    curves.back().rows.push_back(&row);
  }
  return curves;
}

/// Places on the ground below a line of sight, from the camera to the point.
std::vector<GeodeticPlace> ground_below(const Triangulation& all, std::size_t camera,
                                        const TriangulatedPoint& point) {
  std::vector<GeodeticPlace> ground;
  const ViewPoint& view = all.cameras[camera];
  for (int i = 0; i <= kGroundPoints; ++i) {
    const double part = static_cast<double>(i) / kGroundPoints;
    ground.push_back(
        geodetic_place(view.shape(), view.place_km() + part * (point.place_km - view.place_km())));
    ground.back().height_km = 0.0;
  }
  return ground;
}

GeodeticPlace place_of(const ViewPoint& view) {
  const sim::Site& site = view.camera().site;
  return {site.latitude_deg, site.longitude_deg, 1e-3 * site.altitude_m};
}

std::string height_words(const TriangulatedPoint& point) {
  return sim::number_with_error(point.place.height_km, point.height_error_km) + " km";
}

std::string branch_words(const CurveBranch& branch) {
  return fmt::format("{} km (weight {:.2f}; {} points, scatter {} km)",
                     sim::number_with_error(branch.mean.km, branch.mean.error_km), branch.weight,
                     branch.mean.points, sim::short_number(branch.mean.scatter_km, 2));
}

}  // namespace

std::string triangulation_table(const Triangulation& all) {
  std::string text;
  for (const TriangulatedRow& row : all.rows) {
    if (row.is_curve) continue;
    if (!row.point.is_given()) {
      text += fmt::format("{}: no place, {}\n", row.name, words_of(row.point.reason));
      continue;
    }
    const TriangulatedPoint& point = row.point;
    text += fmt::format("{}: height {}, {:.4f}° N {:.4f}° E, lines miss by {} km (chi2 {}, parallax {}°){}\n",
                        row.name, height_words(point), point.place.latitude_deg, point.place.longitude_deg,
                        sim::short_number(point.miss_km, 2), sim::short_number(point.chi2, 2),
                        sim::short_number(point.parallax_deg, 3),
                        is_contradicted(point) ? "; beyond their errors" : "");
  }
  for (const CurveSummary& curve : all.curves) {
    const std::string name =
        curve.name + " (" + names_of(all, {curve.first_camera, curve.second_camera}) + ")";
    const MatchedCurves& matched = curve.matched;
    if (matched.branches.empty()) {
      text += name + ": no match, ";
      text +=
          matched.along_epipolar > matched.outside_range
              ? "the curve runs along the lines in which the cameras see each other's sights\n"
          : matched.outside_range > 0
              ? fmt::format("{} crossings, none at a height of {:.0f} to {:.0f} km\n", matched.outside_range,
                            all.settings.heights.lowest_km, all.settings.heights.highest_km)
              : "the curves share no part of the sky\n";
      continue;
    }
    text += name + ": height " + branch_words(matched.branches.front()) + "\n";
    for (const std::string& doubt : doubts_about(matched.branches.front(), matched.branches.front().weight))
      text += "  with care: " + doubt + "\n";
    for (std::size_t i = 1; i < matched.branches.size(); ++i)
      text += "  or " + branch_words(matched.branches[i]) + "\n";
  }
  return text;
}

std::string triangulation_csv(const Triangulation& all) {
  std::string text =
      sim::csv_comment("Places by lines of sight, vegard " + std::string(sim::version()) +
                       (all.settings.earth == EarthShape::wgs84 ? "; heights are above the ellipsoid WGS 84"
                                                                : "; heights are above a sphere of 6371 km"));
  text +=
      "name,kind,cameras,match,match_weight,latitude_deg,longitude_deg,height_km,height_error_km,"
      "east_error_km,north_error_km,miss_km,chi2,freedom,probability,parallax_deg,parallax_error_deg,note\n";
  for (const TriangulatedRow& row : all.rows) {
    const TriangulatedPoint& point = row.point;
    text += sim::csv_cell(row.name) + (row.is_curve ? ",curve," : ",point,") +
            sim::csv_cell(names_of(all, row.cameras)) + "," + std::to_string(row.branch + 1) + "," +
            number_cell(row.branch_weight);
    for (const double value :
         {point.place.latitude_deg, point.place.longitude_deg, point.place.height_km, point.height_error_km,
          point.east_error_km, point.north_error_km, point.miss_km, point.chi2})
      text += "," + number_cell(value);
    text += "," + std::to_string(point.freedom);
    for (const double value : {point.probability, point.parallax_deg, point.parallax_error_deg})
      text += "," + number_cell(value);
    text += "," + sim::csv_cell(note_of(row)) + "\n";
  }
  return text;
}

nlohmann::ordered_json triangulation_json(const Triangulation& all) {
  Json json = {{"earth", all.settings.earth == EarthShape::wgs84 ? "wgs84" : "sphere"},
               {"drift_km_s", all.settings.drift_km_s},
               {"rows", all.rows.size()},
               {"without_place", all.refused()},
               {"contradicted", all.contradicted()},
               {"ambiguous_curves", all.ambiguous()}};
  for (const ViewPoint& view : all.cameras) {
    const PlacedCamera& camera = view.camera();
    json["cameras"].push_back({{"name", camera.name},
                               {"latitude_deg", camera.site.latitude_deg},
                               {"longitude_deg", camera.site.longitude_deg},
                               {"altitude_m", camera.site.altitude_m},
                               {"pointing_error_deg", camera.pointing_error_deg},
                               {"clock_error_s", camera.clock_error_s}});
  }
  json["points"] = Json::array();
  for (const TriangulatedRow& row : all.rows) {
    if (row.is_curve) continue;
    const TriangulatedPoint& point = row.point;
    json["points"].push_back({{"name", row.name},
                              {"latitude_deg", number_or_null(point.place.latitude_deg)},
                              {"longitude_deg", number_or_null(point.place.longitude_deg)},
                              {"height_km", number_or_null(point.place.height_km)},
                              {"height_error_km", number_or_null(point.height_error_km)},
                              {"miss_km", number_or_null(point.miss_km)},
                              {"chi2", number_or_null(point.chi2)},
                              {"probability", number_or_null(point.probability)},
                              {"parallax_deg", number_or_null(point.parallax_deg)},
                              {"note", note_of(row)}});
  }
  json["curves"] = Json::array();
  for (const CurveSummary& curve : all.curves) {
    Json matches = Json::array();
    for (const CurveBranch& branch : curve.matched.branches)
      matches.push_back({{"height_km", number_or_null(branch.mean.km)},
                         {"height_error_km", number_or_null(branch.mean.error_km)},
                         {"common_error_km", number_or_null(branch.mean.common_error_km)},
                         {"scatter_km", number_or_null(branch.mean.scatter_km)},
                         {"points", branch.mean.points},
                         {"share", branch.share},
                         {"weight", branch.weight},
                         {"note", sim::joined(doubts_about(branch, branch.weight), "; ")}});
    json["curves"].push_back({{"name", curve.name},
                              {"cameras", {curve.first_camera + 1, curve.second_camera + 1}},
                              {"matches", matches},
                              {"crossings_outside_heights", curve.matched.outside_range},
                              {"crossings_along_epipolar", curve.matched.along_epipolar}});
  }
  return json;
}

std::string triangulation_geojson(const Triangulation& all) {
  Json features = Json::array();
  for (const ViewPoint& view : all.cameras)
    features.push_back(
        geojson_feature({{"type", "Point"}, {"coordinates", geojson_coordinates(place_of(view))}},
                        {{"name", view.camera().name}, {"kind", "camera"}}));
  for (const TriangulatedRow& row : all.rows) {
    if (row.is_curve || !is_shown(row)) continue;
    features.push_back(
        geojson_feature({{"type", "Point"}, {"coordinates", geojson_coordinates(row.point.place)}},
                        {{"name", row.name},
                         {"kind", "point"},
                         {"height_km", row.point.place.height_km},
                         {"height_error_km", row.point.height_error_km},
                         {"miss_km", row.point.miss_km},
                         {"note", note_of(row)}}));
    for (const std::size_t camera : row.cameras) {
      features.push_back(geojson_feature(geojson_line(ground_below(all, camera, row.point), true),
                                         {{"name", row.name},
                                          {"kind", "ground below the line of sight"},
                                          {"camera", all.cameras[camera].camera().name}}));
    }
  }
  for (const ShownCurve& curve : shown_curves(all)) {
    std::vector<GeodeticPlace> places;
    Json heights = Json::array(), errors = Json::array();
    for (const TriangulatedRow* row : curve.rows) {
      places.push_back(row->point.place);
      heights.push_back(row->point.place.height_km);
      errors.push_back(row->point.height_error_km);
    }
    features.push_back(
        geojson_feature(geojson_line(places, false), {{"name", curve.name},
                                                      {"kind", "curve"},
                                                      {"weight", curve.rows.front()->branch_weight},
                                                      {"height_km", heights},
                                                      {"height_error_km", errors}}));
  }
  return geojson_text(features);
}

std::string triangulation_kml(const Triangulation& all) {
  std::string marks;
  const auto mark = [](const GeodeticPlace& place) {
    return "<Point><altitudeMode>absolute</altitudeMode><coordinates>" + kml_coordinates(place) +
           "</coordinates></Point>";
  };
  for (const ViewPoint& view : all.cameras)
    marks += kml_mark(view.camera().name, "camera", mark(place_of(view)));
  for (const TriangulatedRow& row : all.rows) {
    if (row.is_curve || !is_shown(row)) continue;
    marks += kml_mark(row.name, "height " + height_words(row.point), mark(row.point.place));
    for (const std::size_t camera : row.cameras)
      marks += kml_mark(row.name + " from " + all.cameras[camera].camera().name, "",
                        kml_line(ground_below(all, camera, row.point), true));
  }
  for (const ShownCurve& curve : shown_curves(all)) {
    std::vector<GeodeticPlace> places;
    for (const TriangulatedRow* row : curve.rows) places.push_back(row->point.place);
    marks += kml_mark(curve.name, fmt::format("weight {:.2f}", curve.rows.front()->branch_weight),
                      places.size() == 1 ? mark(places.front()) : kml_line(places, false));
  }
  return kml_text("vegard triangulate", marks);
}

}  // namespace vegard::fit
