// Sizes of a footprint's map and spline, computed from its keys and the radius of the body alone.
#pragma once

#include <cstddef>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// True if a flow winds the footprint up, now or later.
inline bool flows(const Footprint& f) { return f.flow_turns > 0.0 || f.flow_turns_per_s > 0.0; }

/// True if the footprint changes with the scene's clock by its own keys, whatever its source does.
inline bool moves_by_itself(const Footprint& f) {
  return f.drift_km_s.east != 0.0 || f.drift_km_s.north != 0.0 || f.flow_turns_per_s > 0.0 ||
         (f.source == FootprintSource::noise && f.noise_lifetime_s > 0.0);
}

/// True if the scene's clock only moves the footprint as a whole, if at all.
inline bool only_drifts(const Footprint& f) {
  return f.source != FootprintSource::sheets && !(f.flow_turns_per_s > 0.0) &&
         !(f.source == FootprintSource::noise && f.noise_lifetime_s > 0.0);
}

/// Smallest standard deviation, in cells, of the Gaussian across a spline as it is drawn. A narrower one is
/// drawn this wide and fainter in proportion: the sum of its samples would miss its integral.
inline constexpr double kNarrowestCells = 0.7;

/// Returns the standard deviation in km of the Gaussian as it is drawn: width_km or kNarrowestCells cells.
double drawn_width_km(const Footprint& footprint, double sphere_km);

/// Returns the largest length in km of a piece of a footprint's spline. Volumes: 0.8 of the drawn width,
/// since a sum of Gaussians at this spacing equals their integral to 1e-13. Curtains: 4 km in a box, 16 km in
/// a shell.
double longest_piece_km(const Footprint& footprint, double sphere_km);

/// Returns the number of pieces of the whole spline. Between two points there are at least 16, and enough for
/// a curve that is 1.5 times as long as its chord.
double spline_pieces(const Footprint& footprint, double sphere_km);
inline constexpr double kMaxSplinePieces = 1048576.0;

/// Return the number of cells of the map: along the longer side of a box, and in total.
double longest_side_cells(const Footprint& footprint);
double map_cells(const Footprint& footprint);
inline constexpr double kMaxBoxCells = 67108864.0;
/// Limit of the map of empty space: it has one cell per 8 x 8 cells, and squared distances in 32 bits.
inline constexpr double kMaxSideCells = 262000.0;

/// Returns the memory in bytes per cell while a map is made, with numbers of `number_bytes`: the flux, ln E
/// where it varies, four layers of sheets at a time, and copies of flux and ln E from before the flow.
double bytes_per_cell(const Footprint& footprint, std::size_t number_bytes);
inline constexpr double kMaxMapBytes = 4e9;

}  // namespace vegard::sim
