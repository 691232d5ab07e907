#include "sim/scene/emitters/element_rules.h"

#include <algorithm>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

Error ElementCheck::error_at(const Complaint& complaint, const std::string& key) const {
  return scene_error(complaint, {scene_.file, 0, path_ + "." + key});
}

void ElementCheck::check_shown() const {
  if (!scene_.sun.shown)
    throw error_at({"it stands on the Sun, which is not in the scene", "shown = true in [sun]", ""}, "name");
}

void ElementCheck::check_lines(const std::vector<double>& list, bool may_be_empty, const char* key) const {
  const std::size_t lines = scene_.emission.lines.size();
  if (list.size() == lines || (may_be_empty && list.empty())) return;
  throw error_at({std::to_string(list.size()) + " numbers for " + std::to_string(lines) + " emission lines",
                  "one per line of emission.lines, in its order", ""},
                 key);
}

void ElementCheck::check_below(double low, const char* low_key, double high, const char* high_key) const {
  if (low < high) return;
  throw error_at(
      {std::string(low_key) + " is not below " + high_key, std::string(low_key) + " below " + high_key, ""},
      low_key);
}

std::string word_in(const std::vector<Declaration>& rows, const std::type_info& kind, int number) {
  for (const Declaration& d : rows) {
    if (d.kind_type == nullptr || *d.kind_type != kind) continue;
    const auto found = std::find(d.numbers.begin(), d.numbers.end(), number);
    if (found != d.numbers.end()) return d.choices[static_cast<std::size_t>(found - d.numbers.begin())];
  }
  return {};
}

bool all_zero(const std::vector<double>& list) {
  return std::all_of(list.begin(), list.end(), [](double x) { return x == 0.0; });
}

bool frees(const Scene& scene, const std::string& path) {
  return std::any_of(scene.fit.free.begin(), scene.fit.free.end(), [&](const FreeParameter& free) {
    return free.path == path || free.path.rfind(path + ".", 0) == 0;
  });
}

bool turns_with_sun(const Scene& scene) {
  return scene.sun.shown && scene.sun.rotation != SolarRotation::none;
}

bool any_line_responds(const Scene& scene) {
  const std::vector<double>& lines = scene.emission.lines;
  return std::any_of(lines.begin(), lines.end(),
                     [](double nm) { return temperature_response(nm).has_value(); });
}

}  // namespace vegard::sim
