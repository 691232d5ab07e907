// GLOW's emission tables, for tests whose figures are theirs.
#pragma once

#include "sim/light/emission_tables.h"

namespace vegard::tests {

inline sim::EmissionSource glow() { return {sim::emission_tables("glow"), 1.0}; }

}  // namespace vegard::tests
