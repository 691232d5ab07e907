// The interface of the kernel that marches through footprints: stretches of rays in, their light out.
//
// The implementation is compiled once per instruction set; the interface passes plain arrays
// (sim/emit/footprint/footprint_kernel_types.h). The steps of a ray lie side by side in the lanes, sixteen to
// a block; so no lane waits for another ray, and a block is skipped as a whole if the LitMap says that it is
// dark. The light of a block does not depend on which other blocks are skipped, nor on the instruction set.
#pragma once

#include <cstddef>

#include "sim/emit/footprint/footprint_kernel_types.h"

namespace vegard::sim {

/// Computes the light of each span. Returns the number of steps that were not skipped.
std::size_t march_spans(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count,
                        SpanLight* out);

}  // namespace vegard::sim
