// The rows of the parameter table, a function per group of tables, in the order of a scene file.
#pragma once

#include <vector>

#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {

std::vector<Declaration> place_rows();
std::vector<Declaration> sheet_rows();
std::vector<Declaration> footprint_rows();
std::vector<Declaration> nebula_rows();
std::vector<Declaration> node_rows();
std::vector<Declaration> volume_rows();
std::vector<Declaration> sun_rows();
std::vector<Declaration> chromosphere_rows();
std::vector<Declaration> loop_rows();
std::vector<Declaration> corona_rows();
std::vector<Declaration> bundle_rows();
std::vector<Declaration> ejection_rows();
std::vector<Declaration> march_rows();
std::vector<Declaration> light_rows();
std::vector<Declaration> sensor_rows();
std::vector<Declaration> sky_rows();
std::vector<Declaration> night_sky_rows();
std::vector<Declaration> time_rows();
std::vector<Declaration> fit_rows();

}  // namespace vegard::sim
