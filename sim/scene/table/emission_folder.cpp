#include "sim/scene/table/emission_folder.h"

#include <array>
#include <filesystem>
#include <mutex>
#include <system_error>

#include "sim/base/data_folders.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::sim {
namespace {

const std::string kTablesKey = "emission.tables";

/// A name that a scene may give, and its folder in data/.
struct BuiltIn {
  const char* name;
  const char* folder;
};
constexpr std::array<BuiltIn, 2> kBuiltIn = {{{"glow", "glow"}, {"vegard", "emission"}}};

constexpr std::array<const char*, 4> kRequired = {kMaxwellianFile, kColumnsFile, kFluxesFile, kTablesAirFile};
constexpr std::array<const char*, 3> kOptional = {kMonoFile, kModesFile, kAboutFile};

const BuiltIn* find_built_in(const std::string& name) {
  for (const BuiltIn& one : kBuiltIn)
    if (name == one.name) return &one;
  return nullptr;
}

Error about_tables(const std::string& problem) {
  return Error(ErrorKind::unreadable_input, problem).key(kTablesKey);
}

/// The files that are compiled in; none if they are not.
TableFolder embedded_folder(const BuiltIn& built_in) {
  TableFolder folder;
  folder.place = std::string("the built-in tables ") + built_in.name;
  const auto take = [&](const char* file) {
    const std::string_view text = embedded_table(std::string(built_in.folder) + "/" + file);
    if (!text.empty()) folder.files[file] = text;
  };
  for (const char* file : kRequired) take(file);
  for (const char* file : kOptional) take(file);
  return folder;
}

TableFolder folder_at(const std::string& place) {
  TableFolder folder;
  folder.place = place;
  std::error_code error;
  if (!std::filesystem::is_directory(place, error))
    throw about_tables("'" + place + "': there is no such folder")
        .expected("a folder of emission tables, \"glow\" or \"vegard\"")
        .hint("its name is relative to the scene's file");
  const auto take = [&](const char* name, bool required) {
    const std::string file = (std::filesystem::path(place) / name).string();
    if (!required && !std::filesystem::exists(file, error)) return;
    InputFile input = read_input(file);
    if (!input.problem.empty()) {
      std::string expected = "a folder with ";
      for (const char* each : kRequired)
        expected += std::string(each == kRequired.front() ? "" : ", ") + each;
      throw about_tables("'" + file + "': " + input.problem).expected(expected);
    }
    folder.files[name] = std::move(input.bytes);
  };
  for (const char* file : kRequired) take(file, true);
  for (const char* file : kOptional) take(file, false);
  return folder;
}

/// The one of this content and place. They stay for good: there are as many as a process names folders.
std::shared_ptr<const TableFolder> the_one(TableFolder folder) {
  static std::mutex mutex;
  static std::vector<std::shared_ptr<const TableFolder>> known;
  const std::lock_guard<std::mutex> lock(mutex);
  for (const auto& one : known)
    if (one->place == folder.place && one->files == folder.files) return one;
  known.push_back(std::make_shared<const TableFolder>(std::move(folder)));
  return known.back();
}

std::shared_ptr<const TableFolder> find_built_in_tables(const BuiltIn& built_in) {
  TableFolder embedded = embedded_folder(built_in);
  if (!embedded.files.empty()) return the_one(std::move(embedded));
  const std::string file = find_data_file(std::string(built_in.folder) + "/" + kMaxwellianFile);
  if (!file.empty()) return the_one(folder_at(std::filesystem::path(file).parent_path().string()));
  std::string problem = std::string("the tables \"") + built_in.name + "\" are not here: no ";
  bool first = true;
  for (const std::string& folder : data_folders()) {
    problem += (first ? "" : ", no ") + (std::filesystem::path(folder) / built_in.folder).string();
    first = false;
  }
  throw about_tables(problem).hint("VEGARD_DATA may name the folder that has " +
                                   std::string(built_in.folder) + "/ in it");
}

}  // namespace

std::string emission_file_path(const std::string& file) { return kTablesKey + "/" + file; }

bool are_built_in_tables(const std::string& name) { return find_built_in(name) != nullptr; }

std::shared_ptr<const TableFolder> built_in_tables(const std::string& name) {
  const BuiltIn* built_in = find_built_in(name);
  if (built_in == nullptr)
    throw about_tables("'" + name + "' is a folder that was not read").hint("read_table_files() reads it");
  static std::mutex mutex;
  static std::map<const BuiltIn*, std::shared_ptr<const TableFolder>> found;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<const TableFolder>& folder = found[built_in];
  if (!folder) folder = find_built_in_tables(*built_in);
  return folder;
}

void read_emission_folder(Scene& scene, const std::string& place) {
  const std::string& name = scene.emission.tables;
  try {
    if (are_built_in_tables(name)) {
      scene.emission.folder.reset();
      built_in_tables(name);  // or throws
      return;
    }
    if (!scene.emission.folder || scene.emission.folder->place != place)
      scene.emission.folder = the_one(folder_at(place));
  } catch (const Error& error) {
    throw Error(error).file(scene.file).line(line_of(scene, error.details().key));
  }
}

}  // namespace vegard::sim
