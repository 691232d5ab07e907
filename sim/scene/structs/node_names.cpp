#include "sim/scene/structs/node_names.h"

#include <limits>

namespace vegard::sim {

std::vector<std::string> node_names(const std::string& of) {
  std::vector<std::string> names;
  std::size_t begin = 0;
  if (of.find_first_not_of(' ') == std::string::npos) return names;
  while (begin <= of.size()) {
    const std::size_t end = std::min(of.find(',', begin), of.size());
    const std::string part = of.substr(begin, end - begin);
    const std::size_t first = part.find_first_not_of(' ');
    names.push_back(first == std::string::npos ? ""
                                               : part.substr(first, part.find_last_not_of(' ') - first + 1));
    begin = end + 1;
  }
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
