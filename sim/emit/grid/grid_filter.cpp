#include "sim/emit/grid/grid_filter.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "sim/base/parallel.h"

namespace vegard::sim {
namespace {

constexpr int kFilterReach = Mask5::kReach, kTaps = Mask5::kSide;
constexpr int kFilterSide = SparseGrid::kEdge + 2 * kFilterReach;  // a brick with what the mask sees about it
constexpr int kFilterBlock = kFilterSide * kFilterSide * kFilterSide;

/// A mask that is a product of three rows, but for its middle: blur and sharpen are.
struct Product {
  float row[3][kTaps];
  float middle;  ///< added to the product's there
};

std::optional<Product> as_product(const Mask5& mask) {
  // One off the middle along all axes, which stands for the rows through it.
  const double corner = mask.weights[Mask5::at(-1, -1, -1)];
  if (corner == 0.0) return std::nullopt;
  double row[3][kTaps], largest = 0.0;
  for (int o = -kFilterReach; o <= kFilterReach; ++o) {
    row[0][o + kFilterReach] = mask.weights[Mask5::at(o, -1, -1)];
    row[1][o + kFilterReach] = mask.weights[Mask5::at(-1, o, -1)] / corner;
    row[2][o + kFilterReach] = mask.weights[Mask5::at(-1, -1, o)] / corner;
  }
  for (const double weight : mask.weights) largest = std::max(largest, std::abs(weight));
  Product product{};
  for (int i = 0; i < kTaps; ++i)
    for (int j = 0; j < kTaps; ++j)
      for (int k = 0; k < kTaps; ++k) {
        const double more = mask.weights[(i * kTaps + j) * kTaps + k] - row[0][i] * row[1][j] * row[2][k];
        if (i == kFilterReach && j == kFilterReach && k == kFilterReach)
          product.middle = static_cast<float>(more);
        else if (std::abs(more) > 1e-12 * largest)
          return std::nullopt;
      }
  for (int axis = 0; axis < 3; ++axis)
    for (int o = 0; o < kTaps; ++o) {
      // Over a tiny corner rows are so large that their products with numbers would be no floats.
      if (!(std::abs(row[axis][o]) <= Mask5::kMaxWeight)) return std::nullopt;
      product.row[axis][o] = static_cast<float>(row[axis][o]);
    }
  return product;
}

/// A channel of the brick and of those about it, [kFilterSide^3].
void gather(const SparseGrid& grid, int channel, const BrickCoordinate& at, float* block) {
  std::fill(block, block + kFilterBlock, 0.0f);
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const auto found = grid.bricks.find({at.x + x, at.y + y, at.z + z});
        if (found == grid.bricks.end()) continue;
        const float* from = found->second.data() + static_cast<std::size_t>(channel) * SparseGrid::kVoxels;
        const auto first = [](int d) { return d < 0 ? SparseGrid::kEdge - kFilterReach : 0; };
        const auto last = [](int d) { return d > 0 ? kFilterReach : SparseGrid::kEdge; };
        for (int i = first(x); i < last(x); ++i)
          for (int j = first(y); j < last(y); ++j)
            for (int k = first(z); k < last(z); ++k)
              block[((i + x * SparseGrid::kEdge + kFilterReach) * kFilterSide + j + y * SparseGrid::kEdge +
                     kFilterReach) *
                        kFilterSide +
                    k + z * SparseGrid::kEdge + kFilterReach] = from[SparseGrid::within(i, j, k)];
      }
}

/// out[n] = sum over o of row[o] in[n + (4 - o) pitch]
void along(const float* in, std::size_t pitch, const float row[kTaps], float* out, int count) {
  for (int n = 0; n < count; ++n) {
    float sum = 0.0f;
    for (int o = 0; o < kTaps; ++o) sum += row[o] * in[n + (kTaps - 1 - o) * pitch];
    out[n] = sum;
  }
}

void convolve(const Product& product, const float* block, float* out) {
  constexpr int kPlane = kFilterSide * kFilterSide, kRow = kFilterSide;
  float by_x[SparseGrid::kEdge * kPlane], by_y[SparseGrid::kEdge * SparseGrid::kEdge * kFilterSide];
  for (int i = 0; i < SparseGrid::kEdge; ++i)
    along(block + i * kPlane, kPlane, product.row[0], by_x + i * kPlane, kPlane);
  for (int i = 0; i < SparseGrid::kEdge; ++i)
    for (int j = 0; j < SparseGrid::kEdge; ++j)
      along(by_x + i * kPlane + j * kRow, kRow, product.row[1],
            by_y + (i * SparseGrid::kEdge + j) * kFilterSide, kFilterSide);
  for (int i = 0; i < SparseGrid::kEdge; ++i)
    for (int j = 0; j < SparseGrid::kEdge; ++j)
      along(by_y + (i * SparseGrid::kEdge + j) * kFilterSide, 1, product.row[2],
            out + (i * SparseGrid::kEdge + j) * SparseGrid::kEdge, SparseGrid::kEdge);
  if (product.middle != 0.0f)
    for (int i = 0; i < SparseGrid::kEdge; ++i)
      for (int j = 0; j < SparseGrid::kEdge; ++j)
        for (int k = 0; k < SparseGrid::kEdge; ++k)
          out[SparseGrid::within(i, j, k)] +=
              product.middle *
              block[((i + kFilterReach) * kFilterSide + j + kFilterReach) * kFilterSide + k + kFilterReach];
}

void convolve(const Mask5& mask, const float* block, float* out) {
  std::fill(out, out + SparseGrid::kVoxels, 0.0f);
  for (int x = -kFilterReach; x <= kFilterReach; ++x)
    for (int y = -kFilterReach; y <= kFilterReach; ++y)
      for (int z = -kFilterReach; z <= kFilterReach; ++z) {
        const auto weight = static_cast<float>(mask.weights[Mask5::at(x, y, z)]);
        if (weight == 0.0f) continue;
        for (int i = 0; i < SparseGrid::kEdge; ++i)
          for (int j = 0; j < SparseGrid::kEdge; ++j) {
            const float* from = block +
                                ((i + kFilterReach - x) * kFilterSide + j + kFilterReach - y) * kFilterSide +
                                kFilterReach - z;
            float* to = out + SparseGrid::within(i, j, 0);
            for (int k = 0; k < SparseGrid::kEdge; ++k) to[k] += weight * from[k];
          }
      }
}

/// Those that the mask reaches from voxels that are not 0.
std::set<BrickCoordinate> reached(const SparseGrid& grid) {
  std::set<BrickCoordinate> all;
  for (const auto& [at, numbers] : grid.bricks) {
    int low[3] = {SparseGrid::kEdge, SparseGrid::kEdge, SparseGrid::kEdge}, high[3] = {-1, -1, -1};
    for (std::size_t c = 0; c < grid.channels.size(); ++c)
      for (int v = 0; v < SparseGrid::kVoxels; ++v) {
        if (numbers[c * SparseGrid::kVoxels + v] == 0.0f) continue;
        const int index[3] = {v / (SparseGrid::kEdge * SparseGrid::kEdge),
                              v / SparseGrid::kEdge % SparseGrid::kEdge, v % SparseGrid::kEdge};
        for (int a = 0; a < 3; ++a) {
          low[a] = std::min(low[a], index[a]);
          high[a] = std::max(high[a], index[a]);
        }
      }
    if (high[0] < 0) continue;
    int from[3], to[3];
    for (int a = 0; a < 3; ++a) {
      from[a] = low[a] < kFilterReach ? -1 : 0;
      to[a] = high[a] >= SparseGrid::kEdge - kFilterReach ? 1 : 0;
    }
    for (int x = from[0]; x <= to[0]; ++x)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int z = from[2]; z <= to[2]; ++z) all.insert({at.x + x, at.y + y, at.z + z});
  }
  return all;
}

}  // namespace

