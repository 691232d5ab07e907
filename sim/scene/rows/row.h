// Row: builds a declaration of the parameter table, Row("table", "key", place).in("km").within(0,
// 1).means("…").
//
// For the files of this folder and of sim/scene/emitters/, and for kinds of emitters that a program adds.
#pragma once

#include <algorithm>
#include <any>
#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns a reference to a component of a member: to the member itself if it is a scalar.
template <class T>
ValueRef component_of(T& scalar, int) {
  if constexpr (std::is_enum_v<T>)
    return KindRef(&scalar);
  else
    return &scalar;
}
inline ValueRef component_of(EastNorth& point, int c) { return c == 0 ? &point.east : &point.north; }
inline ValueRef component_of(std::vector<double>& list, int c) { return &list.at(c); }
template <class T, std::size_t n>
ValueRef component_of(std::array<T, n>& array, int c) {
  return &array.at(c);
}

/// Access to the elements, of type Element, of a table that a program has added (Scene::added).
template <class Element>
class AddedElements {
 public:
  explicit AddedElements(std::string table) : table_(std::move(table)) {}

  const std::string& table() const { return table_; }

  const std::vector<Element>& in(const Scene& scene) const {
    static const std::vector<Element> none;
    const auto found = scene.added.find(table_);
    return found == scene.added.end() ? none : std::any_cast<const std::vector<Element>&>(found->second);
  }
  std::vector<Element>& in(Scene& scene) const {
    std::any& slot = scene.added[table_];
    if (!slot.has_value()) slot = std::vector<Element>();
    return std::any_cast<std::vector<Element>&>(slot);
  }

 private:
  std::string table_;
};

/// Returns the description of a repeated table whose elements have a `name`; in(scene) returns their vector.
template <class In>
RepeatedTable repeated_table_in(const std::string& table, const In& in) {
  return {table, [=](const Scene& scene) { return in(scene).size(); },
          [=](const Scene& scene, int element) -> const std::string& { return in(scene).at(element).name; },
          [=](Scene& scene) { in(scene).emplace_back(); },
          [=](Scene& scene, const std::function<bool(const std::string&)>& stays) {
            auto& all = in(scene);
            all.erase(std::remove_if(all.begin(), all.end(),
                                     [&](const auto& element) { return !stays(element.name); }),
                      all.end());
          }};
}

template <class Element>
RepeatedTable repeated_table_of(const std::string& table, std::vector<Element> Scene::*in) {
  return repeated_table_in(
      table, [=](auto& scene) -> auto& { return scene.*in; });
}

template <class Element>
RepeatedTable repeated_table_of(const AddedElements<Element>& added) {
  return repeated_table_in(
      added.table(), [=](auto& scene) -> auto& { return added.in(scene); });
}

/// Returns the component name of a number in a list with one number per emission line: "6300".
inline std::string name_by_line(const Scene& scene, int /*element*/, int index) {
  const auto& lines = scene.emission.lines;
  return index < static_cast<int>(lines.size()) ? line_name(lines[index]) : std::to_string(index);
}

/// Returns the complaint "WHAT, so KEY has no effect" about a free number, with what to do but holding it.
inline Complaint inert(const std::string& what, const std::string& else_do) {
  return {what + ", so {key} has no effect", "a parameter that the light depends on",
          "leave it out of fit.free, or " + else_do};
}

