// A second door to the kernel: the samples of fall_on_film, of one line whose atoms wander before they shine,
// shared out over the films of a ladder of blurs (sim/view/film/level_ladder.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/render/beams/kernel.h"

namespace vegard::sim {

/// What becomes of a line's light and where it goes. The film of the KernelScene has cells of one pixel and
/// covers all that can fall on any level; nothing is kept for it.
struct KernelLevels {
  const float* lifetime_s = nullptr;    ///< [HeightProfile::kAltitudes]
  const float* variance_km2 = nullptr;  ///< likewise
  double wind_enu_km_s[3] = {0.0, 0.0, 0.0};
  int count = 0;  ///< of levels
  const FilmGeometry* films = nullptr;
  const float* variance_px2 = nullptr;
};

/// Lets the groups fall on the films of all levels, films[level][row][column], in the units of the value
/// film. The height profiles hold one line. Returns the number of deflection points computed.
std::uint64_t fall_on_levels(const KernelScene& scene, const KernelLevels& levels, const BeamGroup* groups,
                             std::size_t count, std::int64_t* const* films);

}  // namespace vegard::sim
