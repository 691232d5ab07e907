#include "sim/render/field_sampling.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/parallel.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kBricksAtOnce = 256;
constexpr int kVoxels = SparseGrid::kVoxels, kEdge = SparseGrid::kEdge;

struct BrickRange {
  int low[3], high[3];  ///< high is the first beyond
};

Box3 box_of(const BrickRange& r, const SparseGrid& grid) {
  Box3 box;
  for (int a = 0; a < 3; ++a) {
    box.low[a] = grid.origin[a] + r.low[a] * kEdge * grid.voxel;
    box.high[a] = grid.origin[a] + r.high[a] * kEdge * grid.voxel;
  }
  return box;
}

void collect(const LightField& field, const SparseGrid& grid, const BrickRange& r,
             std::vector<BrickCoordinate>& out) {
  if (field.is_dark(box_of(r, grid))) return;
  int widest = 0;
  for (int a = 1; a < 3; ++a)
    if (r.high[a] - r.low[a] > r.high[widest] - r.low[widest]) widest = a;
  const int edge = r.high[widest] - r.low[widest];
  if (edge == 1) {
    out.push_back({r.low[0], r.low[1], r.low[2]});
    return;
  }
  BrickRange low = r, high = r;
  low.high[widest] = high.low[widest] = r.low[widest] + edge / 2;
  collect(field, grid, low, out);
  collect(field, grid, high, out);
}

/// Light and density of a brick's voxels, [line or density][voxel]; empty if dark.
SparseGrid::Brick sampled(const LightField& field, int all_lines, const std::vector<int>& lines,
                          const BrickCoordinate& at, const std::optional<Box3>& crop,
                          const SparseGrid& grid) {
  std::vector<double> place[3];
  for (auto& axis : place) axis.resize(kVoxels);
  const int corner[3] = {at.x * kEdge, at.y * kEdge, at.z * kEdge};
  for (int v = 0; v < kVoxels; ++v) {
    const int within[3] = {v / (kEdge * kEdge), v / kEdge % kEdge, v % kEdge};
    for (int a = 0; a < 3; ++a) place[a][v] = grid.origin[a] + (corner[a] + within[a] + 0.5) * grid.voxel;
  }
  std::vector<float> numbers((all_lines + 1) * kVoxels, 0.0f);
  std::vector<float*> of_line(all_lines);
  for (int l = 0; l < all_lines; ++l) of_line[l] = numbers.data() + l * kVoxels;
  float* density = numbers.data() + all_lines * kVoxels;
  const double* const points[3] = {place[0].data(), place[1].data(), place[2].data()};
  field.sample(kVoxels, points, of_line.data(), density);
  SparseGrid::Brick out((lines.size() + 1) * kVoxels);
  for (std::size_t c = 0; c <= lines.size(); ++c)
    std::copy_n(c < lines.size() ? of_line[lines[c]] : density, kVoxels, out.begin() + c * kVoxels);
  if (crop)
    for (int v = 0; v < kVoxels; ++v)
      for (int a = 0; a < 3; ++a)
        if (place[a][v] < crop->low[a] || place[a][v] > crop->high[a])
          for (std::size_t c = 0; c <= lines.size(); ++c) out[c * kVoxels + v] = 0.0f;
  if (std::all_of(out.begin(), out.end(), [](float x) { return x == 0.0f; })) out.clear();
  return out;
}

}  // namespace

std::vector<BrickCoordinate> bricks_to_sample(const LightField& field, const SparseGrid& grid,
                                              const std::optional<Box3>& crop) {
  const Box3 box = field.bounds();
  BrickRange range;
  for (int a = 0; a < 3; ++a) {
    const double edge = grid.voxel * kEdge;
    double low = box.low[a], high = box.high[a];
    if (crop) {
      low = std::max(low, crop->low[a]);
      high = std::min(high, crop->high[a]);
    }
    const double first = std::floor((low - grid.origin[a]) / edge),
                 last = std::ceil((high - grid.origin[a]) / edge);
    if (!(first < last)) return {};
    if (first < -1e8 || last > 1e8)
      throw Error(ErrorKind::usage, {"the voxels are too small for where the light is", "", 0, "--voxel-km",
                                     "larger voxels, or a --box", ""});
    range.low[a] = static_cast<int>(first);
    range.high[a] = static_cast<int>(last);
  }
  std::vector<BrickCoordinate> all;
  collect(field, grid, range, all);
  std::sort(all.begin(), all.end());
  return all;
}

double sample_field(const LightField& field, int all_lines, const std::vector<int>& lines,
                    const std::vector<BrickCoordinate>& bricks, const std::optional<Box3>& crop, int threads,
                    const std::function<bool(double)>& room, SparseGrid& grid) {
  std::vector<SparseGrid::Brick> some(kBricksAtOnce);
  for (std::size_t first = 0; first < bricks.size(); first += kBricksAtOnce) {
    const std::size_t count = std::min(kBricksAtOnce, bricks.size() - first);
    parallel_for(count, threads, [&](std::size_t i, int) {
      some[i] = sampled(field, all_lines, lines, bricks[first + i], crop, grid);
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (some[i].empty()) continue;
      SparseGrid::Brick& to = grid.brick(bricks[first + i]);
      for (std::size_t k = 0; k < to.size(); ++k) to[k] += some[i][k];
    }
    const double share = static_cast<double>(first + count) / static_cast<double>(bricks.size());
    if (!room(share)) return share;
  }
  return 1.0;
}

}  // namespace vegard::sim
