// Auroral forms: which keys of a sheet each of them sets.
//
// Source: Baranoski et al. 2000, sections 2.2 to 2.4 (after the International Auroral Atlas); docs/physics.md
// row B20, docs/forms.md.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct Form {
  std::string name;                                         ///< "homogeneous_arc"
  std::string meaning;                                      ///< one line
  std::vector<std::pair<std::string, std::string>> values;  ///< keys of a sheet and their values as TOML text
};

/// Every form, the same keys in the same order; "custom", which sets nothing, is first.
const std::vector<Form>& forms();

std::vector<std::string> form_names();

/// Sets what the sheet's form sets.
void apply_form(Scene& scene, int sheet);

}  // namespace vegard::sim
