#include <algorithm>
#include <cmath>
#include <map>

#include <toml++/toml.h>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/picture/picture_signature.h"
#include "sim/scene/file/closing_line.h"
#include "sim/scene/file/curve_table.h"
#include "sim/scene/file/fit_entries_toml.h"
#include "sim/scene/file/keyframes_toml.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/table/alternative_forms.h"
#include "sim/scene/table/bounded_toml.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/keyframe_keys.h"
#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/table_files.h"
#include "sim/scene/table/toml_value.h"

namespace vegard::sim {
namespace {

/// Keys that a table knows, in the order of the declarations. The file itself is the table "".
std::vector<std::string> known_keys(const std::string& table) {
  std::vector<std::string> keys;
  for (const Declaration& d : declarations()) {
    if (d.table == table) keys.push_back(d.key);
  }
  for (const FileKey& key : all_file_keys()) {
    if (key.table == table) keys.push_back(key.key);
  }
  return keys;
}

std::vector<std::string> known_tables() {
  std::vector<std::string> tables;
  for (const Declaration& d : declarations()) {
    if (!d.table.empty() && (tables.empty() || tables.back() != d.table)) tables.push_back(d.table);
  }
  return tables;
}

/// That of an element to which nobody gave one.
std::string default_name(const RepeatedTable& repeated) {
  Scene scene;
  repeated.append(scene);
  return repeated.name(scene, 0);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string title(const std::string& table) {
  if (table.empty()) return "the top of the file";
  return repeated_table(table) != nullptr ? "[[" + table + "]]" : "[" + table + "]";
}

/// Names the table where such a key lives, or the nearest key of this table, or a much nearer one elsewhere.
std::string hint_for_key(const std::string& table, const std::string& key) {
  std::vector<std::string> tables = known_tables();
  tables.insert(tables.begin(), "");
  for (const std::string& other : tables) {
    if (other != table && contains(known_keys(other), key)) return "'" + key + "' belongs to " + title(other);
  }
  std::vector<std::string> here = known_keys(table);
  if (table.empty()) here.insert(here.end(), tables.begin() + 1, tables.end());
  if (is_near(key, nearest_name(key, here))) return nearest_hint(key, here);
  for (const std::string& other : tables) {
    const std::string nearest = nearest_name(key, known_keys(other));
    if (is_near(key, nearest)) return "did you mean '" + nearest + "' of " + title(other) + "?";
  }
  return nearest_hint(key, here);
}

/// Reads one document. Lines of keys are kept for what only shows later.
class SceneReader {
 public:
  /// `reads_files`: the curves that sheets take from tables beside the scene's file.
  SceneReader(Scene& scene, const toml::table& document, bool reads_files)
      : scene_(scene), document_(document), reads_files_(reads_files) {}

  void read() {
    refuse_unknown_keys("", document_, known_tables());
    read_table("", -1, &document_);
    for (const std::string& table : known_tables()) {
      if (const RepeatedTable* repeated = repeated_table(table)) {
        read_repeated(*repeated);
      } else {
        read_table(table, -1, table_of(table));
      }
    }
    fill_spline_rates(scene_);
    if (const toml::node* keys = document_.get(key_table)) scene_.keys = read_keyframes(*keys, scene_.file);
    check_whole();
  }

 private:
  Origin origin(const toml::node& node, const std::string& key) const {
    return {scene_.file, line_of(node), key};
  }

  /// The first unknown key of the file's order; toml++ keeps a table sorted by name.
  void refuse_unknown_keys(const std::string& table, const toml::table& values,
                           const std::vector<std::string>& also_known = {}) const {
    const std::vector<std::string> known = known_keys(table);
    const toml::key* first = nullptr;
    for (const auto& [key, node] : values) {
      const std::string name(key.str());
      if (contains(known, name) || contains(also_known, name)) continue;
      if (first == nullptr || key.source().begin < first->source().begin) first = &key;
    }
    if (first == nullptr) return;
    const std::string name(first->str());
    const std::string what =
        values.get(name)->is_table() || values.get(name)->is_array_of_tables() ? "table" : "key";
    throw scene_error({"unknown " + what + " '" + name + "'", "", hint_for_key(table, name)},
                      {scene_.file, static_cast<int>(first->source().begin.line),
                       table.empty() ? name : table + "." + name});
  }

  const toml::table* table_of(const std::string& name) const {
    const toml::node* node = document_.get(name);
    if (node == nullptr || node->is_table()) return node == nullptr ? nullptr : node->as_table();
    throw scene_error({"found " + found_text(*node), "one table [" + name + "]", ""}, origin(*node, name));
  }

  void read_repeated(const RepeatedTable& repeated) {
    const std::string& name = repeated.table;
    const toml::node* node = document_.get(name);
    if (node == nullptr) return;
    const std::string expected = "an array of tables [[" + name + "]]";
    const toml::array* elements = node->as_array();
    if (elements == nullptr) {
      throw scene_error(
          {"found " + found_text(*node), expected, node->is_table() ? "write [[" + name + "]]" : ""},
          origin(*node, name));
    }
    // What stands in the file goes before what the body has brought along.
    repeated.keep(scene_, [](const std::string&) { return false; });
    std::map<std::string, int> line_of_name;
    for (const toml::node& element : *elements) {
      const toml::table* values = element.as_table();
      if (values == nullptr)
        throw scene_error({"found " + found_text(element), expected, ""}, origin(element, name));
      repeated.append(scene_);
      const int index = static_cast<int>(repeated.count(scene_)) - 1;
      read_table(name, index, values);
      const std::string& own_name = repeated.name(scene_, index);
      element_lines_.emplace(name + "." + own_name, line_of(element));
      const auto [earlier, is_new] = line_of_name.emplace(own_name, line_of(element));
      if (!is_new) {
        throw scene_error({"two of [[" + name + "]] are called '" + own_name + "', the first in line " +
                               std::to_string(earlier->second),
                           "a name of its own for each " + name,
                           "without a name one is called '" + default_name(repeated) + "'"},
                          origin(element, name));
      }
    }
  }

  void read_table(const std::string& table, int element, const toml::table* values) {
    if (values == nullptr) return;
    if (!table.empty()) refuse_unknown_keys(table, *values);
    for (const Declaration& d : declarations()) {
      const toml::node* node = d.table == table ? values->get(d.key) : nullptr;
      if (node == nullptr) continue;
      const Origin where = origin(*node, key_path(d, scene_, element));
      assign_key(scene_, d, element, *node, where);
      scene_.lines[key_path(d, scene_, element)] = where.line;
    }
    for (const AlternativeForm& form : alternative_forms()) {
      if (form.keys.front().table == table) read_form(form, element, *values);
    }
    if (table == sheet_table) read_curve(*values, element);
    if (table == free_table) {
      const toml::node* free = values->get(free_key);
      if (free != nullptr) {
        scene_.fit.free =
            read_free_parameters(*free, origin(*free, std::string(free_table) + "." + free_key));
      }
      if (const toml::node* tied = values->get(tied_key))
        scene_.fit.tied =
            read_tied_parameters(*tied, origin(*tied, std::string(free_table) + "." + tied_key));
      if (const toml::node* photos = values->get(photo_key)) {
        scene_.fit.photos =
            read_photo_entries(*photos, origin(*photos, std::string(free_table) + "." + photo_key));
      }
      if (const toml::node* radars = values->get(radar_key))
        scene_.fit.radars =
            read_radar_entries(*radars, origin(*radars, std::string(free_table) + "." + radar_key));
    }
  }

  /// The curve of a sheet that stands in a table.
  void read_curve(const toml::table& values, int sheet) {
    const std::string path = key_path(*find_declaration(sheet_table, "course"), scene_, sheet);
    const std::string whole = path.substr(0, path.rfind('.') + 1);
    const toml::node *file = values.get(curve_file_key), *number = values.get(curve_number_key);
    if (number != nullptr && file == nullptr)
      throw scene_error({"curve needs curve_file beside it", "both or neither", ""},
                        origin(*number, whole + curve_number_key));
    if (file == nullptr) return;
    const Origin where = origin(*file, whole + curve_file_key);
    const std::string name = text_of(*file, where, "a text");
    for (const char* key :
         {"east_km", "north_km", "point_brightness", "point_energy_kev", "point_width_km"}) {
      if (values.get(key) != nullptr)
        throw scene_error({std::string(curve_file_key) + " and " + key + " say the same in two ways",
                           "one of the two forms", "curve_file has all numbers of the curve's points"},
                          where);
      scene_.lines[whole + key] = where.line;
    }
    if (values.get("course") != nullptr && scene_.sheets.at(sheet).course != SheetCourse::curve)
      throw scene_error(
          {"the sheet's course is a sine, which takes nothing from curve_file", "course = \"curve\"", ""},
          where);
    double curtain = 1.0;
    if (number != nullptr) {
      const std::string expected = "a whole number from 1";
      const Origin at = origin(*number, whole + curve_number_key);
      curtain = number_of(*number, at, expected);
      if (!(curtain >= 1.0 && curtain <= 1e9) || curtain != std::floor(curtain))
        throw scene_error({found_text(*number) + " is none", expected, ""}, at);
    }
    if (!reads_files_)
      throw scene_error({"the scene has no file, in whose folder '" + name + "' could be",
                         "east_km and north_km of the curve's points", ""},
                        where);
    const std::string place = table_place(scene_, name);
    const InputFile input = read_input(place);
    if (!input.problem.empty())
      throw unreadable(where.file, "'" + place + "': " + input.problem)
          .line(where.line)
          .key(where.key)
          .expected("a CSV file")
          .hint("its name is relative to the scene's file");
    try {
      const bool keeps_flux = values.get("energy_flux_mw_m2") != nullptr;
      take_curtain(input.bytes, place, static_cast<int>(curtain), keeps_flux, scene_.sheets.at(sheet));
    } catch (const Error& error) {
      throw Error(error).kind(ErrorKind::unreadable_input).key(where.key);
    }
  }

  void read_form(const AlternativeForm& form, int sheet, const toml::table& values) {
    const FileKey *given = nullptr, *missing = nullptr;
    for (const FileKey& key : form.keys) (values.get(key.key) != nullptr ? given : missing) = &key;
    if (given == nullptr) return;
    const Origin where = origin(*values.get(given->key), given->table + "." + given->key);
    if (missing != nullptr) {
      throw scene_error({given->key + " needs " + missing->key + " beside it", "both or neither", ""}, where);
    }
    for (const std::string& key : form.replaces) {
      if (values.get(key) == nullptr) continue;
      throw scene_error(
          {given->key + " and " + key + " say the same in two ways", "one of the two forms", form.words()},
          where);
    }
    std::vector<std::vector<double>> numbers;
    for (const FileKey& key : form.keys) numbers.push_back(read_form_key(form, key, *values.get(key.key)));
    if (const auto complaint = form.convert(scene_, sheet, numbers)) throw scene_error(*complaint, where);
    for (const std::string& key : form.replaces) {
      const Declaration& d = *find_declaration(given->table, key);
      scene_.lines[key_path(d, scene_, sheet)] = where.line;
    }
  }

  std::vector<double> read_form_key(const AlternativeForm& form, const FileKey& key,
                                    const toml::node& node) const {
    const Origin where = origin(node, key.table + "." + key.key);
    std::vector<double> numbers = form.components.empty()
                                      ? std::vector<double>{number_of(node, where, key.type)}
                                      : numbers_of(node, form.components.size(), where, key.type);
    for (const double number : numbers) {
      if (number >= form.min && number <= form.max) continue;
      throw scene_error({short_real_text(number) + " is outside the limits",
                         key.type + " from " + short_real_text(form.min) + " to " +
                             short_real_text(form.max) + (key.unit.empty() ? "" : " (" + key.unit + ")"),
                         ""},
                        where);
    }
    return numbers;
  }

  /// What only the whole scene shows, with the line of the key that it names.
  void check_whole() const {
    try {
      validate(scene_);
    } catch (const Error& error) {
      int line = error.details().line;
      if (line == 0) line = line_of(scene_, error.details().key);
      if (line == 0) line = line_of_element(error.details().key);
      throw Error(error).line(line);
    }
  }

  /// Of the element that a path such as "footprint.arc.image" belongs to; 0 if to none.
  int line_of_element(const std::string& path) const {
    const auto found = element_lines_.find(path.substr(0, path.rfind('.')));
    return found == element_lines_.end() ? 0 : found->second;
  }

  Scene& scene_;
  const toml::table& document_;
  bool reads_files_;
  std::map<std::string, int> element_lines_;  ///< by "footprint.arc"
};

}  // namespace

namespace {

Scene scene_of_text(const std::string& text, const std::string& name, bool reads_files) {
  Scene scene;
  scene.file = name;
  try {
    const toml::table document = parse_toml(text, name);
    if (lacks_closing_line(text))
      throw Error(ErrorKind::scene, "the file was cut: its last line is missing")
          .file(name)
          .expected("\"# end\" at its end, as its head says")
          .hint("copy it again; if you have cut it yourself, take that sentence out of its head");
    SceneReader(scene, document, reads_files).read();
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::scene, std::string(error.description()))
        .file(name)
        .line(static_cast<int>(error.source().begin.line))
        .expected("a TOML file");
  }
  return scene;
}

/// What is given in the place of a scene is often the photograph itself, of which TOML says nothing helpful.
void refuse_picture(const std::string& file) {
  const std::string format = picture_format_of(read_beginning(file, kSignatureBytes).bytes);
  if (format.empty()) return;
  throw Error(ErrorKind::scene, "this is a picture (" + format + "), not a scene")
      .file(file)
      .expected("a scene file (TOML)")
      .hint("'vegard measure " + file + "' takes a photograph alone; 'vegard describe " + file +
            " -o scene.toml' begins a scene of it");
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name) {
  return scene_of_text(text, name, false);
}

Scene read_scene(const std::string& file) {
  refuse_picture(file);
  Scene scene = scene_of_text(input_bytes(file, "a scene file", kMaxTomlBytes), file, true);
  read_table_files(scene);
  return scene;
}

}  // namespace vegard::sim
