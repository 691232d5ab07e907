#include "sim/scene/table/alternative_forms.h"

#include <algorithm>
#include <cmath>

#include "sim/base/text.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/keyframe_keys.h"

namespace vegard::sim {
namespace {

constexpr double degrees = 180.0 / 3.14159265358979323846;

using Values = std::vector<std::vector<double>>;

/// Bearing is counted from north to the east, hence atan2(east, north).
std::optional<Complaint> convert_ends(Scene& scene, int index, const Values& values) {
  const auto &start = values[0], &end = values[1];
  const double east = end[0] - start[0], north = end[1] - start[1];
  if (east == 0.0 && north == 0.0) {
    return Complaint{"start and end are the same point", "two different points", ""};
  }
  Sheet& sheet = scene.sheets.at(index);
  sheet.center_km = {start[0] + 0.5 * east, start[1] + 0.5 * north};
  const double bearing = std::atan2(east, north) * degrees;
  sheet.bearing_deg = bearing < 0.0 ? bearing + 360.0 : bearing;
  // A bearing of a hair below zero would round to 360.
  if (sheet.bearing_deg >= 360.0) sheet.bearing_deg = 0.0;
  sheet.length_km = std::hypot(east, north);
  return std::nullopt;
}

std::optional<Complaint> convert_focal_length(Scene& scene, int, const Values& values) {
  const double focal_length_mm = values[0][0], sensor_width_mm = values[1][0];
  scene.camera.hfov_deg = 2.0 * std::atan(0.5 * sensor_width_mm / focal_length_mm) * degrees;
  return std::nullopt;
}

/// The paper's n_p. How many beams a layer has is known by then, and how long it is: forms are read in their
/// order, after all that is a row.
std::optional<Complaint> convert_points_between_folds(Scene& scene, int index, const Values& values) {
  Sheet& sheet = scene.sheets.at(index);
  const double beams_per_km = sheet.beams_per_km > 0.0 ? sheet.beams_per_km : sheet.beams / sheet.length_km;
  sheet.fold_spacing_km = values[0][0] / beams_per_km;
  return std::nullopt;
}

std::optional<Complaint> convert_ibc(Scene& scene, int index, const Values& values) {
  scene.sheets.at(index).brightness_kilorayleigh = std::pow(10.0, values[0][0] - 1.0);
  return std::nullopt;
}

/// The mean step is half the largest.
std::optional<Complaint> convert_mean_collisions(Scene& scene, int index, const Values& values) {
  scene.sheets.at(index).path_step = 2.0 / values[0][0];
  return std::nullopt;
}

/// The first adiabatic invariant: what mirrors at 100 km has the pitch angle arcsin sqrt(B / B at 100 km).
std::optional<Complaint> convert_field_ratio(Scene& scene, int index, const Values& values) {
  scene.sheets.at(index).loss_cone_deg = std::asin(std::sqrt(values[0][0])) * degrees;
  return std::nullopt;
}

/// A form of one key, a number.
AlternativeForm one_number(const FileKey& key, double min, double max, const std::string& replaces,
                           std::optional<Complaint> (*convert)(Scene&, int, const Values&)) {
  return {{key}, {}, min, max, {replaces}, convert};
}

std::vector<AlternativeForm> declare_forms() {
  const std::string point = "two numbers (east, north)";
  return {
      {{{"sheet", "start_km", "km", "start of the sheet's feet, at 110 km altitude", point},
        {"sheet", "end_km", "km", "its end", point}},
       {"east", "north"},
       -5000.0,
       5000.0,
       {"center_km", "bearing_deg", "length_km"},
       convert_ends},
      one_number({"sheet", "ibc", "", "international brightness coefficient: 10^(ibc−1) kR", "a number"}, 1.0,
                 4.0, "brightness_kilorayleigh", convert_ibc),
      one_number({"sheet", "mean_collisions", "", "deflections on a path (mean), 2 / path_step", "a number"},
                 4.0, 200000.0, "path_step", convert_mean_collisions),
      one_number({"sheet", "field_ratio", "",
                  "field at the electrons' source over that at 100 km: sin² of the loss cone", "a number"},
                 0.0, 0.24, "loss_cone_deg", convert_field_ratio),
      one_number(
          {"sheet", "points_between_folds", "", "beams of a layer from one fold to the next", "a number"},
          1.0, 10000000.0, "fold_spacing_km", convert_points_between_folds),
      {{{"camera", "focal_length_mm", "mm", "true focal length of the lens", "a number"},
        {"camera", "sensor_width_mm", "mm", "of the image on the sensor", "a number"}},
       {},
       0.01,
       100000.0,
       {"hfov_deg"},
       convert_focal_length},
  };
}

}  // namespace

std::string AlternativeForm::replaces_text() const { return joined(replaces); }

std::string AlternativeForm::words() const {
  if (keys.size() == 1) return keys.front().key + " stands for " + replaces_text();
  return keys.front().key + " and " + keys.back().key + " stand for " + replaces_text();
}

const std::vector<AlternativeForm>& alternative_forms() {
  static const std::vector<AlternativeForm> forms = declare_forms();
  return forms;
}

const AlternativeForm* find_alternative_form(const std::string& key) {
  for (const AlternativeForm& form : alternative_forms()) {
    const auto has_key = [&](const FileKey& k) { return k.key == key; };
    if (std::any_of(form.keys.begin(), form.keys.end(), has_key)) return &form;
  }
  return nullptr;
}

std::vector<FileKey> all_file_keys() {
  std::vector<FileKey> keys;
  for (const AlternativeForm& form : alternative_forms()) {
    for (const FileKey& key : form.keys) keys.push_back(key);
    keys[keys.size() - form.keys.size()].meaning += " (instead of " + form.replaces_text() + ")";
  }
  keys.push_back({"sheet", curve_file_key, "",
                  "curtains.csv of vegard map (instead of east_km, north_km and the point_ keys)", "a text"});
  keys.push_back({"sheet", curve_number_key, "", "number of its curtain, from 1", "a whole number"});
  keys.push_back({"", key_table, "", "what moves, for vegard animate and render", "tables [[key]]"});
  for (const KeyframeKey& key : keyframe_keys())
    keys.push_back({key_table, key.key, key.unit, key.meaning, key.type});
  const std::string table = free_table, entry = free_table + ("." + std::string(free_key));
  keys.push_back({table, free_key, "", "what is fitted", "an array of paths and tables"});
  keys.push_back({entry, free_path_key, "", "of a vector all components", "a text"});
  for (const FreeNumberKey& key : free_number_keys()) {
    keys.push_back({entry, key.key, "", key.meaning, "a number"});
  }
  for (const FreeTextKey& key : free_text_keys()) keys.push_back({entry, key.key, "", key.meaning, key.type});
  for (const FreePriorKey& key : free_prior_keys()) {
    keys.push_back({entry + "." + free_prior_key, key.key, "", key.meaning, "a number"});
  }
  keys.push_back(
      {entry + "." + free_prior_key, prior_law_key, "", "uniform: only min and max", prior_law_type});
  keys.push_back({table, tied_key, "", "what follows from what is fitted", "an array of tables"});
  for (const TiedKey& key : tied_keys())
    keys.push_back({table + "." + tied_key, key.key, "", key.meaning, key.type});
  const std::string photo = table + "." + photo_key;
  keys.push_back({table, photo_key, "", "what is fitted together", "tables [[fit.photo]]"});
  for (const PhotoTextKey& key : photo_text_keys()) {
    keys.push_back({photo, key.key, "", key.meaning, "a text"});
  }
  keys.push_back({photo, photo_set_key, "", "values of this photograph alone: camera, site, time …",
                  "a table of path = value"});
  const std::string radar = table + "." + radar_key;
  keys.push_back({table, radar_key, "", "densities beside the light", "tables [[fit.radar]]"});
  for (const RadarTextKey& key : radar_text_keys())
    keys.push_back({radar, key.key, "", key.meaning, "a text"});
  for (const RadarNumberKey& key : radar_number_keys())
    keys.push_back({radar, key.key, key.unit, key.meaning, "a number"});
  return keys;
}

}  // namespace vegard::sim
