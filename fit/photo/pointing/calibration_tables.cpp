#include "fit/photo/pointing/calibration_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/photo/pointing/direction_error.h"
#include "fit/photo/pointing/held_out.h"
#include "fit/photo/pointing/star_check.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/version.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/bright_stars.h"

namespace vegard::fit {
namespace {

using Json = nlohmann::ordered_json;

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Returns the lenses that took part, ordered by their BIC, then the others.
std::vector<const LensCandidate*> in_order(const Calibration& calibration) {
  std::vector<const LensCandidate*> order;
  for (const LensCandidate& candidate : calibration.candidates) order.push_back(&candidate);
  std::stable_sort(order.begin(), order.end(), [](const LensCandidate* a, const LensCandidate* b) {
    if (a->objection.empty() != b->objection.empty()) return a->objection.empty();
    return a->objection.empty() && a->bic < b->bic;
  });
  return order;
}

std::string lens_words(const LensCandidate& candidate) {
  return words_of(candidate.form) + (candidate.fit.camera.mirrored ? ", mirrored" : "");
}

/// ",upper left,0.12,-0.3,1" and a line break.
std::string held_out_cells(const Calibration& calibration, std::size_t star) {
  const StarResidual& one = calibration.residuals[star];
  return "," + region_name(calibration.frame, calibration.stars[star].x_px, calibration.stars[star].y_px) +
         "," + sim::csv_number(one.without_region_dx_px) + "," + sim::csv_number(one.without_region_dy_px) +
         (one.used ? ",1\n" : ",0\n");
}

}  // namespace

std::string residuals_csv(const Calibration& calibration) {
  std::string csv =
      "star,azimuth_deg,elevation_deg,magnitude,x_px,y_px,dx_px,dy_px,without_dx_px,without_dy_px,off_axis_"
      "deg,from_centre_px,region,without_region_dx_px,without_region_dy_px,used\n";
  for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
    const StarSighting& star = calibration.stars[i];
    const StarResidual& one = calibration.residuals[i];
    const sim::Direction direction = sim::direction_of_enu(star.enu.data());
    csv += sim::csv_cell(star.name);
    for (const double value :
         {direction.azimuth_deg, direction.elevation_deg, star.magnitude, star.x_px, star.y_px, one.dx_px,
          one.dy_px, one.without_dx_px, one.without_dy_px, one.off_axis_deg, one.from_centre_px})
      csv += "," + sim::csv_number(value);
    csv += held_out_cells(calibration, i);
  }
  return csv;
}

std::string stars_csv(const Calibration& calibration) {
  std::string csv;
  for (const std::string& words : {held_out_line(calibration), explained_line(calibration)})
    if (!words.empty()) csv += sim::csv_comment(words);
  csv +=
      "name,ra_deg,dec_deg,magnitude,x_px,y_px,dx_px,dy_px,without_dx_px,without_dy_px,region,"
      "without_region_dx_px,without_region_dy_px,used\n";
  for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
    const StarSighting& star = calibration.stars[i];
    const sim::BrightStar* known = sim::find_bright_star(star.name);
    if (known == nullptr) continue;
    const StarResidual& one = calibration.residuals[i];
    csv += sim::csv_cell(star.name) +
           fmt::format(",{:.4f},{:.4f},{:.2f},{:.3f},{:.3f}", known->place.j2000.right_ascension_deg,
                       known->place.j2000.declination_deg, star.magnitude, star.x_px, star.y_px);
    for (const double value : {one.dx_px, one.dy_px, one.without_dx_px, one.without_dy_px})
      csv += "," + sim::csv_number(value);
    csv += held_out_cells(calibration, i);
  }
  return csv;
}

