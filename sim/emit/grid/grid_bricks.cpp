#include "sim/emit/grid/grid_bricks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "sim/base/error.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::sim {
namespace {

constexpr int kBricksEdge = GridBricks::kEdge, kBricksSide = GridBricks::kSide, kCoarse = GridBricks::kCoarse;
constexpr std::size_t kMaxCoarseCells = std::size_t{1} << 27;

GridPlace place_of(const SparseGrid& grid, const Site& site, const Site& observer, double sphere_km) {
  const SiteTurn home = turn_between(observer, site, sphere_km);
  GridPlace place;
  for (int a = 0; a < 3; ++a) {
    place.shift[a] = -0.5;
    for (int c = 0; c < 3; ++c) {
      place.shift[a] += grid.axes[a][c] / grid.voxel * (home.shift_km[c] - grid.origin[c]);
      place.turn[a][c] = 0.0;
      for (int k = 0; k < 3; ++k) place.turn[a][c] += grid.axes[a][k] / grid.voxel * home.turn[k][c];
    }
  }
  return place;
}

/// Those with a voxel that is not 0 in them or next to them above.
std::set<BrickCoordinate> bricks_with_light(const SparseGrid& grid, const std::vector<int>& channels) {
  std::set<BrickCoordinate> all;
  for (const auto& [at, numbers] : grid.bricks) {
    bool lit[2][2][2] = {};  // whether the brick, or its lowest layer along an axis, has any
    for (const int c : channels)
      for (int i = 0; i < kBricksEdge; ++i)
        for (int j = 0; j < kBricksEdge; ++j)
          for (int k = 0; k < kBricksEdge; ++k)
            if (numbers[c * SparseGrid::kVoxels + SparseGrid::within(i, j, k)] != 0.0f)
              for (int x = 0; x <= (i == 0); ++x)
                for (int y = 0; y <= (j == 0); ++y)
                  for (int z = 0; z <= (k == 0); ++z) lit[x][y][z] = true;
    for (int x = 0; x < 2; ++x)
      for (int y = 0; y < 2; ++y)
        for (int z = 0; z < 2; ++z)
          if (lit[x][y][z]) all.insert({at.x - x, at.y - y, at.z - z});
  }
  return all;
}

/// Copies a channel of the brick and of those above it to kBricksSide^3 voxels, `stride` apart.
void gather(const SparseGrid& grid, int channel, const BrickCoordinate& at, float* to, int stride) {
  for (int part = 0; part < 8; ++part) {
    const int d[3] = {part >> 2 & 1, part >> 1 & 1, part & 1};
    const auto found = grid.bricks.find({at.x + d[0], at.y + d[1], at.z + d[2]});
    if (found == grid.bricks.end()) continue;
    const float* from = found->second.data() + static_cast<std::size_t>(channel) * SparseGrid::kVoxels;
    for (int i = 0; i < (d[0] ? 1 : kBricksEdge); ++i)
      for (int j = 0; j < (d[1] ? 1 : kBricksEdge); ++j)
        for (int k = 0; k < (d[2] ? 1 : kBricksEdge); ++k)
          to[(((i + d[0] * kBricksEdge) * kBricksSide + j + d[1] * kBricksEdge) * kBricksSide + k +
              d[2] * kBricksEdge) *
             stride] = from[SparseGrid::within(i, j, k)];
  }
}

int floor_of(int brick) { return brick >= 0 ? brick / kCoarse : -((-brick + kCoarse - 1) / kCoarse); }

}  // namespace

void GridBricks::set_home(const Site& home, const Site& observer) {
  const SiteTurn turn = turn_between(home, observer);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) place_.from_home[i][j] = turn.turn[i][j];
}

