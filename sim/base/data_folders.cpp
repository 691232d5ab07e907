#include "sim/base/data_folders.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace vegard::sim {

// VEGARD_INSTALLED_DATA and VEGARD_SOURCE_DATA come from sim/CMakeLists.txt.
std::vector<std::string> data_folders() {
  namespace fs = std::filesystem;
  std::vector<std::string> folders;
  if (const char* given = std::getenv("VEGARD_DATA"); given != nullptr && *given != '\0')
    folders.emplace_back(given);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back((program.parent_path().parent_path() / "share" / "vegard" / "data").string());
  Dl_info module;
  if (dladdr(reinterpret_cast<const void*>(&data_folders), &module) != 0 && module.dli_fname != nullptr)
    folders.push_back((fs::path(module.dli_fname).parent_path() / "data").string());
  folders.emplace_back(VEGARD_INSTALLED_DATA);
  folders.emplace_back("/usr/share/vegard/data");  // Debian's package, also where there is no /proc
  folders.emplace_back(VEGARD_SOURCE_DATA);
  return folders;
}

std::string find_data_file(const std::string& name) {
  std::error_code error;
  for (const std::string& folder : data_folders()) {
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    if (std::filesystem::exists(path, error)) return path.string();
  }
  return {};
}

}  // namespace vegard::sim