std::string calibration_json(const Calibration& calibration, const CalibrationOrigin& origin) {
  Json json;
  json["vegard"] = sim::version();
  const bool stars = calibration.evidence == CalibrationEvidence::stars;
  json[stars ? "stars_from" : "maps_from"] = origin.stars;
  if (!origin.image.empty()) json["picture"] = origin.image;
  if (!origin.site.time_utc.empty()) json["time_utc"] = origin.site.time_utc;
  if (origin.instant) {
    json["exposure_begins_utc"] = origin.instant->begin_utc;
    json["time_from"] = origin.instant->source;
    json["middle_after_s"] =
        origin.instant->middle_after_s ? json_number(*origin.instant->middle_after_s) : Json(nullptr);
    json["time_error_s"] = json_number(origin.instant->error_s);
    json["time_error_turn_deg"] = json_number(origin.instant->turn_error_deg());
  }
  if (!origin.from_photograph.empty()) json["from_photograph"] = origin.from_photograph;
  json["lens"] = words_of(calibration.form);
  json["mirrored"] = calibration.camera.mirrored;
  json["picture_size_px"] = {calibration.frame.width_px, calibration.frame.height_px};
  json["picture_size_known"] = calibration.frame.known;
  json[stars ? "stars_used" : "points_used"] = calibration.used();
  json["rms_px"] = json_number(calibration.rms_px);
  if (stars) json["rms_without_each_star_px"] = json_number(calibration.without_rms_px);
  if (calibration.maps)
    json["maps"] = {{"pixels", calibration.maps->pixels},
                    {"pixels_without_image", calibration.maps->without_image},
                    {"rms_px", json_number(calibration.maps->rms_px)},
                    {"largest_px", json_number(calibration.maps->largest_px)},
                    {"largest_at", {calibration.maps->largest_x, calibration.maps->largest_y}}};
  if (stars) {
    json["regions"] = Json::array();
    for (const RegionHeldOut& one : regions_held_out(calibration))
      json["regions"].push_back({{"region", one.name},
                                 {"stars", one.stars},
                                 {"rms_without_each_star_px", json_number(one.without_rms_px)},
                                 {"rms_without_the_region_px", json_number(one.without_region_rms_px)}});
  }
  if (calibration.explained)
    json["points_of_light"] = {{"found", calibration.explained->points},
                               {"stars", calibration.explained->stars},
                               {"by_chance", json_number(calibration.explained->by_chance)},
                               {"faintest_magnitude", json_number(calibration.explained->faintest)}};
  json["sigma_px"] = json_number(calibration.sigma_px);
  json["axis_sigma_deg"] = json_number(calibration.line_of_sight_sigma_deg);
  json["turn_sigma_deg"] = json_number(calibration.twist_sigma_deg);
  const DirectionErrors errors = direction_errors(calibration);
  json["direction_error_deg"] = {{"typical", json_number(errors.typical_deg)},
                                 {"worst", json_number(errors.worst_deg)},
                                 {"worst_at_px", {errors.worst_x_px, errors.worst_y_px}},
                                 {"other_lenses", errors.opinions}};
  json["numbers"] = Json::array();
  for (const CameraEstimate& estimate : calibration.estimates) {
    json["numbers"].push_back({{"key", "camera." + estimate.key()},
                               {"unit", estimate.unit()},
                               {"value", json_number(estimate.value)}});
    json["numbers"].back()["sigma"] = estimate.free ? json_number(estimate.sigma) : Json(nullptr);
  }
  json["correlation"] = Json::array();
  for (Eigen::Index i = 0; i < calibration.correlation.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < calibration.correlation.cols(); ++j)
      row.push_back(json_number(calibration.correlation(i, j)));
    json["correlation"].push_back(row);
  }
  json["warnings"] = calibration.warnings;
  json["lenses"] = Json::array();
  for (const LensCandidate* candidate : in_order(calibration)) {
    Json row = {{"lens", lens_words(*candidate)}, {"numbers", candidate->free.size()}};
    if (candidate->objection.empty()) {
      row["rms_px"] = json_number(candidate->rms_px);
      if (stars) row["rms_without_each_star_px"] = json_number(candidate->without_rms_px);
      row["bic"] = json_number(candidate->bic);
    } else {
      row["why_not"] = candidate->objection;
    }
    json["lenses"].push_back(row);
  }
  // Points of maps have no names, and are in the table of residuals.
  if (!stars) return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  json["stars"] = Json::array();
  for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
    const StarResidual& one = calibration.residuals[i];
    json["stars"].push_back({{"name", calibration.stars[i].name},
                             {"x_px", calibration.stars[i].x_px},
                             {"y_px", calibration.stars[i].y_px},
                             {"dx_px", json_number(one.dx_px)},
                             {"dy_px", json_number(one.dy_px)},
                             {"without_dx_px", json_number(one.without_dx_px)},
                             {"without_dy_px", json_number(one.without_dy_px)},
                             {"used", one.used}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string candidates_text(const Calibration& calibration, int most) {
  std::string text;
  const std::vector<const LensCandidate*> order = in_order(calibration);
  char line[200];
  int shown = 0;
  for (const LensCandidate* candidate : order) {
    if (shown == most || !candidate->objection.empty()) break;
    const bool chosen = candidate == &calibration.candidates[calibration.chosen];
    std::snprintf(line, sizeof line,
                  "%c %-38s %2zu numbers  rms %7.3f px, without each %7.3f px  BIC %+8.2f\n",
                  chosen ? '*' : ' ', lens_words(*candidate).c_str(), candidate->free.size(),
                  candidate->rms_px, candidate->without_rms_px, candidate->bic - order.front()->bic);
    text += line;
    ++shown;
  }
  if (shown < static_cast<int>(order.size())) {
    std::snprintf(line, sizeof line, "  and %d more\n", static_cast<int>(order.size()) - shown);
    text += line;
  }
  return text;
}

}  // namespace vegard::fit