/// Builds a Declaration step by step. Owner is the struct that the value is a member of.
template <class Owner>
class Row {
 public:
  /// A key of the file itself, or of a sheet.
  template <class Value>
  Row(std::string key, Value Owner::*value) {
    if constexpr (std::is_same_v<Owner, Scene>)
      place(
          "", std::move(key), [](auto& scene, int) -> auto& { return scene; }, value);
    else
      place(
          sheet_table, std::move(key), [](auto& scene, int e) -> auto& { return scene.sheets.at(e); }, value);
  }
  template <class Value>
  Row(std::string table, std::string key, Owner Scene::*in, Value Owner::*value) {
    place(
        std::move(table), std::move(key), [=](auto& scene, int) -> auto& { return scene.*in; }, value);
  }
  /// A scalar key; in(scene) returns a reference to it.
  template <class In, class = std::enable_if_t<std::is_invocable_v<In, Scene&>>>
  Row(std::string table, std::string key, const In& in) {
    d_.table = std::move(table);
    d_.key = std::move(key);
    owner_ = [](const Scene& scene, int) -> const Owner& { return scene; };
    d_.at = [=](Scene& scene, int, int c) { return component_of(in(scene), c); };
  }
  /// A key of a repeated table.
  template <class Value>
  Row(std::string table, std::string key, std::vector<Owner> Scene::*in, Value Owner::*value) {
    place(
        std::move(table), std::move(key), [=](auto& scene, int e) -> auto& { return (scene.*in).at(e); },
        value);
  }
  template <class Value>
  Row(std::string key, const AddedElements<Owner>& added, Value Owner::*value) {
    place(
        added.table(), std::move(key), [=](auto& scene, int e) -> auto& { return added.in(scene).at(e); },
        value);
  }

  Row& means(std::string meaning) { return d_.meaning = std::move(meaning), *this; }
  Row& in(std::string unit) { return d_.unit = std::move(unit), *this; }
  Row& from(double min) { return d_.min = min, *this; }
  Row& within(double min, double max) { return d_.min = min, d_.max = max, *this; }
  Row& one_of(std::vector<std::string> choices) { return d_.choices = std::move(choices), *this; }
  /// Sets the words of an enumeration. They are defined nowhere else.
  template <class Kind>
  Row& one_of(std::initializer_list<std::pair<const char*, Kind>> words) {
    d_.kind_type = &typeid(Kind);
    for (const auto& [word, kind] : words) {
      d_.choices.emplace_back(word);
      d_.numbers.push_back(static_cast<int>(kind));
    }
    return *this;
  }
  Row& of(std::vector<std::string> components) { return d_.components = std::move(components), *this; }
  Row& may_be_free(ParameterScale scale) { return d_.scale = scale, d_.can_be_free = true, *this; }
  Row& as(ParameterRole role) { return d_.role = role, *this; }
  Row& called(std::string noun) { return d_.noun = std::move(noun), *this; }
  Row& rule(std::optional<Complaint> (*check)(double)) { return d_.number_rule = check, *this; }
  Row& rule(std::optional<Complaint> (*check)(const std::string&)) { return d_.text_rule = check, *this; }
  Row& list_rule(std::optional<Complaint> (*check)(const Scene&, const std::vector<double>&)) {
    return d_.list_rule = check, *this;
  }
  Row& set_by(void (*set)(Scene&, const std::vector<double>&)) {
    d_.set_list = [=](Scene& scene, int, const std::vector<double>& list) { set(scene, list); };
    return *this;
  }
  Row& of_all_photos(std::string else_do = "set it in [fit]") {
    return d_.of_all_photos = std::move(else_do), *this;
  }
  Row& stands_still(std::string why) { return d_.stands_still = std::move(why), *this; }
  Row& names_table() { return d_.names_table = true, *this; }
  Row& presets(const std::vector<KeyAndText>& (*values)(const std::string&)) {
    return d_.presets = values, *this;
  }
  Row& names_folder() { return d_.names_folder = true, *this; }
  Row& names_file() { return d_.names_file = true, *this; }
  Row& then(void (*follow)(Scene&, int)) { return d_.then = follow, *this; }
  Row& named_by(std::string (*name)(const Scene&, int sheet, int component)) {
    return d_.list_component = name, *this;
  }

  /// A list whose components are named by their index.
  Row& numbered() {
    return of({"<n>"}).named_by([](const Scene&, int, int index) { return std::to_string(index); });
  }
  /// A list with a number for each emission line.
  Row& by_line() {
    return by_line("<line>", name_by_line, [](const Scene&, int) { return 1; });
  }
  /// A list with several numbers for each line; `component` is the placeholder of their names.
  Row& by_line(std::string component, std::string (*name)(const Scene&, int element, int component_index),
               int (*numbers)(const Scene&, int element)) {
    d_.numbers_per_line = numbers;
    return of({std::move(component)}).named_by(name);
  }

