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

/// In Markdown a bar ends a cell and "<name>" would be a tag.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|')
      escaped += "\\|";
    else if (c == '<')
      escaped += "&lt;";
    else
      escaped += c;
  }
  return escaped;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string scale_word(const sim::ParameterRow& row) {
  if (!row.can_be_free) return "";
  switch (row.scale) {
    case sim::ParameterScale::linear:
      return "linear";
    case sim::ParameterScale::logarithmic:
      return "logarithmic";
    case sim::ParameterScale::angle:
      return "angle";
  }
  return "";
}

/// "a" or "b" or "c": "a", "b", "c".
std::string with_commas(std::string text) {
  const std::string either = "\" or \"";
  for (std::size_t at = text.find(either); at != std::string::npos; at = text.find(either, at))
    text.replace(at, either.size(), "\", \"");
  return text;
}

/// A vector is one line of the page: its components' names, and their defaults together. The unit stands
/// behind the default. Columns that are empty throughout the table are left out.
std::string table_of_page(const std::string& table) {
  std::vector<std::array<std::string, 5>> lines = {{"key", "default", "limits", "free", "meaning"}};
  const auto& rows = sim::parameter_table();
  for (std::size_t i = 0; i < rows.size();) {
    const sim::ParameterRow& row = rows[i];
    std::string names, defaults;
    std::size_t end = i;
    for (; end < rows.size() && rows[end].table == row.table && rows[end].key == row.key; ++end) {
      names += (end > i ? ", " : "") + rows[end].component;
      defaults += (end > i ? ", " : "") + rows[end].default_text;
    }
    i = end;
    if (row.table != table) continue;
    const bool is_fixed_vector = names.find(',') != std::string::npos;
    lines.push_back({is_fixed_vector ? code(row.key) + " (" + names + ")" : code(row.key),
                     code(is_fixed_vector ? "[" + defaults + "]" : defaults) +
                         (row.unit[0] == '\0' ? "" : " " + std::string(row.unit)),
                     cell(with_commas(sim::limits_text(row))), scale_word(row), cell(row.meaning)});
  }
  std::string text = "\n";
  std::array<bool, 5> has_words{};
  for (std::size_t i = 1; i < lines.size(); ++i)
    for (std::size_t c = 0; c < has_words.size(); ++c) has_words[c] = has_words[c] || !lines[i][c].empty();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string under = "|";
    text += "|";
    for (std::size_t c = 0; c < has_words.size(); ++c) {
      if (!has_words[c]) continue;
      text += " " + lines[i][c] + " |";
      under += "---|";
    }
    text += "\n" + (i == 0 ? under + "\n" : "");
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
      "Every key that a scene (a TOML file) can have, by `vegard params --markdown`. Any may be left out and "
      "then\n"
      "has its default. Each section is a table of the file; those in double brackets, `[[sheet]]`, may "
      "occur any\n"
      "number of times. `--set path=value`, `fit.free` and the reports use paths: `camera.width`,\n"
      "`sheet.main.energy_kev` (with the sheet's name, unless there is only one), "
      "`sheet.main.center_km.east` for a\n"
      "component. The unit stands behind the default. *Free* is the scale on which a fit varies a parameter; "
      "others cannot be free. Limits are\n"
      "inclusive. An integer may stand for a number, but `3.0` is not an integer.\n";
  std::string table = "\n";  // no table's name, so that the first row begins a section
  for (const sim::ParameterRow& row : sim::parameter_table()) {
    if (row.table == table) continue;
    table = row.table;
    const std::string title = table == "sheet" ? "`[[sheet]]`" : "`[" + table + "]`";
    text += "\n## " + (table.empty() ? "Top of the file" : title) + "\n" + table_of_page(table);
  }
  text +=
      "\n## Alternative forms\n\n"
      "Keys that only a scene file knows. Those that stand for others never come beside them (and `start_km` "
      "only with\n"
      "`end_km`, `focal_length_mm` only with `sensor_width_mm`); they are turned into them on reading, so "
      "`--set` and\n"
      "written scenes know the others only.\n\n"
      "| key | unit | value | meaning |\n|---|---|---|---|\n";
  for (const sim::FileKey& key : sim::all_file_keys()) {
    text += fmt::format("| {} | {} | {} | {} |\n", code(key_path_of(key)), key.unit, cell(key.type),
                        cell(key.meaning));
  }
  return text;
}

std::string forms_page() {
  std::string text =
      "# Auroral forms\n\n"
      "This page is the output of `vegard params --forms`; a test compares the two.\n\n"
      "`form` in a `[[sheet]]` sets the keys below, and the sheet's other keys override what it sets. `--set "
      "sheet.main.form=drapery`\n"
      "sets them again; a later `--set` of one of them counts. A written scene names the form and every key. "
      "The forms are those of\n"
      "Baranoski et al. 2000, section 2.3 (row B20 of [physics.md](physics.md)), with numbers in its ranges: "
      "arcs and bands 20 to\n"
      "30 km tall between the tenths of their brightest light, rays 1 km wide or less and up to several "
      "hundred tall, folds about 20\n"
      "and curls 2 to 10 km apart. Place, direction, motion and lifetimes are left to the scene; so is the "
      "camera, which alone tells\n"
      "a corona (the band overhead, the camera at the magnetic zenith) from a rayed band.\n\n"
      "A form's light is that of its electrons, whose energies give the source's heights by our own emission "
      "tables. `profile = \"form\"` has the\n"
      "source's measured curve in its place, by `peak_km`, `lower_km` and `upper_km`, which otherwise have "
      "no effect.\n\n"
      "| form | |\n|---|---|\n";
  for (const sim::Form& form : sim::forms()) text += fmt::format("| `{}` | {} |\n", form.name, form.meaning);
  text += "\n| key |";
  std::string rule = "|---|";
  const std::vector<std::pair<std::string, std::string>>& keys = sim::forms().back().values;
  for (const sim::Form& form : sim::forms()) {
    if (form.values.empty()) continue;
    text += " " + form.name + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t k = 0; k < keys.size(); ++k) {
    text += "| `" + keys[k].first + "` |";
    for (const sim::Form& form : sim::forms())
      if (!form.values.empty()) text += " " + form.values[k].second + " |";
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
