#include "apps/options/file_names.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "apps/options/refusals.h"
#include "fit/photo/composite_pictures.h"
#include "fit/photo/frames/frame_name.h"
#include "sim/base/error.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/table/table_files.h"

namespace vegard::apps {
namespace {

std::filesystem::path whole_name(const std::string& name) {
  std::error_code ignored;
  // weakly_canonical() leaves a name relative whose first part does not exist.
  return std::filesystem::weakly_canonical(std::filesystem::absolute(name, ignored), ignored);
}

}  // namespace

std::string file_name_of(const std::string& file) { return std::filesystem::path(file).filename().string(); }

bool same_file(const std::string& name, const std::string& other) {
  if (name.empty() || other.empty()) return false;
  const std::string a = fit::file_of_frame(name), b = fit::file_of_frame(other);
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  return whole_name(a) == whole_name(b) && !whole_name(a).empty();
}

bool is_inside(const std::string& file, const std::string& folder) {
  if (file.empty() || folder.empty()) return false;
  const std::filesystem::path inner = whole_name(fit::file_of_frame(file));
  std::filesystem::path outer = whole_name(folder);
  // A name is empty where a folder on its way may not be looked into, which whoever opens it says.
  if (inner.empty() || outer.empty()) return false;
  if (outer.filename().empty()) outer = outer.parent_path();  // of "run/"
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

sim::Error same_file_error(const std::string& key, const std::string& file, const std::string& other) {
  return usage_error(key, "'" + file + "' is " + other + " as well", "", "choose another name");
}

void protect_outputs(const std::vector<std::pair<std::string, std::string>>& outputs,
                     const std::vector<std::string>& inputs) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    const auto& [key, file] = *output;
    for (const std::string& input : inputs)
      if (same_file(file, input)) throw same_file_error(key, file, "an input");
    for (auto other = outputs.begin(); other != output; ++other)
      if (same_file(file, other->second)) throw same_file_error(key, file, "another output");
  }
}

std::vector<NamedInput> inputs_of_scene(const SceneOptions& options, const sim::Scene& scene) {
  std::vector<NamedInput> inputs = {{options.file, "the scene"}, {options.camera_file, "the camera's file"}};
  for (const std::string& file : fit::picture_files(scene))
    inputs.push_back({file, "a file that the scene reads"});
  for (const sim::TableFile& table : sim::table_files(scene))
    inputs.push_back({sim::table_place(scene, table.name), "a table of the scene"});
  if (scene.emission.folder)
    for (const auto& [file, text] : scene.emission.folder->files)
      inputs.push_back({scene.emission.folder->place + "/" + file, "a table of the scene"});
  for (const sim::PhotoEntry& photo : scene.fit.photos) {
    inputs.push_back({sim::table_place(scene, photo.file), "a photograph"});
    if (!photo.mask.empty()) inputs.push_back({sim::table_place(scene, photo.mask), "a mask"});
    const std::string curve = photo.decoding.empty() ? "" : sim::decoding_word(photo.decoding).file;
    if (!curve.empty()) inputs.push_back({sim::table_place(scene, curve), "a transfer curve"});
  }
  for (const sim::RadarEntry& radar : scene.fit.radars)
    inputs.push_back({sim::table_place(scene, radar.file), "a radar's file"});
  return inputs;
}

void protect_inputs(const std::string& key, const std::string& output,
                    const std::vector<NamedInput>& inputs) {
  for (const NamedInput& input : inputs)
    if (same_file(output, input.file)) throw same_file_error(key, output, input.what);
}

void protect_inputs_inside(const std::string& key, const std::string& folder,
                           const std::vector<NamedInput>& inputs) {
  for (const NamedInput& input : inputs)
    if (is_inside(input.file, folder))
      throw usage_error(key, input.what + " '" + input.file + "' lies in it",
                        "another directory, or " + input.what + " elsewhere");
}

}  // namespace vegard::apps
