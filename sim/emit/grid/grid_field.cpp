#include "sim/emit/grid/grid_field.h"

#include <algorithm>
#include <cmath>

#include "sim/emit/grid/grid_home.h"
#include "sim/emit/grid/grid_trilinear.h"

namespace vegard::sim {
namespace {

constexpr double kBrick = GridBricks::kEdge, kCoarseCell = kBrick * GridBricks::kCoarse;

}  // namespace

GridField::GridField(const GridBricks& grid, const Volume& volume, const Sun* sun, double share,
                     double turned_rad)
    : grid_(grid), unit_km_(volume.frame == VolumeFrame::sun && sun != nullptr ? sun->unit_km : 1.0) {
  double shift[3];
  shift_of_volume(grid, volume, unit_km_, plain_number, shift);
  for (int a = 0; a < 3; ++a) {
    from_[a] = grid.place().shift[a];
    for (int c = 0; c < 3; ++c) {
      from_[a] -= shift[c] * grid.place().turn[a][c];
      turn_[a][c] = grid.place().turn[a][c];
    }
    if (turned_rad == 0.0) continue;
    // A row of it is a place that turns with the grid.
    const Vec3<double> row = turned_west(Vec3<double>{turn_[a][0], turn_[a][1], turn_[a][2]}, turned_rad);
    for (int c = 0; c < 3; ++c) turn_[a][c] = row[c];
  }
  for (int l = 0; l < grid.lines(); ++l)
    gain_.push_back(volume.density_rayleigh.empty()
                        ? share * volume.gain
                        : share * volume.gain * volume.density_rayleigh[l] / (kRayleighsPerKm * unit_km_));
}

Box3 GridField::bounds() const {
  // Turn and one scale: the inverse is the transpose over the square of the scale.
  const double edge = grid_.voxel_km() * grid_.voxel_km();
  Box3 box;
  for (int c = 0; c < 3; ++c) {
    box.low[c] = box.high[c] = 0.0;
    for (int a = 0; a < 3; ++a) {
      const double along = turn_[a][c] * edge;
      const double one = (grid_.low(a) * kCoarseCell - from_[a]) * along;
      const double other = (grid_.high(a) * kCoarseCell - from_[a]) * along;
      box.low[c] += std::min(one, other);
      box.high[c] += std::max(one, other);
    }
  }
  return box;
}

Box3 GridField::in_voxels(const Box3& box) const {
  Box3 out;
  for (int a = 0; a < 3; ++a) {
    out.low[a] = out.high[a] = from_[a];
    for (int c = 0; c < 3; ++c) {
      const double along = turn_[a][c];
      out.low[a] += std::min(along * box.low[c], along * box.high[c]);
      out.high[a] += std::max(along * box.low[c], along * box.high[c]);
    }
  }
  return out;
}

bool GridField::is_dark(const Box3& box) const {
  if (grid_.empty()) return true;
  const Box3 v = in_voxels(box);
  const auto range = [&](int a, double edge, double& first, double& last) {
    first = std::max(std::floor(v.low[a] / edge), grid_.low(a) * kCoarseCell / edge);
    last = std::min(std::floor(v.high[a] / edge), grid_.high(a) * kCoarseCell / edge - 1.0);
    return last - first + 1.0;
  };
  double first[3], last[3];
  const auto any = [&](double edge, const auto& lit) {
    for (int a = 0; a < 3; ++a)
      if (range(a, edge, first[a], last[a]) <= 0.0) return false;
    for (int x = static_cast<int>(first[0]); x <= static_cast<int>(last[0]); ++x)
      for (int y = static_cast<int>(first[1]); y <= static_cast<int>(last[1]); ++y)
        for (int z = static_cast<int>(first[2]); z <= static_cast<int>(last[2]); ++z)
          if (lit(x, y, z)) return true;
    return false;
  };
  if (!any(kCoarseCell, [&](int x, int y, int z) { return grid_.coarse(x, y, z) != nullptr; })) return true;
  double bricks = 1.0;
  for (int a = 0; a < 3; ++a) bricks *= std::max(0.0, range(a, kBrick, first[a], last[a]));
  if (bricks > 4096.0) return false;  // too many to look at: whoever asks will ask for its parts
  return !any(kBrick, [&](int x, int y, int z) { return grid_.brick(x, y, z) >= 0; });
}

void GridField::sample(std::size_t count, const double* const point[3], float* const emission[],
                       float* density) const {
  for (std::size_t i = 0; i < count; ++i) {
    double at[3], local[3];
    int b[3];
    for (int a = 0; a < 3; ++a) {
      at[a] = from_[a];
      for (int c = 0; c < 3; ++c) at[a] += turn_[a][c] * point[c][i];
      b[a] = static_cast<int>(std::clamp(std::floor(at[a] / kBrick), -1e9, 1e9));
      local[a] = at[a] - b[a] * kBrick;
    }
    const std::int32_t brick = grid_.brick(b[0], b[1], b[2]);
    density[i] = 0.0f;
    for (int l = 0; l < grid_.lines(); ++l) emission[l][i] = 0.0f;
    if (brick < 0) continue;
    const GridCell cell(local);
    for (int l = 0; l < grid_.lines(); ++l)
      emission[l][i] = static_cast<float>(gain_[l] * cell.value(grid_.emission(brick) + l, grid_.stride()));
    if (grid_.has_density()) density[i] = static_cast<float>(cell.value(grid_.density(brick), 1));
  }
}

}  // namespace vegard::sim
