// How the nodes of a density map name each other.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/scene/structs/volumes_of_scene.h"

namespace vegard::sim {

/// "hull, lobes" as its names; blanks about them do not count, and an empty text has none.
std::vector<std::string> node_names(const std::string& of);

/// How many nodes a kind of node works on.
struct NodeArity {
  std::size_t least = 0, most = 0;
  std::string words() const;  ///< "no other node", "one node", "two nodes or more"
};

NodeArity arity_of(NodeKind kind);

}  // namespace vegard::sim
