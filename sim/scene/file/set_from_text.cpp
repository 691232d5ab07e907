#include <string>

#include <toml++/toml.h>

#include "sim/base/error.h"
#include "sim/scene/file/fit_entries_toml.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/bounded_toml.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/toml_value.h"

namespace vegard::sim {
namespace {

/// The text as the value of the one key of a table. A text without quotes is taken as it is.
toml::table parse_value(const std::string& text, bool may_be_word, const std::string& expected,
                        const Origin& origin) {
  if (const auto excess = toml_excess("value = " + text))
    throw scene_error({excess->problem, expected, ""}, origin);
  toml::table table;
  if (may_be_word && text.find_first_of("\"'") != 0) {
    // A word goes into scenes that are written, which have to be read again.
    try {
      return toml::parse("value = " + quoted_text(text));
    } catch (const toml::parse_error&) {
      throw scene_error({"the text cannot be written in a scene file", "UTF-8",
                         "rename the file, if it is the name of one"},
                        origin);
    }
  }
  try {
    table = toml::parse("value = " + text);
  } catch (const toml::parse_error&) {
    table.clear();
  }
  // More than one key: the text held a line break and went on.
  if (table.size() != 1) throw scene_error({"'" + text + "' cannot be understood", expected, ""}, origin);
  return table;
}

void set_free_parameters(Scene& scene, const std::string& text, const Origin& origin) {
  const toml::table table = parse_value(text, false, "an array of paths and tables", origin);
  scene.fit.free = read_free_parameters(*table.get("value"), origin);
}

void set_tied_parameters(Scene& scene, const std::string& text, const Origin& origin) {
  const toml::table table = parse_value(text, false, "an array of tables { path, equals }", origin);
  scene.fit.tied = read_tied_parameters(*table.get("value"), origin);
}

}  // namespace

void set_from_text(Scene& scene, const std::string& path, const std::string& text) {
  // Lines would be those of `text`: the origin has none.
  const Origin origin{"", 0, path};
  if (path == std::string(free_table) + "." + free_key) return set_free_parameters(scene, text, origin);
  if (path == std::string(free_table) + "." + tied_key) return set_tied_parameters(scene, text, origin);

  const ParameterPath first = resolve(scene, path).front();
  const Declaration& d = declaration_of(*first.row);
  const bool is_whole_key = with_only_name(scene, path) == key_path(d, scene, first.element);
  const toml::table table =
      parse_value(text, first.row->kind == ParameterKind::text, expected_text(d), origin);
  const toml::node& value = *table.get("value");
  const auto assign = [&](Scene& target) {
    if (is_whole_key) return assign_key(target, d, first.element, value, origin);
    assign_component(target, d, first.element, first.component, value, origin);
  };
  // First on a copy: a vector whose second component is wrong must not be half set, and the scene itself is
  // not replaced, since others may hold addresses into it.
  const Scene before = scene;
  Scene trial = scene;
  assign(trial);
  assign(scene);
  follow_spline_grid(before, scene);
  scene.lines[key_path(d, scene, first.element)] = 0;  // it was given, but in no line of the file
}

}  // namespace vegard::sim
