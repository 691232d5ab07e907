// How the nodes of a density map name each other.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/scene/structs/volumes_of_scene.h"

namespace vegard::sim {

/// Splits Node::of, such as "hull, lobes", into names without blanks around them; empty for an empty text.
std::vector<std::string> node_names(const std::string& of);

/// The number of nodes that a kind of node takes as operands.
struct NodeArity {
  std::size_t least = 0, most = 0;
  std::string words() const;  ///< "no other node", "one node", "two nodes or more"
};

NodeArity arity_of(NodeKind kind);

}  // namespace vegard::sim
