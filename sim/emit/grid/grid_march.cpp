#include "sim/emit/grid/grid_walk.h"

#include <hwy/cache_control.h>

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/emit/grid/grid_march.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kBatch = 64;  // samples that are summed together
constexpr int kPlaced = 8;  // of which so many are placed at once

/// Samples on their way into a sum. They are placed first, which asks the memory for their voxels, and summed
/// later, when those have come.
struct Batch {
  int count = 0;
  std::int64_t first = 0;             ///< number of the first sample along the ray
  const float* at[kBatch + kPlaced];  ///< the lowest of the eight voxels
  float weight[4][kBatch + kPlaced];  ///< of the four rows along z
  float up[kBatch + kPlaced];         ///< share of the upper voxel of a row
  float number[kBatch + kPlaced];     ///< since the first
};

/// Sample j is at start + j step, in voxels from the brick's corner. Its bits do not depend on the lanes.
template <int kStride>
HWY_INLINE void place_samples(const float* brick, const float start[3], const float step[3], int count,
                              float number, Batch& out) {
  const hn::CappedTag<float, kPlaced> d;
  const hn::RebindToSigned<decltype(d)> di;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto one = hn::Set(d, 1.0f);
  const auto side = hn::Set(di, GridBricks::kSide);
  HWY_ALIGN std::int32_t offset[kPlaced];
  for (int j = 0; j < count; j += lanes) {
    const auto index = hn::ConvertTo(d, hn::Iota(di, j));
    hn::Vec<decltype(d)> within[3];
    hn::Vec<decltype(di)> voxel[3];
    for (int a = 0; a < 3; ++a) {
      auto at = hn::Add(hn::Set(d, start[a]), hn::Mul(index, hn::Set(d, step[a])));
      // Rounding may put a sample just outside; then the nearest face's cell is its own.
      at = hn::Min(hn::Max(at, hn::Zero(d)), hn::Set(d, 8.0f));
      voxel[a] = hn::Min(hn::ConvertTo(di, at), hn::Set(di, 7));
      within[a] = hn::Sub(at, hn::ConvertTo(d, voxel[a]));
    }
    hn::Store(hn::Add(hn::Mul(hn::Add(hn::Mul(voxel[0], side), voxel[1]), side), voxel[2]), di, offset);
    const auto x = within[0], y = within[1];
    const auto off_x = hn::Sub(one, x), off_y = hn::Sub(one, y);
    const int to = out.count + j;
    hn::StoreU(hn::Mul(off_x, off_y), d, out.weight[0] + to);
    hn::StoreU(hn::Mul(off_x, y), d, out.weight[1] + to);
    hn::StoreU(hn::Mul(x, off_y), d, out.weight[2] + to);
    hn::StoreU(hn::Mul(x, y), d, out.weight[3] + to);
    hn::StoreU(within[2], d, out.up + to);
    hn::StoreU(hn::Add(index, hn::Set(d, number)), d, out.number + to);
    for (int i = 0; i < lanes;
         ++i) {  // those beyond the count as well: a guess of it would be wrong too often
      const float* at = brick + offset[i] * kStride;
      out.at[to + i] = at;
      hwy::Prefetch(at);
      hwy::Prefetch(at + GridBricks::kSide * GridBricks::kSide * kStride);
    }
  }
  out.count += count;
}