  /// Say when the number has no effect (see InertRule). A condition is asked, and a rule called, with the
  /// owner and, if it takes them, the scene and the path of the number; a rule returns
  /// std::optional<Complaint>.
  template <class Rule>
  Row& inert_if(const Rule& rule) {
    return add(InertUse::always, rule);
  }
  template <class Condition>
  Row& inert_if(const Condition& holds, const Complaint& words) {
    return add(InertUse::always, holds, words);
  }
  template <class Condition>
  Row& inert_if(const Condition& holds, const std::string& what, const std::string& else_do) {
    return add(InertUse::always, holds, inert(what, else_do));
  }
  template <class Rule>
  Row& not_free_if(const Rule& rule) {
    return add(InertUse::if_free, rule);
  }
  template <class Condition>
  Row& not_free_if(const Condition& holds, const Complaint& words) {
    return add(InertUse::if_free, holds, words);
  }
  template <class Condition>
  Row& none_free_if(const Condition& holds, const Complaint& words) {
    return add(InertUse::if_free_alone, holds, words);
  }
  template <class Condition>
  Row& noted_if(const Condition& holds, const std::string& problem) {
    return add(InertUse::if_set, holds, {problem, "", ""});
  }

  operator Declaration() const { return d_; }

 private:
  template <class In, class Value>
  void place(std::string table, std::string key, const In& in, Value Owner::*value) {
    d_.table = std::move(table);
    d_.key = std::move(key);
    owner_ = [=](const Scene& scene, int e) -> const Owner& { return in(scene, e); };
    d_.at = [=](Scene& scene, int e, int c) { return component_of(in(scene, e).*value, c); };
    if constexpr (std::is_same_v<Value, std::vector<double>>) {
      d_.list = [=](const Scene& scene, int e) -> const std::vector<double>& { return in(scene, e).*value; };
      d_.set_list = [=](Scene& scene, int e, const std::vector<double>& list) { in(scene, e).*value = list; };
    }
  }

  template <class Asked>
  static auto ask(const Asked& asked, const Owner& owner, const Scene& scene, const ParameterPath& path) {
    if constexpr (std::is_invocable_v<Asked, const Owner&>)
      return asked(owner);
    else if constexpr (std::is_invocable_v<Asked, const Owner&, const Scene&>)
      return asked(owner, scene);
    else
      return asked(owner, scene, path);
  }

  template <class Rule>
  Row& add(InertUse use, const Rule& rule) {
    d_.inert_rules.push_back({use, [rule, owner = owner_](const Scene& scene, const ParameterPath& path) {
                                return ask(rule, owner(scene, path.element), scene, path);
                              }});
    return *this;
  }
  template <class Condition>
  Row& add(InertUse use, const Condition& holds, const Complaint& words) {
    return add(use, [=](const Owner& owner, const Scene& scene, const ParameterPath& path) {
      return ask(holds, owner, scene, path) ? std::optional<Complaint>(words) : std::nullopt;
    });
  }

  std::function<const Owner&(const Scene&, int element)> owner_;
  Declaration d_;
};

template <class In, class = std::enable_if_t<std::is_invocable_v<In, Scene&>>>
Row(std::string table, std::string key, const In& in) -> Row<Scene>;

// The rows before those of emitters.
std::vector<Declaration> place_rows();
std::vector<Declaration> sheet_rows();

// The rows after those of emitters.
std::vector<Declaration> march_rows();
std::vector<Declaration> own_line_rows();
std::vector<Declaration> light_rows();
std::vector<Declaration> sensor_rows();
std::vector<Declaration> sky_rows();
std::vector<Declaration> night_sky_rows();
std::vector<Declaration> time_rows();
std::vector<Declaration> fit_rows();

}  // namespace vegard::sim
