// Where a number of a scene is in a copy of it.
#pragma once

#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The addresses in `copy` of the numbers at `addresses` in `from`: every real number of the parameter table,
/// of repeated tables and lists too. The copy has the same elements and as long lists. Null for an address
/// that is none of a parameter's.
std::vector<const double*> counterparts(const Scene& from, const std::vector<const double*>& addresses,
                                        const Scene& copy);

/// The same of one number, to be written to; null if it is no parameter's.
double* counterpart(const Scene& from, const double* address, Scene& copy);

}  // namespace vegard::sim
