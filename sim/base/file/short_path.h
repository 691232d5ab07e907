// Names of parameters where there is little room.
#pragma once

#include <string>

namespace vegard::sim {

/// With one sheet its name says nothing: "energy_kev" for "sheet.main.energy_kev".
std::string short_path(const std::string& path, bool one_sheet);

}  // namespace vegard::sim
