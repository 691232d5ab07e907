#include "sim/scene/structs/nebula.h"

#include <limits>

#include "sim/base/text.h"

namespace vegard::sim {

std::vector<std::string> node_names(const std::string& of) {
  std::vector<std::string> names;
  if (trimmed(of, " ").empty()) return names;
  for (const std::string_view part : split(of, ',')) names.emplace_back(trimmed(part, " "));
  return names;
}

std::string NodeArity::words() const {
  if (most == 0) return "no other node";
  return most == 1 ? "one node" : "two nodes or more";
}

NodeArity arity_of(NodeKind kind) {
  switch (kind) {
    case NodeKind::unite:
    case NodeKind::intersect:
    case NodeKind::subtract:
      return {2, std::numeric_limits<std::size_t>::max()};
    case NodeKind::filaments:
    case NodeKind::turbulence:
    case NodeKind::warp:
    case NodeKind::scale:
    case NodeKind::rotate:
    case NodeKind::move:
      return {1, 1};
    case NodeKind::sphere:
    case NodeKind::shell:
    case NodeKind::lobes:
    case NodeKind::torus:
    case NodeKind::tube:
    case NodeKind::slab:
      break;
  }
  return {0, 0};
}

}  // namespace vegard::sim
