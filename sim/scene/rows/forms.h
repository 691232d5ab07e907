// Auroral forms: which keys of a sheet each of them sets.
//
// Source: Baranoski et al. 2000, sections 2.2 to 2.4 (after the International Auroral Atlas); docs/physics.md
// row B20, docs/forms.md.
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

/// Every form, the same keys in the same order; "custom", which sets nothing, is first.
const std::vector<Form>& forms();

std::vector<std::string> form_names();

/// What a form sets; nothing for a name that is none.
const std::vector<KeyAndText>& values_of_form(const std::string& name);

}  // namespace vegard::sim
