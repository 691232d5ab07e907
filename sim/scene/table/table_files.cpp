#include "sim/scene/table/table_files.h"

#include <filesystem>
#include <set>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/table/emission_folder.h"
#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {
namespace {

template <class Use>
void for_each_table_key(Scene& scene, const Use& use) {
  for (const Declaration& d : declarations()) {
    if (!d.names_table) continue;
    for (int e = 0; e < element_count(d, scene); ++e) {
      std::string& value = *std::get<std::string*>(d.at(scene, e, 0));
      if (!is_table_file(value)) continue;
      // "curve:FILE.csv" of fit.decoding: a word before the name.
      const std::size_t word = value.compare(0, kCurveWord.size(), kCurveWord) == 0 ? kCurveWord.size() : 0;
      std::string name = value.substr(word);
      use(key_path(d, scene, e), name);
      value.replace(word, std::string::npos, name);
    }
  }
}

std::string read_text(const Scene& scene, const TableFile& table) {
  const std::string place = table_place(scene, table.name);
  InputFile file = read_input(place);
  if (!file.problem.empty())
    throw unreadable(scene.file, "'" + place + "': " + file.problem)
        .line(line_of(scene, table.path))
        .key(table.path)
        .expected("a CSV file")
        .hint("its name is relative to the scene's file");
  return std::move(file.bytes);
}

}  // namespace

std::vector<TableFile> table_files(const Scene& scene) {
  std::vector<TableFile> files;
  // Only read through: the accessors take a Scene they could change.
  for_each_table_key(const_cast<Scene&>(scene), [&](const std::string& path, const std::string& name) {
    files.push_back({path, name});
  });
  return files;
}

std::string table_place(const Scene& scene, const std::string& name) {
  return (std::filesystem::path(scene.file).parent_path() / name).string();
}

void read_table_files(Scene& scene) {
  scene.tables.clear();
  for (const TableFile& table : table_files(scene)) scene.tables[table.path] = read_text(scene, table);
  read_emission_folder(scene, table_place(scene, scene.emission.tables));
}

std::vector<std::pair<std::string, std::string>> table_sums(const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> sums;
  for (const auto& [path, text] : scene.tables) sums.emplace_back(path, sha256(text));
  if (scene.emission.folder)
    for (const auto& [file, text] : scene.emission.folder->files)
      sums.emplace_back(emission_file_path(file), sha256(text));
  return sums;
}

const std::string& table_text(const Scene& scene, const std::string& path) { return scene.tables.at(path); }

Scene with_tables_beside(const Scene& scene) {
  Scene moved = scene;
  std::set<std::string> taken;
  for_each_table_key(moved, [&](const std::string& path, std::string& value) {
    std::string name = std::filesystem::path(value).filename().string();
    if (!taken.insert(name).second) {
      name = path + ".csv";
      taken.insert(name);
    }
    value = name;
  });
  return moved;
}

}  // namespace vegard::sim
