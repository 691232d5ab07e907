#include "apps/commands/commands.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/standard_streams.h"
#include "sim/base/text.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/forms.h"
#include "sim/scene/table/alternative_forms.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {
namespace {

constexpr std::size_t columns = 6;
using Line = std::array<std::string, columns>;

/// Characters, not bytes: "mW m⁻²" is six wide.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string aligned(const std::vector<Line>& lines) {
  std::array<std::size_t, columns> widths{};
  for (const Line& line : lines) {
    for (std::size_t c = 0; c < columns; ++c) widths[c] = std::max(widths[c], width_of(line[c]));
  }
  std::string text;
  for (const Line& line : lines) {
    std::string row;
    for (std::size_t c = 0; c < columns; ++c) {
      row += line[c];
      if (c + 1 < columns) row += std::string(widths[c] - width_of(line[c]) + 2, ' ');
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  return text;
}

std::string key_path_of(const sim::FileKey& key) {
  if (key.table.empty()) return key.key;
  if (key.table == "sheet") return "sheet.<name>." + key.key;
  return key.table + "." + key.key;
}

void append_file_keys(std::vector<Line>& lines) {
  lines.push_back({});
  lines.push_back({"in scene files only", "", "unit", "", "", ""});
  for (const sim::FileKey& key : sim::all_file_keys()) {
    lines.push_back({key_path_of(key), "", key.unit, key.type, "", key.meaning});
  }
}

/// In Markdown "<name>" would be a tag.
std::string prose(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '<')
      escaped += "&lt;";
    else
      escaped += c;
  }
  return escaped;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string scale_word(const sim::ParameterRow& row) {
  switch (row.scale) {
    case sim::ParameterScale::linear:
      return "";
    case sim::ParameterScale::logarithmic:
      return "logarithmic";
    case sim::ParameterScale::angle:
      return "angle";
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Numbers alone, `0 to 1` as `0…1`: the default of a switch says that it is one, and choices follow theirs.
std::string limits_of_page(const sim::ParameterRow& row) {
  if (row.kind == sim::ParameterKind::boolean || row.kind == sim::ParameterKind::text) return "";
  return replaced(sim::limits_text(row), " to ", "…");
}

/// `|"b"|"c"` of a choice whose default is "a".
std::string other_choices(const sim::ParameterRow& row) {
  std::string text;
  for (const std::string& choice : row.choices) {
    const std::string word = "\"" + choice + "\"";
    if (word != row.default_text) text += "|" + word;
  }
  return text;
}

/// The unit as the ends of keys have it: "km_s" for "km s⁻¹", "mw_m2" for "mW m⁻²".
std::string unit_in_keys(const std::string& unit) {
  static const std::vector<std::pair<std::string, std::string>> kSpellings = {
      {"⁻¹", ""}, {"⁻²", "2"}, {"⁻³", "3"}, {"²", "2"}, {"³", "3"}, {"µ", "u"}, {" ", "_"}, {"/", "_"}};
  if (unit == "R") return "rayleigh";
  if (unit == "Da") return "dalton";
  if (unit == "kR") return "kilorayleigh";
  std::string text = unit;
  for (const auto& [from, to] : kSpellings) text = replaced(text, from, to);
  return sim::lowered(text);
}

/// The unit, where the key does not end with it.
std::string unit_that_key_lacks(const std::string& key, const std::string& unit) {
  const std::string words = "_" + key, end = "_" + unit_in_keys(unit);
  const bool has_it =
      words.size() >= end.size() && words.compare(words.size() - end.size(), end.size(), end) == 0;
  return has_it ? "" : unit;
}

constexpr const char* kMeaningOfNames = "name in paths";

/// The entries of the page for one table of the scene. A vector is one entry: its components' names, and
/// their defaults together.
std::string entries_of_page(const std::string& table) {
  std::string text = "\n";
  const auto& rows = sim::parameter_table();
  for (std::size_t i = 0; i < rows.size();) {
    const sim::ParameterRow& row = rows[i];
    std::string names, defaults;
    std::size_t end = i;
    for (; end < rows.size() && rows[end].table == row.table && rows[end].key == row.key; ++end) {
      names += (end > i ? ", " : "") + rows[end].component;
      defaults += (end > i ? "," : "") + rows[end].default_text;
    }
    i = end;
    if (row.table != table) continue;
    const bool is_fixed_vector = names.find(',') != std::string::npos;
    std::string entry =
        "- " + code(row.key + "=" + (is_fixed_vector ? "[" + defaults + "]" : defaults) + other_choices(row));
    const std::string unit = unit_that_key_lacks(row.key, row.unit);
    if (!unit.empty()) entry += " " + unit;
    std::string range = limits_of_page(row);
    if (const std::string scale = scale_word(row); row.can_be_free && !scale.empty())
      range =
          row.scale == sim::ParameterScale::angle ? scale : range + ", " + scale;  // its limits mean nothing
    if (is_fixed_vector) range = names + (range.empty() ? "" : "; " + range);
    if (!range.empty()) entry += row.can_be_free ? " [" + prose(range) + "]" : " (" + prose(range) + ")";
    if (row.meaning == std::string(kMeaningOfNames)) {  // the page says it once
      text += entry + "\n";
      continue;
    }
    text += entry + ": " + prose(row.meaning) + "\n";
  }
  return text;
}

enum class ParameterOutput { listing, page, forms };

std::string parameter_listing(const std::string& scene_file) {
  std::vector<Line> lines;
  const auto add = [&](const std::string& path, const std::string& value, const sim::ParameterRow& row,
                       const std::string& free) {
    lines.push_back({path, value, row.unit, sim::limits_text(row), free, row.meaning});
  };
  if (scene_file.empty()) {
    lines.push_back({"path", "default", "unit", "limits", "free", "meaning"});
    for (const sim::ParameterRow& row : sim::parameter_table()) {
      add(sim::path_pattern(row), row.default_text, row, row.can_be_free ? "can be" : "");
    }
  } else {
    const sim::Scene scene = sim::read_scene(scene_file);
    std::set<sim::ParameterId> fitted, tied;
    for (const sim::FreeParameter& free : scene.fit.free) {
      if (free.path.empty()) continue;  // a number of expressions
      for (const sim::ParameterPath& path : sim::resolve(scene, free.path)) fitted.insert(path.id);
    }
    for (const sim::TiedParameter& entry : scene.fit.tied)
      tied.insert(sim::resolve(scene, entry.path).front().id);
    lines.push_back({"path", "value", "unit", "limits", "free", "meaning"});
    for (const sim::ParameterPath& path : sim::all_paths(scene)) {
      const bool is_fitted = fitted.count(path.id) > 0;
      add(path.text, sim::value_text(scene, path), *path.row,
          is_fitted                 ? "yes"
          : tied.count(path.id) > 0 ? "tied"
          : path.row->can_be_free   ? "can be"
                                    : "");
    }
  }
  append_file_keys(lines);
  return aligned(lines);
}

/// The rows of the listing, and what only scene files know.
void answer_listing(const std::string& scene_file) {
  Json rows = Json::array();
  const auto add = [&](const std::string& path, const char* key, const std::string& value,
                       const sim::ParameterRow& row) {
    rows.push_back({{"path", path},
                    {key, value},
                    {"unit", row.unit},
                    {"limits", sim::limits_text(row)},
                    {"can_be_free", row.can_be_free},
                    {"meaning", row.meaning}});
  };
  if (scene_file.empty()) {
    for (const sim::ParameterRow& row : sim::parameter_table())
      add(sim::path_pattern(row), "default", row.default_text, row);
  } else {
    const sim::Scene scene = sim::read_scene(scene_file);
    for (const sim::ParameterPath& path : sim::all_paths(scene))
      add(path.text, "value", sim::value_text(scene, path), *path.row);
  }
  json_answer()["parameters"] = rows;
  Json keys = Json::array();
  for (const sim::FileKey& key : sim::all_file_keys())
    keys.push_back(
        {{"path", key_path_of(key)}, {"unit", key.unit}, {"type", key.type}, {"meaning", key.meaning}});
  json_answer()["in_scene_files_only"] = keys;
}

void answer_forms() {
  Json forms = Json::array();
  for (const sim::Form& form : sim::forms()) {
    Json values = Json::object();
    for (const auto& [key, value] : form.values) values[key] = value;
    forms.push_back({{"name", form.name}, {"meaning", form.meaning}, {"sets", values}});
  }
  json_answer()["forms"] = forms;
}

std::string parameter_page() {
  std::string text =
      "# Parameters\n\n"
      "Every key of a scene (a TOML file), by `vegard params --markdown`: `key=default` (of words the "
      "first), the unit where the key does not end with it, and the limits (inclusive), in [brackets] if "
      "a fit can vary the key, linearly unless they say otherwise. Tables in double brackets may occur "
      "any number of times, each with its `name`. `--set path=value`, `fit.free` and reports use paths: "
      "`camera.width`, `sheet.main.energy_kev` (`main`: the sheet's name, which a single sheet's path "
      "may leave out), `sheet.main.center_km.east`. `3.0` is no integer. Files are relative to the "
      "scene's; azimuths and bearings are from north to the east; an empty text or list is none unless "
      "it says otherwise.\n";
  std::string table = "\n";  // no table's name, so that the first row begins a section
  for (const sim::ParameterRow& row : sim::parameter_table()) {
    if (row.table == table) continue;
    table = row.table;
    const bool is_repeated = sim::path_pattern(row).find("<name>") != std::string::npos;
    const std::string title = is_repeated ? "`[[" + table + "]]`" : "`[" + table + "]`";
    text += "\n## " + (table.empty() ? "Top of the file" : title) + "\n" + entries_of_page(table);
  }
  text +=
      "\n## Alternative forms\n\n"
      "Keys of scene files alone, never beside those that they stand for. "
      "`start_km` needs `end_km`, `focal_length_mm` needs `sensor_width_mm`.\n\n";
  for (const sim::FileKey& key : sim::all_file_keys()) {
    std::string facts = key.type == "a number" || key.type == "a text" ? "" : prose(key.type);
    const std::string unit = unit_that_key_lacks(key.key, key.unit);
    if (!unit.empty()) facts += (facts.empty() ? "" : ", ") + unit;
    text += "- " + code(key_path_of(key)) + (facts.empty() ? "" : " (" + facts + ")") + ": " +
            prose(key.meaning) + "\n";
  }
  return text;
}

/// Whether a form's value is the sheet's default; both are as TOML has them.
bool is_default_of_sheet(const std::string& key, const std::string& value) {
  for (const sim::ParameterRow& row : sim::parameter_table()) {
    if (row.table != std::string("sheet") || row.key != key) continue;
    const std::string& usual = row.default_text;
    if (usual.empty() || usual.front() == '"')
      return usual.size() == value.size() && usual.size() >= 2 &&
             usual.compare(1, usual.size() - 2, value, 1, value.size() - 2) == 0;
    return std::stod(usual) == std::stod(value);
  }
  return false;
}

std::string forms_page() {
  std::string text =
      "# Auroral forms\n\n"
      "What `form` in a `[[sheet]]` sets, by `vegard params --forms`; keys that a form does not name get the "
      "[sheet's default](parameters.md#sheet), and the sheet's other keys override it (`--set "
      "sheet.main.form=drapery` sets them again). The forms are those of Baranoski et al. 2000, section 2.3, "
      "and [STEVE with its picket fence](steve.md). "
      "Place, direction, motion, lifetimes and the camera are left to the scene.\n\n"
      "A form's light is that of its electrons. With `profile = \"form\"` it is the source's measured curve, "
      "by `peak_km`, `lower_km` and `upper_km`.\n\n";
  for (const sim::Form& form : sim::forms()) {
    text += fmt::format("- **{}**: {}.", form.name, form.meaning);
    const auto equal = std::find_if(sim::forms().begin(), sim::forms().end(),
                                    [&](const sim::Form& other) { return other.values == form.values; });
    if (equal->name != form.name) {
      text += fmt::format(" As **{}**.\n", equal->name);
      continue;
    }
    for (const auto& [key, value] : form.values)
      if (!is_default_of_sheet(key, value)) text += fmt::format(" `{}={}`,", key, value);
    if (text.back() == ',') text.back() = '.';
    text += "\n";
  }
  return text;
}

int run_params(const std::string& scene_file, ParameterOutput output) {
  if (output == ParameterOutput::listing) answer_listing(scene_file);
  if (output == ParameterOutput::forms) answer_forms();
  if (output == ParameterOutput::page) answer_listing({});
  say_result(output == ParameterOutput::page    ? parameter_page()
             : output == ParameterOutput::forms ? forms_page()
                                                : parameter_listing(scene_file));
  return good;
}

}  // namespace

void add_params_command(Program& program) {
  struct ParamsRequest {
    std::string scene_file;
    bool as_markdown = false, forms = false;
  };
  const auto options = std::make_shared<ParamsRequest>();
  const Command command =
      program.add("params", "List every parameter: path, unit, default or value, limits, meaning");
  const Option scene = command.option("SCENE", options->scene_file, "Show the values of this scene file");
  const Option page = command.flag("--markdown", options->as_markdown, "Print the documentation page instead")
                          .excludes(scene);
  command.flag("--forms", options->forms, "Print what each auroral form sets, as a documentation page")
      .excludes(scene)
      .excludes(page);
  command.runs([options] {
    return run_params(options->scene_file, options->as_markdown ? ParameterOutput::page
                                           : options->forms     ? ParameterOutput::forms
                                                                : ParameterOutput::listing);
  });
}

}  // namespace vegard::apps
