#include <cstdint>
#include <limits>
#include <set>
#include <variant>

#include "sim/base/error.h"
#include "sim/scene/parameter_declarations.h"
#include "sim/scene/parameter_table.h"
#include "sim/scene/value_check.h"

namespace vegard::sim {
namespace {

std::optional<Complaint> complaint_about(const Declaration& d, const ValueRef& value) {
  struct Check {
    const Declaration& d;
    std::optional<Complaint> operator()(const double* v) const { return number_complaint(d, *v); }
    std::optional<Complaint> operator()(const int* v) const { return number_complaint(d, *v); }
    std::optional<Complaint> operator()(const std::uint64_t* v) const {
      // TOML's integers end there.
      constexpr auto largest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
      if (*v <= largest) return number_complaint(d, static_cast<double>(*v));
      return Complaint{std::to_string(*v) + " is too large", "at most " + std::to_string(largest), ""};
    }
    std::optional<Complaint> operator()(const bool*) const { return std::nullopt; }
    std::optional<Complaint> operator()(const std::string* v) const { return text_complaint(d, *v); }
  };
  return std::visit(Check{d}, value);
}

void check_sheet_names(const Scene& scene) {
  std::set<std::string> names;
  for (const Sheet& sheet : scene.sheets) {
    if (names.insert(sheet.name).second) continue;
    complain({"two sheets are called '" + sheet.name + "'", "a name of its own for each sheet", ""},
             {scene.file, 0, "sheet." + sheet.name + ".name"});
  }
}

void check_region(const Scene& scene) {
  const auto& [x, y, width, height] = scene.fit.roi_px;
  const bool is_whole_image = x == 0 && y == 0 && width == 0 && height == 0;
  if (is_whole_image) return;
  const Origin origin{scene.file, 0, "fit.roi_px"};
  if (width == 0 || height == 0) {
    complain({"the region of interest is empty", "x, y, width and height, with width and height above 0",
              "all four zero stands for the whole image"},
             origin);
  }
  if (scene.fit.bands > width) {
    complain({std::to_string(scene.fit.bands) + " bands do not fit into a region " + std::to_string(width) +
                  " pixels wide",
              "at most one band per pixel column", "lower fit.bands or widen fit.roi_px"},
             origin);
  }
}

}  // namespace

void validate(const Scene& scene) {
  for (const Declaration& d : declarations()) {
    if (!d.list) continue;
    if (const auto complaint = d.list_rule(scene, d.list(scene))) {
      complain(*complaint, {scene.file, 0, key_path(d, scene, -1)});
    }
  }
  for (const ParameterPath& path : all_paths(scene)) {
    const Declaration& d = declaration_of(*path.row);
    // Only read through: the accessors take a Scene they could change.
    const ValueRef value = d.at(const_cast<Scene&>(scene), path.sheet, path.component);
    if (const auto complaint = complaint_about(d, value)) complain(*complaint, {scene.file, 0, path.text});
  }
  check_sheet_names(scene);
  check_region(scene);
  check_free_parameters(scene);
}

}  // namespace vegard::sim
