#include "sim/scene/freedom/free_path.h"

#include "sim/base/error.h"

namespace vegard::sim {
namespace {

std::vector<ParameterPath> resolved(const Scene& scene, const std::string& path, int line) {
  std::vector<ParameterPath> paths;
  with_origin(scene, line, path, [&] { paths = resolve(scene, path); });
  return paths;
}

}  // namespace

void with_origin(const Scene& scene, int line, const std::string& key, const std::function<void()>& what) {
  try {
    what();
  } catch (const Error& error) {
    ErrorDetails details = error.details();
    details.file = scene.file;
    details.line = line;
    if (details.key.empty()) details.key = key;
    throw Error(error.kind(), details);
  }
}

std::vector<ParameterPath> paths_of(const Scene& scene, const FreeParameter& free) {
  if (free.path.empty() && !free.name.empty()) return {};
  return resolved(scene, free.path, free.line);
}

std::vector<ParameterPath> paths_of(const Scene& scene, const TiedParameter& tied) {
  return resolved(scene, tied.path, tied.line);
}

bool meet(const std::string& photo, const std::string& other_photo) {
  return photo.empty() || other_photo.empty() || photo == other_photo;
}

}  // namespace vegard::sim
