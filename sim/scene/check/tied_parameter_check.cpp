#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sim/base/error.h"
#include "sim/scene/freedom/inert_parameter.h"
#include "sim/scene/freedom/ties.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {
namespace {

/// Whether it may follow from others at all, whatever the expression.
void check_path(const Scene& scene, const TiedParameter& tied) {
  for (const ParameterPath& path : paths_of(scene, tied)) {
    const Origin origin{scene.file, tied.line, path.text};
    if (!path.row->can_be_free)
      throw scene_error({"this parameter cannot be tied", "one that `vegard params` lists as free", ""},
                        origin);
    if (const auto inert = inert_parameter_complaint(scene, path)) throw scene_error(*inert, origin);
    if (path.row->role == ParameterRole::profile_coefficient)
      throw scene_error(
          {"a coefficient of a free-form profile cannot be tied", "one that is free, or fixed", ""}, origin);
    for (const FreeParameter& free : scene.fit.free) {
      if (!meet(free.photo, tied.photo)) continue;
      for (const ParameterPath& other : paths_of(scene, free))
        if (other.id == path.id)
          throw scene_error(
              {"both tied and free, free as '" + free.path + "'" + in_line(free.line), "one of the two", ""},
              origin);
    }
    for (const TiedParameter& other : scene.fit.tied) {
      if (&other == &tied) break;
      if (meet(other.photo, tied.photo) && paths_of(scene, other).front().id == path.id)
        throw scene_error({"tied twice, first" + in_line(other.line), "each parameter once", ""}, origin);
    }
  }
}

/// What the ties give where the free numbers start.
void check_values(const Scene& scene, const std::string& photo) {
  Scene start = scene;
  std::map<std::string, double> named;
  for (const FreeParameter& free : scene.fit.free) {
    if (free.path.empty()) named.emplace(free.name, *free.start);
    for (const ParameterPath& path : paths_of(scene, free)) {
      double value = free.start.value_or(*real_value(scene, path));
      // Of entries of one name the first one counts.
      if (!free.name.empty()) value = named.emplace(free.name, value).first->second;
      if (free.photo.empty() || free.photo == photo) *real_value(start, path) = value;
    }
  }
  for (const Tie& tie : ties_of(scene, photo)) {
    std::vector<double> inputs;
    for (const Tie::Input& input : tie.inputs)
      inputs.push_back(input.path.row != nullptr ? *real_value(start, input.path) : named.at(input.name));
    double value = tie.expression.value(inputs);
    if (is_within_limits(tie.path, value)) value = std::clamp(value, tie.path.row->min, tie.path.row->max);
    *real_value(start, tie.path) = value;
    const auto entry = std::find_if(scene.fit.tied.begin(), scene.fit.tied.end(), [&](const auto& tied) {
      return meet(tied.photo, photo) && paths_of(scene, tied).front().id == tie.path.id;
    });
    if (auto complaint = number_complaint(declaration_of(*tie.path.row), value)) {
      complaint->problem =
          "where the search starts, '" + tie.expression.text() + "' gives: " + complaint->problem;
      throw scene_error(*complaint, {scene.file, entry->line, tie.path.text});
    }
  }
}

/// A number that only expressions use must be used.
void check_use(const Scene& scene, const std::set<std::string>& used) {
  for (const FreeParameter& free : scene.fit.free)
    if (free.path.empty() && used.count(free.name) == 0)
      throw scene_error({"the number '" + free.name + "' has no path, and no expression of fit.tied uses it",
                         "a path, or an expression that uses it", ""},
                        {scene.file, free.line, free.name});
}

}  // namespace

void check_tied_parameters(const Scene& scene) {
  std::set<std::string> used;
  if (scene.fit.tied.empty()) return check_use(scene, used);
  std::set<std::string> photos = {""};
  for (const TiedParameter& tied : scene.fit.tied) {
    if (const auto complaint = photo_complaint(scene, tied.photo))
      throw scene_error(*complaint, {scene.file, tied.line, tied.path});
    check_path(scene, tied);
    photos.insert(tied.photo);
  }
  for (const FreeParameter& free : scene.fit.free) photos.insert(free.photo);
  for (const std::string& photo : photos) {
    for (const Tie& tie : ties_of(scene, photo))
      for (const Tie::Input& input : tie.inputs)
        if (input.path.row == nullptr) used.insert(input.name);
    check_values(scene, photo);
  }
  check_use(scene, used);
}

}  // namespace vegard::sim
