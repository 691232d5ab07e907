// A simple march to measure the product's against: sixteen rays side by side, each step of two kilometres one
// after the other, all of them.
#pragma once

#include <cstddef>

#include "sim/emit/footprint/footprint_kernel_types.h"

namespace vegard::bench {

/// Of a shell whose window is on one face. Rates are read at the middles of steps. Returns the steps marched.
std::size_t march_side_by_side(const sim::FootprintKernel& kernel, int face, const sim::MarchSpan* spans,
                               std::size_t count, sim::SpanLight* out);

}  // namespace vegard::bench
