// A second interface of the kernel: distributes the samples of fall_on_film, for one line whose atoms move
// before they emit, to the films of a ladder of blurs (sim/view/film/level_ladder.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/render/beams/kernel_types.h"

namespace vegard::sim {

/// Adds the light of the groups to the films of all levels, films[level][row][column], in the units of the
/// value film. The height profiles hold one line. Returns the number of deflection points computed.
std::uint64_t fall_on_levels(const KernelScene& scene, const KernelLevels& levels, const BeamGroup* groups,
                             std::size_t count, std::int64_t* const* films);

}  // namespace vegard::sim
