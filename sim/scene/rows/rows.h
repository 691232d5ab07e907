// The rows of the parameter table but those of what shines (sim/scene/emitters/), a function per group of
// tables, in the order of a scene file.
#pragma once

#include <vector>

#include "sim/scene/rows/declaration.h"

namespace vegard::sim {

// What comes before it.
std::vector<Declaration> place_rows();
std::vector<Declaration> sheet_rows();

// What comes after what shines.
std::vector<Declaration> march_rows();
std::vector<Declaration> own_line_rows();
std::vector<Declaration> light_rows();
std::vector<Declaration> sensor_rows();
std::vector<Declaration> sky_rows();
std::vector<Declaration> night_sky_rows();
std::vector<Declaration> time_rows();
std::vector<Declaration> fit_rows();

}  // namespace vegard::sim
