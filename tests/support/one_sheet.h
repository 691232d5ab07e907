// A scene that holds one sheet and is otherwise the default.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::tests {

inline sim::Scene with_sheet(const sim::Sheet& sheet) {
  sim::Scene scene;
  scene.sheets = {sheet};
  return scene;
}

}  // namespace vegard::tests
