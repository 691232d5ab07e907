#include "sim/base/module.h"

#include <dlfcn.h>
#include <link.h>

#include <vector>

namespace vegard::sim {
namespace {

/// The folders in which dlopen() looks for a file when it is called from here; empty if they are not known.
std::string searched_folders() {
  Dl_info self;
  if (dladdr(reinterpret_cast<const void*>(&module_table), &self) == 0) return {};
  // The program itself has no name by which it is found among what is loaded.
  void* handle = dlopen(self.dli_fname, RTLD_NOW | RTLD_NOLOAD);
  if (handle == nullptr) handle = dlopen(nullptr, RTLD_NOW);
  if (handle == nullptr) return {};
  std::string folders;
  Dl_serinfo size;
  if (dlinfo(handle, RTLD_DI_SERINFOSIZE, &size) == 0) {
    std::vector<char> memory(size.dls_size);
    auto* const info = reinterpret_cast<Dl_serinfo*>(memory.data());
    if (dlinfo(handle, RTLD_DI_SERINFOSIZE, info) == 0 && dlinfo(handle, RTLD_DI_SERINFO, info) == 0)
      for (unsigned i = 0; i < info->dls_cnt; ++i)
        folders += (i == 0 ? "" : ", ") + std::string(info->dls_serpath[i].dls_name);
  }
  dlclose(handle);
  return folders;
}

}  // namespace

const void* module_table(const std::string& name) {
  const std::string file = name + ".so";
  const auto missing = [&](const std::string& problem) {
    const char* const said = dlerror();
    const std::string words = said != nullptr ? said : "nothing more is known";  // before the next call
    return MissingModule(file + ", a part of vegard, " + problem + ": " + words + ". It was looked for in " +
                         searched_folders() + ". Install vegard again, or build all of it.");
  };
  // Local: the module's libraries are nobody else's business. Never closed: they do not stand it.
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw missing("cannot be loaded");
  void* const symbol = dlsym(handle, "vegard_module_table");
  if (symbol == nullptr) throw missing("is another file of that name");
  return reinterpret_cast<const void* (*)()>(symbol)();
}

}  // namespace vegard::sim
