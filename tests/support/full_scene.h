// A scene with two of every repeated table and every list filled, so that each row of the parameter table has
// numbers in it.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_declarations.h"

namespace vegard::tests {

inline sim::Scene full_scene() {
  sim::Scene scene;
  for (const std::string name : {"first", "second"}) {
    for (const sim::RepeatedTable& repeated : sim::repeated_tables()) {
      repeated.append(scene);
      const_cast<std::string&>(repeated.name(scene, static_cast<int>(repeated.count(scene)) - 1)) = name;
    }
  }
  double number = 1.0;
  for (const sim::Declaration& d : sim::declarations())
    for (int e = 0; d.list && e < sim::element_count(d, scene); ++e) {
      if (!d.list(scene, e).empty()) continue;
      std::vector<double> list(d.numbers_per_line ? scene.emission.lines.size() * d.numbers_per_line(scene, e)
                                                  : 3);
      for (double& value : list) value = number += 0.25;
      d.set_list(scene, e, list);
    }
  return scene;
}

}  // namespace vegard::tests
