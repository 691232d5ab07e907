#include "sim/scene/freedom/inert_parameter.h"

#include <set>
#include <string>

#include "sim/scene/freedom/ties.h"
#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {
namespace {

/// The numbers of a sheet with this role that are free, by their indices.
std::set<int> free_of_sheet(const Scene& scene, int sheet, ParameterRole role) {
  std::set<int> components;
  for (const FreeParameter& free : scene.fit.free)
    for (const ParameterPath& path : paths_of(scene, free))
      if (path.sheet() == sheet && path.row->role == role) components.insert(path.component);
  return components;
}

/// A flux or brightness has no effect in a fit that frees what it is multiplied by.
std::optional<Complaint> why_flux_is_replaced(const Scene& scene, const ParameterPath& path) {
  if (path.row->role != ParameterRole::energy_flux && path.row->role != ParameterRole::line_brightness)
    return std::nullopt;
  const Sheet& sheet = scene.sheets[static_cast<std::size_t>(path.sheet())];
  const auto count_free = [&](ParameterRole role) { return free_of_sheet(scene, path.sheet(), role).size(); };
  const std::size_t points = sheet.point_brightness.size();
  if (sheet.course == SheetCourse::curve && points > 0 &&
      count_free(ParameterRole::curve_brightness) == points)
    return Complaint{
        "all of the sheet's point_brightness is free, so {key} has no effect: their product is "
        "the light",
        "a parameter that the light depends on",
        "leave {key} out of fit.free, or hold one of point_brightness"};
  if (sheet.profile == ProfileKind::spline && count_free(ParameterRole::profile_coefficient) > 0)
    return Complaint{
        "the sheet's spline_rate is free, so its energy flux has no effect: their product is the "
        "light",
        "a parameter that the light depends on", "leave {key} out of fit.free"};
  return std::nullopt;
}

/// The text with its placeholders filled in (InertRule).
std::string filled_in(const std::string& text, const Scene& scene, const ParameterPath& path) {
  std::string filled;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('{', at), close = text.find('}', open);
    filled += text.substr(at, open - at);
    if (close == std::string::npos) return filled + text.substr(std::min(open, text.size()));
    const std::string word = text.substr(open + 1, close - open - 1);
    if (word == "key")
      filled += path.row->key;
    else if (word == "element")
      filled += element_name(scene, path.id);
    else if (const Declaration* d = find_declaration(path.row->table, word))
      filled += key_text(*d, scene, path.element);
    at = close + 1;
  }
  return filled;
}

/// The complaint of the first rule that applies, to who frees the number or who sets it.
std::optional<Complaint> first_complaint(const Scene& scene, const ParameterPath& path, bool is_free) {
  std::optional<Complaint> complaint;
  if (is_free) complaint = why_flux_is_replaced(scene, path);
  for (const InertRule& rule : declaration_of(*path.row).inert_rules) {
    if (complaint || rule.use == (is_free ? InertUse::if_set : InertUse::if_free)) continue;
    complaint = rule.complaint(scene, path);
    if (complaint && !is_free && rule.use == InertUse::if_free_alone) return std::nullopt;
  }
  if (complaint)
    for (std::string* text : {&complaint->problem, &complaint->hint}) *text = filled_in(*text, scene, path);
  return complaint;
}

}  // namespace

std::optional<Complaint> inert_parameter_complaint(const Scene& scene, const ParameterPath& path) {
  return first_complaint(scene, path, true);
}

std::optional<Complaint> inert_number_complaint(const Scene& scene, const ParameterPath& path) {
  return first_complaint(scene, path, false);
}

}  // namespace vegard::sim
