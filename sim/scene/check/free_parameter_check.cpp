#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "sim/scene/freedom/expression.h"
#include "sim/scene/freedom/inert_parameter.h"
#include "sim/scene/freedom/ties.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {
namespace {

Origin origin_of(const Scene& scene, const FreeParameter& free) {
  return {scene.file, free.line, free.path.empty() ? free.name : free.path};
}

/// min < max, and the start between them.
void check_order(double start, bool start_is_given, double min, double max, const Origin& origin) {
  if (min >= max)
    throw scene_error({"min " + real_text(min) + " is not below max " + real_text(max), "min < max", ""},
                      origin);
  if (start < min || start > max) {
    throw scene_error(
        {(start_is_given ? "start " : "the scene's value ") + real_text(start) +
             " is not between min and max",
         "min <= start <= max", start_is_given ? "" : "give a start or change the value itself"},
        origin);
  }
}

/// Start, min and max of one scalar. A logarithmic parameter cannot start from or end at 0.
void check_numbers(const Scene& scene, const FreeParameter& free, const ParameterPath& path) {
  const Declaration& d = declaration_of(*path.row);
  const Origin origin{scene.file, free.line, path.text};
  const bool is_logarithmic = scale_of(free, path.row) == ParameterScale::logarithmic;
  const auto check = [&](const char* what, double number) {
    std::optional<Complaint> complaint = number_complaint(d, number);
    if (!complaint && is_logarithmic && number <= 0.0) {
      complaint = Complaint{real_text(number) + " has no logarithm, on whose scale this parameter is fitted",
                            "a number above 0", ""};
    }
    if (!complaint) return;
    complaint->problem = std::string(what) + ": " + complaint->problem;
    throw scene_error(*complaint, origin);
  };
  if (free.min) check("min", *free.min);
  if (free.max) check("max", *free.max);
  const double start = free.start.value_or(*real_value(scene, path));
  check(free.start ? "start" : "start (the scene's value)", start);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  check_order(start, free.start.has_value(), free.min.value_or(-infinite), free.max.value_or(infinite),
              origin);
  if (is_logarithmic && d.scale != ParameterScale::logarithmic && free.min.value_or(d.min) <= 0.0)
    throw scene_error({"a logarithmic scale has no room for the lower limit " + short_real_text(d.min),
                       "a min above 0", ""},
                      origin);
}

/// A number that is no parameter's: nothing but the entry says what it may be.
void check_auxiliary(const Scene& scene, const FreeParameter& free) {
  const Origin origin = origin_of(scene, free);
  for (const FreeNumberKey& key : free_number_keys()) {
    const std::optional<double>& number = free.*key.place;
    if (!number)
      throw scene_error({"a number without a path needs a " + key.key, "start, min and max", ""}, origin);
    if (!std::isfinite(*number))
      throw scene_error({key.key + ": " + real_text(*number) + " is no usable number", "a finite number", ""},
                        origin);
  }
  check_order(*free.start, true, *free.min, *free.max, origin);
  if (scale_of(free, nullptr) == ParameterScale::logarithmic && *free.min <= 0.0)
    throw scene_error({"a logarithmic scale has no room for the lower limit " + short_real_text(*free.min),
                       "a min above 0", ""},
                      origin);
}

bool can_be_a_name(const std::string& name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return is_letter(name.front()) && std::all_of(name.begin(), name.end(), [&](char c) {
           return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
         });
}

void check_name(const Scene& scene, const FreeParameter& free, std::size_t numbers) {
  if (free.name.empty()) return;
  const Origin origin = origin_of(scene, free);
  for (const ParameterPath& path : all_paths(scene))
    if (path.text == free.name)
      throw scene_error({"the name '" + free.name + "' is a parameter's path", "a name of its own", ""},
                        origin);
  const std::vector<std::string>& reserved = Expression::reserved_words();
  if (std::find(reserved.begin(), reserved.end(), free.name) != reserved.end())
    throw scene_error({"the name '" + free.name + "' is a word of expressions", "a name of its own", ""},
                      origin);
  if (!can_be_a_name(free.name))
    throw scene_error({"the name '" + free.name + "' cannot be used in an expression",
                       "a letter, then letters, digits and '_'", ""},
                      origin);
  if (numbers > 1)
    throw scene_error(
        {"the name '" + free.name + "' would be that of " + std::to_string(numbers) + " numbers",
         "a path to one number", "name the components one by one"},
        origin);
}

void check_prior(const Scene& scene, const FreeParameter& free, double lower_limit) {
  if (!free.prior) return;
  const Prior& prior = *free.prior;
  const Origin origin = origin_of(scene, free);
  if (prior.law == PriorLaw::uniform) {
    if (!free.min || !free.max)
      throw scene_error({"prior: nothing says from where to where it is uniform", "min and max as well", ""},
                        origin);
    return;
  }
  if (!std::isfinite(prior.mean)) {
    throw scene_error(
        {"prior: the mean " + real_text(prior.mean) + " is no usable number", "a finite number", ""}, origin);
  }
  if (!(std::isfinite(prior.sigma) && prior.sigma > 0.0)) {
    throw scene_error({"prior: the sigma " + real_text(prior.sigma) + " is no width", "a number above 0", ""},
                      origin);
  }
  if (prior.law != PriorLaw::log_normal) return;
  if (prior.mean <= 0.0)
    throw scene_error(
        {"prior: the mean " + real_text(prior.mean) + " has no logarithm", "a number above 0", ""}, origin);
  if (lower_limit < 0.0)
    throw scene_error(
        {"prior: the number may be negative and has no logarithm there", "a min of 0 or above", ""}, origin);
}

/// A number of one photograph alone.
void check_photo(const Scene& scene, const FreeParameter& free) {
  if (const auto complaint = photo_complaint(scene, free.photo))
    throw scene_error(*complaint, origin_of(scene, free));
}

/// Two entries of one name: the later one has nothing to say beside its path, or the same.
void check_same_number(const Scene& scene, const FreeParameter& first, const FreeParameter& later) {
  const Origin origin = origin_of(scene, later);
  const std::string words = "the name '" + first.name + "'" + in_line(first.line);
  if (first.path.empty() || later.path.empty())
    throw scene_error({words + " is that of another number", "a name of its own for each",
                       "entries of one name are one number if both have a path"},
                      origin);
  const ParameterPath a = paths_of(scene, first).front(), b = paths_of(scene, later).front();
  if (a.row->role == ParameterRole::profile_coefficient || b.row->role == ParameterRole::profile_coefficient)
    throw scene_error(
        {"coefficients of a free-form profile cannot be one number", "a name of its own for each", ""},
        origin);
  if (a.row->unit != b.row->unit)
    throw scene_error({words + " is that of a number in " + (a.row->unit.empty() ? "no unit" : a.row->unit) +
                           ", this one is in " + (b.row->unit.empty() ? "no unit" : b.row->unit),
                       "numbers of one unit", "an expression of fit.tied can turn one into the other"},
                      origin);
  if (scale_of(first, a.row) != scale_of(later, b.row))
    throw scene_error(
        {words + " is that of a number on another scale", "the same scale for both", "set scale in both"},
        origin);
  for (const FreeNumberKey& key : free_number_keys()) {
    const std::optional<double>&of_first = first.*key.place, &of_later = later.*key.place;
    if (of_later && of_later != of_first)
      throw scene_error({key.key + " " + real_text(*of_later) + ", but " + words + " has " +
                             (of_first ? real_text(*of_first) : "none"),
                         "the first entry's", "leave it out here"},
                        origin);
  }
  const auto same = [](const Prior& x, const Prior& y) {
    return x.mean == y.mean && x.sigma == y.sigma && x.law == y.law;
  };
  if (later.prior && !(first.prior && same(*first.prior, *later.prior)))
    throw scene_error({"a prior other than " + words + " has", "the first entry's", "leave it out here"},
                      origin);
  const double start = first.start.value_or(*real_value(scene, a));
  if (auto complaint = number_complaint(declaration_of(*b.row), start)) {
    complaint->problem = "start of '" + first.path + "', which is the same number: " + complaint->problem;
    throw scene_error(*complaint, origin);
  }
}

}  // namespace

