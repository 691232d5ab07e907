#include "sim/emit/grid/grid_march.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/emit/grid/grid_march.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kBatch = 16;  // samples whose places are worked out together

/// Where samples of a batch are in their brick.
struct SamplePlaces {
  HWY_ALIGN std::int32_t offset[kBatch];  ///< of the lowest of the eight voxels
  HWY_ALIGN float weight[4][kBatch];      ///< of the four rows along z
  HWY_ALIGN float up[kBatch];             ///< share of the upper voxel of a row
};

/// Sample j of the batch is at start + (first + j) step, in voxels from the brick's corner.
HWY_INLINE void place_samples(const float start[3], const float step[3], int first, SamplePlaces& out) {
  const hn::CappedTag<float, kBatch> d;
  const hn::RebindToSigned<decltype(d)> di;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto one = hn::Set(d, 1.0f);
  for (int j = 0; j < kBatch; j += lanes) {
    const auto number = hn::ConvertTo(d, hn::Iota(di, first + j));
    hn::Vec<decltype(d)> within[3];
    hn::Vec<decltype(di)> voxel[3];
    for (int a = 0; a < 3; ++a) {
      auto at = hn::Add(hn::Set(d, start[a]), hn::Mul(number, hn::Set(d, step[a])));
      // Rounding may put a sample just outside; then the nearest face's cell is its own.
      at = hn::Min(hn::Max(at, hn::Zero(d)), hn::Set(d, 8.0f));
      voxel[a] = hn::Min(hn::ConvertTo(di, at), hn::Set(di, 7));
      within[a] = hn::Sub(at, hn::ConvertTo(d, voxel[a]));
    }
    const auto offset = hn::Add(hn::Mul(hn::Add(hn::Mul(voxel[0], hn::Set(di, GridBricks::kSide)), voxel[1]),
                                        hn::Set(di, GridBricks::kSide)),
                                voxel[2]);
    hn::Store(offset, di, out.offset + j);
    const auto x = within[0], y = within[1];
    const auto off_x = hn::Sub(one, x), off_y = hn::Sub(one, y);
    hn::Store(hn::Mul(off_x, off_y), d, out.weight[0] + j);
    hn::Store(hn::Mul(off_x, y), d, out.weight[1] + j);
    hn::Store(hn::Mul(x, off_y), d, out.weight[2] + j);
    hn::Store(hn::Mul(x, y), d, out.weight[3] + j);
    hn::Store(within[2], d, out.up + j);
  }
}

/// The two voxels of a row lie side by side: 2 kStride numbers are worked on as one.
template <int kStride>
HWY_INLINE void sum_brick(const float* brick, const float start[3], const float step[3], int count,
                          float* light, float* moment) {
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
  SamplePlaces places;
  for (int first = 0; first < count; first += kBatch) {
    place_samples(start, step, first, places);
    const int n = std::min(kBatch, count - first);
    for (int j = 0; j < n; ++j) {
      const float* at = brick + places.offset[j] * kStride;
      const V w0 = hn::Set(d, places.weight[0][j]), w1 = hn::Set(d, places.weight[1][j]),
              w2 = hn::Set(d, places.weight[2][j]), w3 = hn::Set(d, places.weight[3][j]),
              up = hn::Set(d, places.up[j]), number = hn::Set(d, static_cast<float>(first + j));
      for (int p = 0; p < kParts; ++p) {
        const float* row = at + p * kLanes;
        constexpr int kY = GridBricks::kSide * kStride, kX = GridBricks::kSide * kY;
        const V low = hn::Add(hn::Mul(hn::LoadU(d, row), w0), hn::Mul(hn::LoadU(d, row + kY), w1));
        const V high = hn::Add(hn::Mul(hn::LoadU(d, row + kX), w2), hn::Mul(hn::LoadU(d, row + kX + kY), w3));
        const V value = hn::Mul(hn::Add(low, high), hn::Add(base[p], hn::Mul(tilt[p], up)));
        sum[p] = hn::Add(sum[p], value);
        times[p] = hn::Add(times[p], hn::Mul(value, number));
      }
    }
  }
  for (int p = 0; p < kParts; ++p) {
    hn::StoreU(sum[p], d, light + p * kLanes);
    hn::StoreU(times[p], d, moment + p * kLanes);
  }
}

template <int kStride>
void march_rays(const GridBricks& grid, std::size_t rays, const GridRay* ray, const double* end_km,
                double step_km, GridSum* sums) {
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
          const std::int64_t first = first_sample(enter, step_km), end = first_sample(leave, step_km);
          if (end <= first) return;
          const double t = (static_cast<double>(first) + 0.5) * step_km;
          float start[3];
          for (int a = 0; a < 3; ++a)
            start[a] = static_cast<float>(way.from[a] + t * way.along[a] - GridBricks::kEdge * at[a]);
          float light[2 * kStride], moment[2 * kStride];
          sum_brick<kStride>(grid.emission(brick), start, step, static_cast<int>(end - first), light, moment);
          double all = 0.0, later = 0.0;
          for (int l = 0; l < kStride; ++l) {
            const double of_line = static_cast<double>(light[l]) + light[kStride + l];
            sum.light[l] += of_line;
            all += of_line;
            later += static_cast<double>(moment[l]) + moment[kStride + l];
          }
          sum.weighted_km += t * all + step_km * later;
        });
  }
}

void MarchGrid(const GridBricks& grid, std::size_t rays, const GridRay* ray, const double* end_km,
               double step_km, GridSum* sums) {
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
