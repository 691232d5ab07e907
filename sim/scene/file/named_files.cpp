#include "sim/scene/file/named_files.h"

#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {
namespace {

constexpr std::string_view kFace = "{face}";

/// Calls use(path, name) for every name that is not empty.
template <class Use>
void for_each_name(Scene& scene, const Use& use) {
  for (const Declaration& d : declarations()) {
    if (!d.names_file) continue;
    for (int e = 0; e < element_count(d, scene); ++e) {
      std::string& name = *std::get<std::string*>(d.at(scene, e, 0));
      if (!name.empty()) use(key_path(d, scene, e), name);
    }
  }
}

}  // namespace

std::vector<NamedFile> named_files(const Scene& scene) {
  std::vector<NamedFile> files;
  // Only read through: the accessors take a Scene they could change.
  for_each_name(const_cast<Scene&>(scene), [&](const std::string& path, const std::string& name) {
    files.push_back({path, name});
  });
  return files;
}

std::vector<std::string> files_of_name(const std::string& name) {
  const std::size_t at = name.find(kFace);
  if (at == std::string::npos) return {name};
  std::vector<std::string> files;
  for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"})
    files.push_back(name.substr(0, at) + face + name.substr(at + kFace.size()));
  return files;
}

void rename_files(Scene& scene, const std::function<std::string(const std::string&)>& renamed) {
  for_each_name(scene, [&](const std::string&, std::string& name) { name = renamed(name); });
}

}  // namespace vegard::sim
