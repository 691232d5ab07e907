// How large the parts of a footprint become, from its keys and the radius of the body alone.
#pragma once

#include <cstddef>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Whether a flow winds it up, now or later.
inline bool flows(const Footprint& f) { return f.flow_turns > 0.0 || f.flow_turns_per_s > 0.0; }

/// Whether it changes with the scene's clock, whatever it is made of.
inline bool moves_by_itself(const Footprint& f) {
  return f.drift_km_s.east != 0.0 || f.drift_km_s.north != 0.0 || f.flow_turns_per_s > 0.0 ||
         (f.source == FootprintSource::noise && f.noise_lifetime_s > 0.0);
}

/// Whether all that the clock does to it is to move it as a whole.
inline bool only_drifts(const Footprint& f) {
  return f.source != FootprintSource::sheets && !(f.flow_turns_per_s > 0.0) &&
         !(f.source == FootprintSource::noise && f.noise_lifetime_s > 0.0);
}

/// Where the Gaussian across a spline is narrower than this many cells it is drawn as wide as this, and as
/// much fainter: the samples of a narrower one would not add up to it.
inline constexpr double kNarrowestCells = 0.7;

/// Standard deviation of the Gaussian as it is drawn, at the scene's own width_km.
double drawn_width_km(const Footprint& footprint, double sphere_km);

/// How long a piece of a footprint's spline is at most: of a volume 0.8 of the drawn width, since an even sum
/// of Gaussians so far apart is their integral to 1e-13; of a curtain 4 km, of a shell's 16 km.
double longest_piece_km(const Footprint& footprint, double sphere_km);

/// How many pieces its spline has, from point to point: 16 or more, and as if each way were half as long
/// again as its chord.
double spline_pieces(const Footprint& footprint, double sphere_km);
inline constexpr double kMaxSplinePieces = 1048576.0;

/// Cells of the map along the longer side of a box, and in all.
double longest_side_cells(const Footprint& footprint);
double map_cells(const Footprint& footprint);
inline constexpr double kMaxBoxCells = 67108864.0;
/// What the map of the dark can hold, which has a cell for 8 x 8 and counts in squares of 32 bits.
inline constexpr double kMaxSideCells = 262000.0;

/// Memory while a map is made, per cell, where a number takes `number_bytes`: flux, ln E where it varies,
/// four layers of sheets at a time, and both as they were before the flow.
double bytes_per_cell(const Footprint& footprint, std::size_t number_bytes);
inline constexpr double kMaxMapBytes = 4e9;

}  // namespace vegard::sim
