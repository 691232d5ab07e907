// The lines of nebulae, and two continua of theirs as sets of bands. A part of emission_lines().
#pragma once

#include <vector>

#include "sim/scene/lines/emission_line.h"

namespace vegard::sim {

/// Recombination lines of hydrogen and helium, forbidden lines of ions (each with the other line from its
/// upper term, where the two cannot be had apart), starlight that dust scatters, and synchrotron light.
std::vector<EmissionLine> nebular_lines();

}  // namespace vegard::sim
