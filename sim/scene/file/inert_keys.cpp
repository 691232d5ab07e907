#include "sim/scene/file/inert_keys.h"

#include <map>
#include <optional>
#include <utility>

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/freedom/inert_parameter.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {
namespace {

constexpr double kCatalogueEnds_mag = 6.0;  // data/stars/README.md

/// The same sheets by name and form, and nothing else.
Scene unsaid(const Scene& scene) {
  std::string text;
  for (const Sheet& sheet : scene.sheets)
    text += "[[sheet]]\nname = \"" + sheet.name + "\"\nform = \"" + sheet.form + "\"\n";
  return parse_scene(text, "");
}

/// The line of the file that sets the number or its list; 0 if a change of the scene has; none if it was not
/// set.
std::optional<int> line_that_sets(const Scene& scene, const ParameterPath& path) {
  for (std::string key = path.text; !key.empty();) {
    const auto found = scene.lines.find(key);
    if (found != scene.lines.end()) return found->second;
    const std::size_t dot = key.rfind('.');
    if (dot == std::string::npos || key.substr(dot + 1) == path.row->key) break;
    key.resize(dot);
  }
  return std::nullopt;
}

std::string problem_of(const Scene& scene, const ParameterPath& path) {
  const std::string& table = path.row->table;
  const std::string& key = path.row->key;
  if (table == "blur" && key == "kernel" && scene.blur.model == BlurModel::physical)
    return "the blur is physical, so kernel has no effect";
  if (table == "blur" && key == "wind_m_s" && scene.blur.model == BlurModel::angle)
    return "the blur is by angle, so the wind has no effect";
  if (path.sheet() >= 0 && key == "energy_kev" &&
      scene.sheets[static_cast<std::size_t>(path.sheet())].profile == ProfileKind::form)
    return "the heights of the light are those of a form's curve (peak_km, lower_km, upper_km), so "
           "energy_kev sets the ratios of the lines and their brightness alone; profile = \"maxwellian\" has "
           "heights by energy";
  if (table == "stars" && key == "faintest_magnitude" && scene.stars.source == StarSource::catalogue &&
      scene.stars.faintest_magnitude > kCatalogueEnds_mag)
    return "the catalogue's stars end at V = 6, so none that is fainter is "
           "shown; stars.source = \"random\" "
           "has them";
  const auto complaint = inert_number_complaint(scene, path);
  return complaint ? complaint->problem : std::string();
}

}  // namespace

std::vector<std::string> inert_keys(const Scene& scene) {
  if (scene.lines.empty()) return {};
  const Scene plain = unsaid(scene);
  std::map<std::pair<int, std::string>, std::string> found;
  for (const ParameterPath& path : all_paths(scene)) {
    const std::optional<int> line = line_that_sets(scene, path);
    if (!line) continue;
    const std::string problem = problem_of(scene, path);
    if (problem.empty()) continue;
    if (index_in(plain, path.id) >= 0 && value_text(scene, path) == value_text(plain, path)) continue;
    // All components of a list are reported at once.
    found.emplace(std::pair{*line, problem}, path.text);
  }
  std::vector<std::string> told;
  for (const auto& [place, text] : found)
    told.push_back((place.first > 0 ? scene.file + ":" + std::to_string(place.first) + ": " : std::string()) +
                   text + ": " + place.second);
  return told;
}

}  // namespace vegard::sim
