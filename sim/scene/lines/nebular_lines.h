// The lines of nebulae, and two continua as sets of bands. A part of emission_lines().
#pragma once

#include <vector>

#include "sim/scene/lines/emission_line.h"

namespace vegard::sim {

/// Returns the recombination lines of hydrogen and helium, forbidden lines of ions (as doublets where both
/// lines have a common upper term and thus a fixed ratio), starlight scattered by dust, and synchrotron
/// light.
std::vector<EmissionLine> nebular_lines();

}  // namespace vegard::sim