void filter_grid(SparseGrid& grid, const Mask5& mask, int threads) {
  const std::optional<Product> product = as_product(mask);
  const bool may_fall_below =
      std::any_of(mask.weights.begin(), mask.weights.end(), [](double weight) { return weight < 0.0; });
  const std::set<BrickCoordinate> wanted = reached(grid);
  const int channels = static_cast<int>(grid.channels.size());
  std::map<BrickCoordinate, SparseGrid::Brick> done;
  // Layers of bricks of one x, so that what lies behind can go.
  for (auto first = wanted.begin(); first != wanted.end();) {
    std::vector<BrickCoordinate> layer;
    const int x = first->x;
    for (; first != wanted.end() && first->x == x; ++first) layer.push_back(*first);
    std::vector<SparseGrid::Brick> made(layer.size());
    parallel_for(layer.size(), threads, [&](std::size_t b, int) {
      std::vector<float> block(kFilterBlock);
      SparseGrid::Brick out(static_cast<std::size_t>(channels) * SparseGrid::kVoxels);
      for (int c = 0; c < channels; ++c) {
        gather(grid, c, layer[b], block.data());
        float* to = out.data() + static_cast<std::size_t>(c) * SparseGrid::kVoxels;
        if (product)
          convolve(*product, block.data(), to);
        else
          convolve(mask, block.data(), to);
      }
      if (may_fall_below)
        for (float& number : out) number = std::max(number, 0.0f);
      const bool lit = std::any_of(out.begin(), out.end(), [](float number) { return number != 0.0f; });
      if (lit) made[b] = std::move(out);
    });
    for (std::size_t b = 0; b < layer.size(); ++b)
      if (!made[b].empty()) done.emplace_hint(done.end(), layer[b], std::move(made[b]));
    while (!grid.bricks.empty() && grid.bricks.begin()->first.x < x) grid.bricks.erase(grid.bricks.begin());
  }
  grid.bricks = std::move(done);
}

}  // namespace vegard::sim