GridBricks::GridBricks(const SparseGrid& grid, const std::vector<int>& emission, int density,
                       const std::string& file, const Site& site, const Site& observer,
                       std::uint64_t max_bytes, double sphere_km)
    : lines_(static_cast<int>(emission.size())),
      stride_(lines_ <= 2   ? lines_
              : lines_ <= 4 ? 4
                            : 8),
      voxel_km_(grid.voxel),
      place_(place_of(grid, site, observer, sphere_km)) {
  std::vector<int> channels;
  for (const int c : emission)
    if (c >= 0) channels.push_back(c);
  if (density >= 0) channels.push_back(density);
  const std::set<BrickCoordinate> lit = bricks_with_light(grid, channels);
  count_ = lit.size();
  if (lit.empty()) return;
  // A voxel at the corner of its brick is in eight of these.
  const double bytes =
      static_cast<double>(grid.bricks.size()) * grid.channels.size() * SparseGrid::kVoxels * sizeof(float) +
      static_cast<double>(count_) * kVoxels * (stride_ + (density >= 0 ? 1 : 0)) * sizeof(float);
  if (bytes > static_cast<double>(max_bytes)) {
    char problem[160];
    std::snprintf(problem, sizeof problem, "its grids take %.3g MB of memory, of which %.3g MB may be used",
                  bytes / 1048576.0, static_cast<double>(max_bytes) / 1048576.0);
    throw Error(ErrorKind::unreadable_input, problem)
        .file(file)
        .expected("smaller grids, larger voxels, or fewer lines");
  }
  for (int a = 0; a < 3; ++a) {
    const auto along = [a](const BrickCoordinate& b) { return floor_of(a == 0 ? b.x : a == 1 ? b.y : b.z); };
    low_[a] = high_[a] = along(*lit.begin());
    for (const BrickCoordinate& b : lit) {
      low_[a] = std::min(low_[a], along(b));
      high_[a] = std::max(high_[a], along(b));
    }
    ++high_[a];
  }
  double cells = 1.0;
  for (int a = 0; a < 3; ++a) cells *= high_[a] - low_[a];
  if (cells > static_cast<double>(kMaxCoarseCells))
    throw Error(ErrorKind::unreadable_input, "its voxels lie too far apart for their size")
        .file(file)
        .expected("fewer than 10^13 voxels in the box");
  coarse_.assign(static_cast<std::size_t>(cells), -1);
  emission_.assign((count_ * kVoxels) * stride_, 0.0f);
  if (density >= 0) density_.assign(count_ * kVoxels, 0.0f);
  std::int32_t index = 0;
  for (const BrickCoordinate& b : lit) {
    const int c[3] = {floor_of(b.x), floor_of(b.y), floor_of(b.z)};
    std::int32_t& table =
        coarse_[((static_cast<std::size_t>(c[0] - low_[0]) * (high_[1] - low_[1])) + (c[1] - low_[1])) *
                    (high_[2] - low_[2]) +
                (c[2] - low_[2])];
    constexpr std::size_t kTable = static_cast<std::size_t>(kCoarse) * kCoarse * kCoarse;
    if (table < 0) {
      table = static_cast<std::int32_t>(tables_.size() / kTable);
      tables_.resize(tables_.size() + kTable, -1);
    }
    tables_[table * kTable + ((b.x - c[0] * kCoarse) * kCoarse + b.y - c[1] * kCoarse) * kCoarse + b.z -
            c[2] * kCoarse] = index;
    for (int l = 0; l < lines_; ++l)
      if (emission[l] >= 0)
        gather(grid, emission[l], b,
               emission_.data() + static_cast<std::size_t>(index) * kVoxels * stride_ + l, stride_);
    if (density >= 0)
      gather(grid, density, b, density_.data() + static_cast<std::size_t>(index) * kVoxels, 1);
    ++index;
  }
}

std::int32_t GridBricks::brick(int x, int y, int z) const {
  const int at[3] = {x, y, z};
  int c[3];
  for (int a = 0; a < 3; ++a) {
    c[a] = floor_of(at[a]);
    if (c[a] < low_[a] || c[a] >= high_[a]) return -1;
  }
  const std::int32_t* table = coarse(c[0], c[1], c[2]);
  if (table == nullptr) return -1;
  return table[((x - c[0] * kCoarse) * kCoarse + y - c[1] * kCoarse) * kCoarse + z - c[2] * kCoarse];
}

}  // namespace vegard::sim
