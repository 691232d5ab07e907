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

/// The same sheets by name and form, and nothing else. It need not be a valid scene: a form may be of a line
/// that emission.lines has to name.
Scene unsaid(const Scene& scene) {
  Scene plain;
  for (const Sheet& sheet : scene.sheets) {
    plain.sheets.emplace_back();
    plain.sheets.back().name = sheet.name;
    set_from_text(plain, "sheet." + sheet.name + ".form", sheet.form);
  }
  return plain;
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

}  // namespace

std::vector<std::string> inert_keys(const Scene& scene) {
  if (scene.lines.empty()) return {};
  const Scene plain = unsaid(scene);
  std::map<std::pair<int, std::string>, std::string> found;
  for (const ParameterPath& path : all_paths(scene)) {
    const std::optional<int> line = line_that_sets(scene, path);
    if (!line) continue;
    const auto complaint = inert_number_complaint(scene, path);
    if (!complaint) continue;
    if (index_in(plain, path.id) >= 0 && value_text(scene, path) == value_text(plain, path)) continue;
    // All components of a list are reported at once.
    found.emplace(std::pair{*line, complaint->problem}, path.text);
  }
  std::vector<std::string> told;
  for (const auto& [place, text] : found)
    told.push_back((place.first > 0 ? scene.file + ":" + std::to_string(place.first) + ": " : std::string()) +
                   text + ": " + place.second);
  return told;
}

}  // namespace vegard::sim