std::optional<Complaint> photo_complaint(const Scene& scene, const std::string& photo) {
  if (photo.empty()) return std::nullopt;
  std::vector<std::string> known;
  for (const PhotoEntry& entry : scene.fit.photos) known.push_back(entry.name);
  if (std::find(known.begin(), known.end(), photo) != known.end()) return std::nullopt;
  return Complaint{"no photograph is called '" + photo + "'", "a name of fit.photos",
                   nearest_hint(photo, known)};
}

void check_free_parameters(const Scene& scene) {
  std::map<ParameterId, std::vector<const FreeParameter*>> owners;
  std::map<std::string, const FreeParameter*> named;
  for (const FreeParameter& free : scene.fit.free) {
    const std::vector<ParameterPath> paths = paths_of(scene, free);
    check_name(scene, free, paths.size());
    check_photo(scene, free);
    const auto first = free.name.empty() ? named.end() : named.find(free.name);
    double lower_limit = free.min.value_or(std::numeric_limits<double>::infinity());
    for (const ParameterPath& path : paths) {
      const Origin origin{scene.file, free.line, path.text};
      if (!path.row->can_be_free) {
        throw scene_error({"this parameter cannot be free", "one that `vegard params` lists as free", ""},
                          origin);
      }
      // What one photograph has for itself is looked at in its own scene (check_photos).
      const bool is_shared = free.photo.empty();
      if (is_shared)
        if (const auto inert = inert_parameter_complaint(scene, path)) throw scene_error(*inert, origin);
      for (const FreeParameter* owner : owners[path.id]) {
        if (meet(owner->photo, free.photo))
          throw scene_error({"free twice, first as '" + owner->path + "'" + in_line(owner->line),
                             "each parameter once", ""},
                            origin);
      }
      owners[path.id].push_back(&free);
      if (first == named.end() && is_shared) check_numbers(scene, free, path);
      lower_limit = std::min(lower_limit, free.min.value_or(path.row->min));
    }
    if (first != named.end()) check_same_number(scene, *first->second, free);
    if (paths.empty() && first == named.end()) check_auxiliary(scene, free);
    check_prior(scene, free, lower_limit);
    if (!free.name.empty()) named.emplace(free.name, &free);
  }
}

}  // namespace vegard::sim
