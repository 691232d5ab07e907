#include "sim/render/volumes/scene_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/parallel.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kSamplingBricksAtOnce = 256;
struct BrickRange {
  int low[3], high[3];  ///< high is the first beyond
};

Box3 box_of(const BrickRange& r, const SparseGrid& grid) {
  Box3 box;
  for (int a = 0; a < 3; ++a) {
    box.low[a] = grid.origin[a] + r.low[a] * SparseGrid::kEdge * grid.voxel;
    box.high[a] = grid.origin[a] + r.high[a] * SparseGrid::kEdge * grid.voxel;
  }
  return box;
}

int widest_of(const BrickRange& r) {
  int widest = 0;
  for (int a = 1; a < 3; ++a)
    if (r.high[a] - r.low[a] > r.high[widest] - r.low[widest]) widest = a;
  return widest;
}

bool is_brick(const BrickRange& r) {
  for (int a = 0; a < 3; ++a)
    if (r.high[a] - r.low[a] > 1) return false;
  return true;
}

void halve(const BrickRange& r, BrickRange& low, BrickRange& high) {
  const int a = widest_of(r);
  low = high = r;
  low.high[a] = high.low[a] = r.low[a] + (r.high[a] - r.low[a]) / 2;
}

/// Light and density of a brick's voxels, [line or density][voxel]; empty if dark.
SparseGrid::Brick sampled(const LightField& field, int all_lines, const std::vector<int>& lines,
                          const BrickCoordinate& at, const std::optional<Box3>& crop,
                          const SparseGrid& grid) {
  std::vector<double> place[3];
  for (auto& axis : place) axis.resize(SparseGrid::kVoxels);
  const int corner[3] = {at.x * SparseGrid::kEdge, at.y * SparseGrid::kEdge, at.z * SparseGrid::kEdge};
  for (int v = 0; v < SparseGrid::kVoxels; ++v) {
    const int within[3] = {v / (SparseGrid::kEdge * SparseGrid::kEdge),
                           v / SparseGrid::kEdge % SparseGrid::kEdge, v % SparseGrid::kEdge};
    for (int a = 0; a < 3; ++a) place[a][v] = grid.origin[a] + (corner[a] + within[a] + 0.5) * grid.voxel;
  }
  std::vector<float> numbers((all_lines + 1) * SparseGrid::kVoxels, 0.0f);
  std::vector<float*> of_line(all_lines);
  for (int l = 0; l < all_lines; ++l) of_line[l] = numbers.data() + l * SparseGrid::kVoxels;
  float* density = numbers.data() + all_lines * SparseGrid::kVoxels;
  const double* const points[3] = {place[0].data(), place[1].data(), place[2].data()};
  field.sample(SparseGrid::kVoxels, points, of_line.data(), density);
  SparseGrid::Brick out((lines.size() + 1) * SparseGrid::kVoxels);
  for (std::size_t c = 0; c <= lines.size(); ++c)
    std::copy_n(c < lines.size() ? of_line[lines[c]] : density, SparseGrid::kVoxels,
                out.begin() + c * SparseGrid::kVoxels);
  if (crop)
    for (int v = 0; v < SparseGrid::kVoxels; ++v)
      for (int a = 0; a < 3; ++a)
        if (place[a][v] < crop->low[a] || place[a][v] > crop->high[a])
          for (std::size_t c = 0; c <= lines.size(); ++c) out[c * SparseGrid::kVoxels + v] = 0.0f;
  if (std::all_of(out.begin(), out.end(), [](float x) { return x == 0.0f; })) out.clear();
  return out;
}

/// Returns whether one brick of the range is lit; it is found by descending into halves that may be lit.
bool is_lit(const LightField& field, int all_lines, const std::vector<int>& lines, BrickRange r,
            unsigned turns, const std::optional<Box3>& crop, const SparseGrid& grid) {
  while (!is_brick(r)) {
    BrickRange half[2];
    halve(r, half[0], half[1]);
    if (turns & 1) std::swap(half[0], half[1]);
    turns = turns >> 1 | (turns & 1) << 31;
    r = half[field.is_dark(box_of(half[0], grid))];
  }
  return !sampled(field, all_lines, lines, {r.low[0], r.low[1], r.low[2]}, crop, grid).empty();
}

