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

NodeArity arity_of(const std::string& kind) {
  constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
  if (kind == "union" || kind == "intersection" || kind == "difference") return {2, kAny};
  for (const char* one : {"filaments", "turbulence", "warp", "scale", "rotate", "move"})
    if (kind == one) return {1, 1};
  return {0, 0};
}

}  // namespace vegard::sim
