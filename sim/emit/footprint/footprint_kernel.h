// The kernel's door of the march through footprints: stretches of rays in, their light out.
//
// Behind it is what is compiled once per instruction set; what crosses the door are plain arrays
// (sim/emit/footprint/footprint_kernel_types.h). The steps of a ray lie side by side in the lanes, sixteen to
// a block; so no lane waits for another ray, and a block is passed over as a whole where the map of the lit
// says that nothing in it shines. What a block adds does not depend on which others are passed over, nor on
// the instruction set.
#pragma once

#include <cstddef>

#include "sim/emit/footprint/footprint_kernel_types.h"

namespace vegard::sim {

/// What comes out of each span. Returns the steps that were not passed over.
std::size_t march_spans(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count,
                        SpanLight* out);

}  // namespace vegard::sim
