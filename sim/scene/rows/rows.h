// The rows of the parameter table, except those of emitters (sim/scene/emitters/): a function per group of
// tables, in the order of a scene file.
#pragma once

#include <vector>

#include "sim/scene/rows/declaration.h"

namespace vegard::sim {

// The rows before those of emitters.
std::vector<Declaration> place_rows();
std::vector<Declaration> sheet_rows();

// The rows after those of emitters.
std::vector<Declaration> march_rows();
std::vector<Declaration> own_line_rows();
std::vector<Declaration> light_rows();
std::vector<Declaration> sensor_rows();
std::vector<Declaration> sky_rows();
std::vector<Declaration> night_sky_rows();
std::vector<Declaration> time_rows();
std::vector<Declaration> fit_rows();

}  // namespace vegard::sim
