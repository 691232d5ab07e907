// Where a number of a scene is in a copy of it.
#pragma once

#include "sim/scene/scene.h"

namespace vegard::fit {

/// The address in `copy` of the number at `address` in `from`, of which it is a copy; null for the
/// coefficients of free-form profiles.
double* number_in(sim::Scene& copy, const sim::Scene& from, const double* address);

}  // namespace vegard::fit
