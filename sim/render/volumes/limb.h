// The Sun's limb on a film: cells of which it hides a part are marched by several rays each.
//
// What lies behind the Sun ends there at once, and one ray to a cell would make steps of it.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/render/volumes/volumes.h"

namespace vegard::sim {

/// Rays to such a cell, along either edge.
inline constexpr int kLimbRays = 4;

/// Returns which cells of a film, [row][column], the limb of the scene's Sun passes, or that of a
/// chromosphere that absorbs: 1 where some of a cell's corners are on the disc and some are not. Empty
/// without a Sun, or if there are none.
std::vector<std::uint8_t> limb_cells(const Scene& scene, const FilmGeometry& film, int threads);

/// Sets light and transmission of these cells to the mean over kLimbRays² rays each. Their distance stays
/// that of the ray through the middle.
void march_limb(const FilmGeometry& film, const std::vector<std::uint8_t>& cells, const MarchCells& march,
                VolumeLight& light);

}  // namespace vegard::sim