/// The share of ranges that have a lit brick, by some of them.
double lit_share(const LightField& field, int all_lines, const std::vector<BrickRange>& ranges,
                 const std::optional<Box3>& crop, const SparseGrid& grid) {
  constexpr std::size_t kTried = 128;
  std::vector<int> lines(all_lines);
  std::iota(lines.begin(), lines.end(), 0);
  const std::size_t tried = std::min(kTried, ranges.size());
  int lit = 0;
  for (std::size_t i = 0; i < tried; ++i)
    lit += is_lit(field, all_lines, lines, ranges[i * ranges.size() / tried],
                  static_cast<unsigned>(i * 2654435761u), crop, grid);
  return static_cast<double>(lit) / static_cast<double>(tried);
}

/// Returns the number of lit bricks if light is a surface: a part that is s bricks wide has s^2 lit ones.
double bricks_of_surface(const std::vector<BrickRange>& ranges) {
  double all = 0.0;
  for (const BrickRange& r : ranges) {
    double volume = 1.0;
    for (int a = 0; a < 3; ++a) volume *= r.high[a] - r.low[a];
    all += std::cbrt(volume * volume);
  }
  return all;
}

}  // namespace

BricksToSample bricks_to_sample(const LightField& field, const SparseGrid& grid,
                                const std::optional<Box3>& crop, int all_lines, double max_bricks,
                                double max_bytes, const std::function<bool()>& go_on) {
  constexpr std::size_t kBetweenQuestions = 1024;
  constexpr double kCertain = 4.0;  // parts above the most bricks, of which a quarter must be lit
  const Box3 box = field.bounds();
  BrickRange range;
  for (int a = 0; a < 3; ++a) {
    const double edge = grid.voxel * SparseGrid::kEdge;
    double low = box.low[a], high = box.high[a];
    if (crop) {
      low = std::max(low, crop->low[a]);
      high = std::min(high, crop->high[a]);
    }
    const double first = std::floor((low - grid.origin[a]) / edge),
                 last = std::ceil((high - grid.origin[a]) / edge);
    if (!(first < last)) return {};
    if (first < -1e8 || last > 1e8)
      throw Error(ErrorKind::usage, "the voxels are too small for where the light is")
          .key("--voxel")
          .expected("larger voxels, or a --box");
    range.low[a] = static_cast<int>(first);
    range.high[a] = static_cast<int>(last);
  }
  std::vector<BrickRange> ranges, halves;
  if (!field.is_dark(box_of(range, grid))) ranges.push_back(range);
  double next_try = kCertain * max_bricks;
  std::size_t asked = 0;
  for (bool whole = false; !whole;) {
    whole = true;
    halves.clear();
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (++asked % kBetweenQuestions == 0 && !go_on()) return {};
      if (is_brick(ranges[i])) {
        halves.push_back(ranges[i]);
        continue;
      }
      BrickRange half[2];
      halve(ranges[i], half[0], half[1]);
      for (const BrickRange& one : half)
        if (!field.is_dark(box_of(one, grid))) {
          halves.push_back(one);
          whole = whole && is_brick(one);
        }
    }
    ranges.swap(halves);
    const double count = static_cast<double>(ranges.size());
    const bool long_list = 2.0 * count * sizeof(BrickRange) > max_bytes;
    if (count <= next_try && !long_list) continue;
    next_try = 2.0 * count;
    const double share = lit_share(field, all_lines, ranges, crop, grid);
    if (share * count > max_bricks || long_list)
      // With larger voxels every part has light rather than that share of them.
      return {{}, std::max(bricks_of_surface(ranges), max_bricks + 1.0)};
  }
  BricksToSample out;
  out.bricks.reserve(ranges.size());
  for (const BrickRange& r : ranges) out.bricks.push_back({r.low[0], r.low[1], r.low[2]});
  std::sort(out.bricks.begin(), out.bricks.end());
  return out;
}

double sample_field(const LightField& field, int all_lines, const std::vector<int>& lines,
                    const std::vector<BrickCoordinate>& bricks, const std::optional<Box3>& crop, int threads,
                    const std::function<bool(double)>& room, SparseGrid& grid) {
  std::vector<SparseGrid::Brick> some(kSamplingBricksAtOnce);
  for (std::size_t first = 0; first < bricks.size(); first += kSamplingBricksAtOnce) {
    const std::size_t count = std::min(kSamplingBricksAtOnce, bricks.size() - first);
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
