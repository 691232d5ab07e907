#include "sim/emit/grid/grid_emitter.h"

#include <type_traits>
#include <vector>

#include "sim/base/number/escaping_share.h"
#include "sim/emit/grid/grid_march.h"
#include "sim/emit/grid/grid_trilinear.h"

namespace vegard::sim {
namespace {

constexpr int kInputs = 7;  // of a ray: where it begins and its direction, in voxels, and the extinction
using RayDual = Dual<double, Tangents<double, kInputs>>;

template <class N>
struct RayLight {
  N light[kMaxLines];  ///< sums of the samples
  N depth;             ///< optical
  double weight = 0.0, weighted_km = 0.0, entry_km = std::numeric_limits<double>::infinity();
};

double sample(const GridCell& cell, const float* numbers, int stride, double, double) {
  return cell.value(numbers, stride);
}

RayDual sample(const GridCell& cell, const float* numbers, int stride, double t, const RayDual&) {
  double slope[3];
  RayDual out(cell.value(numbers, stride, slope));
  for (int a = 0; a < 3; ++a) {
    out.d.t[a] = slope[a];
    out.d.t[3 + a] = slope[a] * t;
  }
  return out;
}

double kept_through(double depth) { return std::exp(-depth); }
RayDual kept_through(const RayDual& depth) {
  const double kept = std::exp(-depth.v);
  return {kept, depth.d * -kept};
}

/// One ray, sample by sample. `extinction` per km.
template <class N>
RayLight<N> march_ray(const GridBricks& grid, const GridRay& ray, double end_km, double step_km, bool absorbs,
                      const N& extinction) {
  RayLight<N> out;
  for (N& light : out.light) light = N(0.0);
  out.depth = N(0.0);
  walk_bricks(grid, ray, end_km, [&](std::int32_t brick, const int at[3], double enter, double leave) {
    out.entry_km = std::min(out.entry_km, enter);
    const float* emission = grid.emission(brick);
    const std::int64_t end = first_sample(leave, 1.0 / step_km);
    for (std::int64_t k = first_sample(enter, 1.0 / step_km); k < end; ++k) {
      const double t = (static_cast<double>(k) + 0.5) * step_km;
      double local[3];
      for (int a = 0; a < 3; ++a) local[a] = ray.from[a] + t * ray.along[a] - GridBricks::kEdge * at[a];
      const GridCell cell(local);
      N seen(1.0);
      if (absorbs) {
        const N x = extinction * sample(cell, grid.density(brick), 1, t, extinction) * step_km;
        seen = kept_through(out.depth) * escaping_share(x);
        out.depth = out.depth + x;
      }
      for (int l = 0; l < grid.lines(); ++l) {
        N light = sample(cell, emission + l, grid.stride(), t, extinction);
        if (absorbs) light = light * seen;
        out.light[l] = out.light[l] + light;
        out.weight += value_of(light);
        out.weighted_km += value_of(light) * t;
      }
    }
  });
  return out;
}

double chained(double value, const double (&)[kInputs]) { return value; }
FreeDual chained(const RayDual& value, const FreeDual (&input)[kInputs]) {
  FreeDual out(value.v);
  for (int i = 0; i < kInputs; ++i) out.d = out.d + input[i].d * value.d.t[i];
  return out;
}

}  // namespace

template <class T>
GridEmitter<T>::GridEmitter(const GridBricks& grid, const Volume& volume, const NumberAs<T>& number,
                            const Sun* sun, double share, double turned_rad)
    : grid_(grid),
      home_(grid_home(grid, volume, sun, number, turned_rad)),
      extinction_(number(volume.extinction_per_km)),
      step_km_(volume.step_voxels * home_.voxel_km),
      absorbs_(grid.has_density() && volume.extinction_per_km > 0.0) {
  for (T& light : home_.light)
    if (share != 1.0) light = light * share;
  // A free extinction that is 0 at present has a derivative.
  if constexpr (std::is_same_v<T, FreeDual>)
    for (const double tangent : extinction_.d.t)
      absorbs_ = absorbs_ || (grid.has_density() && tangent != 0.0);
}

template <class T>
void GridEmitter<T>::march(const RayBundle<T>& rays, const BundleLight<T>& out) const {
  if (grid_.empty()) return;
  const auto along_of = [&](std::size_t r, T(&along)[3]) {
    for (int a = 0; a < 3; ++a) {
      along[a] = T(0.0);
      for (int c = 0; c < 3; ++c) along[a] = along[a] + rays.direction[c][r] * home_.turn[a][c];
    }
  };
  T scale[kMaxLines];
  for (int l = 0; l < out.lines; ++l) scale[l] = home_.light[l] * step_km_;
  if constexpr (std::is_same_v<T, double>) {
    if (!absorbs_) {
      constexpr std::size_t kAtOnce = 64;
      GridRay way[kAtOnce];
      GridSum sums[kAtOnce];
      for (std::size_t first = 0; first < rays.count; first += kAtOnce) {
        const std::size_t n = std::min(kAtOnce, rays.count - first);
        for (std::size_t i = 0; i < n; ++i) {
          along_of(first + i, way[i].along);
          for (int a = 0; a < 3; ++a) way[i].from[a] = home_.from[a];
          way[i].aim();
        }
        march_grid(grid_, n, way, rays.end_km + first, step_km_, sums);
        for (std::size_t i = 0; i < n; ++i) {
          const std::size_t r = first + i;
          double all = 0.0;
          for (int l = 0; l < out.lines; ++l) {
            out.rayleigh[l * rays.count + r] = scale[l] * sums[i].light[l];
            all += sums[i].light[l];
          }
          out.entry_km[r] = sums[i].entry_km;
          if (all > 0.0) out.depth_km[r] = sums[i].weighted_km / all;
        }
      }
      return;
    }
  }
  using N = std::conditional_t<std::is_same_v<T, double>, double, RayDual>;
  N extinction(value_of(extinction_));
  if constexpr (std::is_same_v<T, FreeDual>) extinction.d.t[6] = 1.0;
  for (std::size_t r = 0; r < rays.count; ++r) {
    T input[kInputs], along[3];
    along_of(r, along);
    GridRay way;
    for (int a = 0; a < 3; ++a) {
      input[a] = home_.from[a];
      input[3 + a] = along[a];
      way.from[a] = value_of(home_.from[a]);
      way.along[a] = value_of(along[a]);
    }
    way.aim();
    input[6] = extinction_;
    const RayLight<N> sum = march_ray<N>(grid_, way, rays.end_km[r], step_km_, absorbs_, extinction);
    for (int l = 0; l < out.lines; ++l) {
      out.rayleigh[l * rays.count + r] = scale[l] * chained(sum.light[l], input);
      if (absorbs_) out.kept[l * rays.count + r] = chained(kept_through(sum.depth), input);
    }
    out.entry_km[r] = sum.entry_km;
    if (sum.weight > 0.0) out.depth_km[r] = sum.weighted_km / sum.weight;
  }
}

template class GridEmitter<double>;
template class GridEmitter<FreeDual>;

}  // namespace vegard::sim
