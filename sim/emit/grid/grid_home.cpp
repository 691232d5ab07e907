#include "sim/emit/grid/grid_home.h"

namespace vegard::sim {

double grid_turn_rad(const GridBricks& grid, const Volume& volume, const Sun* sun, double instant_s) {
  if (volume.frame != VolumeFrame::sun || sun == nullptr || grid.empty()) return 0.0;
  const SolarTurn turn(*sun, instant_s);
  if (!turn.turns()) return 0.0;
  // Turn and one scale: the inverse is the transpose over the square of the scale.
  constexpr double kCoarseCell = GridBricks::kEdge * GridBricks::kCoarse;
  const GridPlace& place = grid.place();
  double shift[3], middle[3], square = 0.0;
  shift_of_volume(grid, volume, sun->unit_km, plain_number, shift);
  for (int c = 0; c < 3; ++c) {
    middle[c] = shift[c];
    for (int a = 0; a < 3; ++a)
      middle[c] += (0.5 * (grid.low(a) + grid.high(a)) * kCoarseCell - place.shift[a]) * place.turn[a][c] *
                   grid.voxel_km() * grid.voxel_km();
    square += middle[c] * middle[c];
  }
  const bool within = square < sun->radius * sun->radius;
  return turn.angle_rad(within ? 0.0 : middle[2] * middle[2] / square);
}

}  // namespace vegard::sim
