// Auroral forms, and the keys of a sheet that each form sets.
//
// Source: Baranoski et al. 2000, sections 2.2 to 2.4 (after the International Auroral Atlas); docs/physics.md
// row B20, docs/forms.md; of STEVE and the picket fence Archer et al. 2019,
// doi:10.1029/2019GL084473.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/rows/declaration.h"

namespace vegard::sim {

struct Form {
  std::string name;                ///< "homogeneous_arc"
  std::string meaning;             ///< one line
  std::vector<KeyAndText> values;  ///< keys of a sheet
};

/// Returns all forms, with the same keys in the same order, after "custom", which sets nothing.
const std::vector<Form>& forms();

std::vector<std::string> form_names();

/// Returns the keys and values that a form sets; empty for an unknown name.
const std::vector<KeyAndText>& values_of_form(const std::string& name);

}  // namespace vegard::sim