/// Adds the batch to the ray's sums and empties it. The two voxels of a row lie side by side: 2 kStride
/// numbers are worked on as one.
template <int kStride>
HWY_INLINE void sum_batch(Batch& batch, double step_km, GridSum& ray) {
  constexpr int kRow = 2 * kStride;
  const hn::CappedTag<float, kRow> d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<float, kRow>()));
  static_assert(kRow % kLanes == 0, "whole registers");
  constexpr int kParts = kRow / kLanes;
  using V = hn::Vec<decltype(d)>;
  HWY_ALIGN float constant[kRow], slope[kRow];
  for (int i = 0; i < kRow; ++i) {
    constant[i] = i < kStride ? 1.0f : 0.0f;
    slope[i] = i < kStride ? -1.0f : 1.0f;
  }
  V base[kParts], tilt[kParts], sum[kParts], times[kParts];
  for (int p = 0; p < kParts; ++p) {
    base[p] = hn::Load(d, constant + p * kLanes);
    tilt[p] = hn::Load(d, slope + p * kLanes);
    sum[p] = times[p] = hn::Zero(d);
  }
  for (int j = 0; j < batch.count; ++j) {
    const V w0 = hn::Set(d, batch.weight[0][j]), w1 = hn::Set(d, batch.weight[1][j]),
            w2 = hn::Set(d, batch.weight[2][j]), w3 = hn::Set(d, batch.weight[3][j]),
            up = hn::Set(d, batch.up[j]), number = hn::Set(d, batch.number[j]);
    for (int p = 0; p < kParts; ++p) {
      const float* row = batch.at[j] + p * kLanes;
      constexpr int kY = GridBricks::kSide * kStride, kX = GridBricks::kSide * kY;
      const V low = hn::Add(hn::Mul(hn::LoadU(d, row), w0), hn::Mul(hn::LoadU(d, row + kY), w1));
      const V high = hn::Add(hn::Mul(hn::LoadU(d, row + kX), w2), hn::Mul(hn::LoadU(d, row + kX + kY), w3));
      const V value = hn::Mul(hn::Add(low, high), hn::Add(base[p], hn::Mul(tilt[p], up)));
      sum[p] = hn::Add(sum[p], value);
      times[p] = hn::Add(times[p], hn::Mul(value, number));
    }
  }
  HWY_ALIGN float light[kRow], moment[kRow];
  for (int p = 0; p < kParts; ++p) {
    hn::Store(sum[p], d, light + p * kLanes);
    hn::Store(times[p], d, moment + p * kLanes);
  }
  double all = 0.0, later = 0.0;
  for (int l = 0; l < kStride; ++l) {
    const double of_line = static_cast<double>(light[l]) + light[kStride + l];
    ray.light[l] += of_line;
    all += of_line;
    later += static_cast<double>(moment[l]) + moment[kStride + l];
  }
  ray.weighted_km += step_km * ((static_cast<double>(batch.first) + 0.5) * all + later);
  batch.count = 0;
}

template <int kStride>
void march_rays(const GridBricks& grid, std::size_t rays, const GridRay* ray, const double* end_km,
                double step_km, GridSum* sums) {
  const double per_km = 1.0 / step_km;
  Batch batch;
  for (std::size_t r = 0; r < rays; ++r) {
    GridSum& sum = sums[r];
    sum = {};
    sum.entry_km = std::numeric_limits<double>::infinity();
    const GridRay& way = ray[r];
    float step[3];
    for (int a = 0; a < 3; ++a) step[a] = static_cast<float>(way.along[a] * step_km);
    walk_bricks(
        grid, way, end_km[r], [&](std::int32_t brick, const int at[3], double enter, double leave) HWY_ATTR {
          sum.entry_km = std::min(sum.entry_km, enter);
          std::int64_t first = first_sample(enter, per_km);
          const std::int64_t end = first_sample(leave, per_km);
          while (first < end) {
            if (batch.count == kBatch) sum_batch<kStride>(batch, step_km, sum);
            if (batch.count == 0) batch.first = first;
            const int count = static_cast<int>(std::min<std::int64_t>(end - first, kBatch - batch.count));
            const double t = (static_cast<double>(first) + 0.5) * step_km;
            float start[3];
            for (int a = 0; a < 3; ++a)
              start[a] = static_cast<float>(way.from[a] + t * way.along[a] - GridBricks::kEdge * at[a]);
            place_samples<kStride>(grid.emission(brick), start, step, count,
                                   static_cast<float>(first - batch.first), batch);
            first += count;
          }
        });
    if (batch.count > 0) sum_batch<kStride>(batch, step_km, sum);
  }
}

void MarchGrid(const GridBricks& grid, std::size_t rays, const GridRay* ray, const double* end_km,
               double step_km, GridSum* sums) {
  if (grid.stride() == 1) return march_rays<1>(grid, rays, ray, end_km, step_km, sums);
  if (grid.stride() == 2) return march_rays<2>(grid, rays, ray, end_km, step_km, sums);
  if (grid.stride() == 4) return march_rays<4>(grid, rays, ray, end_km, step_km, sums);
  march_rays<8>(grid, rays, ray, end_km, step_km, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegard::sim {

HWY_EXPORT(MarchGrid);

void march_grid(const GridBricks& grid, std::size_t rays, const GridRay* ray, const double* end_km,
                double step_km, GridSum* sums) {
  HWY_DYNAMIC_DISPATCH(MarchGrid)(grid, rays, ray, end_km, step_km, sums);
}

}  // namespace vegard::sim
#endif
