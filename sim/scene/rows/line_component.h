// Names of the components of a list that has a number per emission line.
//
// For the files of this folder only.
#pragma once

#include <string>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

inline std::string name_by_line(const Scene& scene, int /*element*/, int index) {
  const auto& lines = scene.emission.lines;
  return index < static_cast<int>(lines.size()) ? line_name(lines[index]) : std::to_string(index);
}

}  // namespace vegard::sim
