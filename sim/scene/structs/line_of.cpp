#include "sim/scene/structs/line_of.h"

namespace vegard::sim {

int line_of(const Scene& scene, const std::string& key) {
  for (std::string part = key; !part.empty();) {
    const auto line = scene.lines.find(part);
    if (line != scene.lines.end()) return line->second;
    const std::size_t dot = part.rfind('.');
    part = dot == std::string::npos ? "" : part.substr(0, dot);
  }
  return 0;
}

}  // namespace vegard::sim
