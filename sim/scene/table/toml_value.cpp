#include "sim/scene/table/toml_value.h"

#include <algorithm>
#include <cstdint>

#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {
namespace {

/// A line of its own if the node has one: elements of a long array.
Origin at_node(const Origin& origin, const toml::node& node) {
  return {origin.file, origin.line > 0 && line_of(node) > 0 ? line_of(node) : origin.line, origin.key};
}

Error wrong_type(const toml::node& node, const Origin& origin, const std::string& expected,
                 const std::string& hint = {}) {
  return scene_error({"found " + found_text(node), expected, hint}, at_node(origin, node));
}

std::int64_t integer_of(const toml::node& node, const Origin& origin, const std::string& expected) {
  if (const auto value = node.value_exact<std::int64_t>()) return *value;
  throw wrong_type(node, origin, expected);
}

struct Assign {
  const Declaration& d;
  const toml::node& node;
  const Origin& origin;

  void operator()(double* place) const {
    const double number = number_of(node, origin, expected_text(d));
    check(number_complaint(d, number));
    *place = number;
  }
  void operator()(int* place) const { *place = static_cast<int>(checked_integer()); }
  void operator()(std::uint64_t* place) const { *place = static_cast<std::uint64_t>(checked_integer()); }
  void operator()(bool* place) const {
    const auto value = node.value_exact<bool>();
    if (!value) throw wrong_type(node, origin, expected_text(d));
    *place = *value;
  }
  void operator()(std::string* place) const {
    const std::string text = text_of(node, origin, expected_text(d));
    check(text_complaint(d, text));
    *place = text;
  }
  void operator()(const KindRef& place) const {
    const std::string word = text_of(node, origin, expected_text(d));
    check(text_complaint(d, word));
    const auto choice = std::find(d.choices.begin(), d.choices.end(), word) - d.choices.begin();
    place.set(d.numbers.at(static_cast<std::size_t>(choice)));
  }

 private:
  /// The limits of every integer parameter lie inside those of its type.
  std::int64_t checked_integer() const {
    const std::int64_t integer = integer_of(node, origin, expected_text(d));
    check(number_complaint(d, static_cast<double>(integer)));
    return integer;
  }
  void check(const std::optional<Complaint>& complaint) const {
    if (complaint) throw scene_error(*complaint, at_node(origin, node));
  }
};

std::string expected_vector(const Declaration& d) {
  if (d.list) return "an array, each element " + expected_text(d);
  std::string names;
  for (const std::string& name : d.components) names += (names.empty() ? "" : ", ") + name;
  return "an array of " + std::to_string(d.components.size()) + " (" + names + "), each " + expected_text(d);
}

const toml::array& array_of(const toml::node& node, std::optional<std::size_t> count, const Origin& origin,
                            const std::string& expected) {
  const toml::array* array = node.as_array();
  if (array == nullptr || (count && array->size() != *count)) throw wrong_type(node, origin, expected);
  return *array;
}

void set_list(Scene& scene, const Declaration& d, int sheet, const std::vector<double>& list,
              const toml::array* nodes, const Origin& origin) {
  if (d.list_rule) {
    if (const auto complaint = d.list_rule(scene, list)) {
      const bool at_one = nodes != nullptr && complaint->element >= 0;
      throw scene_error(
          *complaint,
          at_one ? at_node(origin, (*nodes)[static_cast<std::size_t>(complaint->element)]) : origin);
    }
  }
  d.set_list(scene, sheet, list);
}

void assign_list(Scene& scene, const Declaration& d, int sheet, const toml::node& node,
                 const Origin& origin) {
  std::vector<double> list;
  const toml::array& nodes = array_of(node, std::nullopt, origin, expected_vector(d));
  for (const toml::node& element : nodes) {
    const double number = number_of(element, origin, expected_text(d));
    if (const auto complaint = number_complaint(d, number))
      throw scene_error(*complaint, at_node(origin, element));
    list.push_back(number);
  }
  set_list(scene, d, sheet, list, &nodes, origin);
}

/// Of a form: what the table says of other keys of the same element.
void assign_presets(Scene& scene, const Declaration& d, int sheet) {
  for (const auto& [key, text] : d.presets(*std::get<std::string*>(d.at(scene, sheet, 0)))) {
    const toml::table table = toml::parse("value = " + text);
    assign_key(scene, *find_declaration(d.table, key), sheet, *table.get("value"), {"", 0, key});
  }
}

}  // namespace

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

std::string found_text(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string: {
      const std::string text = **node.as_string();
      return "the text " + quoted_text(text.size() > 40 ? text.substr(0, 40) + "..." : text);
    }
    case toml::node_type::integer:
      return "the whole number " + std::to_string(**node.as_integer());
    case toml::node_type::floating_point:
      return "the number " + real_text(**node.as_floating_point());
    case toml::node_type::boolean:
      return **node.as_boolean() ? "true" : "false";
    case toml::node_type::date:
    case toml::node_type::time:
    case toml::node_type::date_time:
      return "a date or time without quotes";
    case toml::node_type::array:
      return "an array of " + std::to_string(node.as_array()->size());
    case toml::node_type::table:
      return "a table";
    case toml::node_type::none:
      break;
  }
  return "nothing";
}

double number_of(const toml::node& node, const Origin& origin, const std::string& expected) {
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  if (const auto* real = node.as_floating_point()) return real->get();
  throw wrong_type(node, origin, expected);
}

std::string text_of(const toml::node& node, const Origin& origin, const std::string& expected) {
  if (const auto* text = node.as_string()) return text->get();
  throw wrong_type(node, origin, expected, node.is_date() || node.is_date_time() ? "put it in quotes" : "");
}

std::vector<double> numbers_of(const toml::node& node, std::optional<std::size_t> count, const Origin& origin,
                               const std::string& expected) {
  std::vector<double> numbers;
  for (const toml::node& element : array_of(node, count, origin, expected)) {
    numbers.push_back(number_of(element, origin, expected));
  }
  return numbers;
}

void assign_component(Scene& scene, const Declaration& d, int sheet, int component, const toml::node& node,
                      const Origin& origin) {
  if (d.list) {
    // Through the whole list, whose rule may forbid the new component beside the others.
    std::vector<double> list = d.list(scene, sheet);
    std::visit(Assign{d, node, origin}, ValueRef(&list.at(component)));
    set_list(scene, d, sheet, list, nullptr, origin);
    return;
  }
  std::visit(Assign{d, node, origin}, d.at(scene, sheet, component));
  if (d.then != nullptr) d.then(scene, sheet);
  if (d.presets != nullptr) assign_presets(scene, d, sheet);
}

void assign_key(Scene& scene, const Declaration& d, int sheet, const toml::node& node, const Origin& origin) {
  if (d.list) return assign_list(scene, d, sheet, node, origin);
  if (d.components.empty()) return assign_component(scene, d, sheet, 0, node, origin);
  const toml::array& array = array_of(node, d.components.size(), origin, expected_vector(d));
  for (std::size_t c = 0; c < array.size(); ++c) {
    Origin element = origin;
    element.key += "." + d.components[c];
    assign_component(scene, d, sheet, static_cast<int>(c), array[c], element);
  }
}

}  // namespace vegard::sim
