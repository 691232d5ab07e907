#include "sim/emit/grid/grid_emitter.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "sim/base/number/escaping_share.h"
#include "sim/emit/grid/grid_home.h"
#include "sim/emit/grid/grid_lamp.h"
#include "sim/emit/grid/grid_trilinear.h"
#include "sim/emit/grid/grid_walk.h"

namespace vegard::sim {
namespace {

// The inputs of a ray are its origin and direction, in voxels, the extinction and the asymmetry of
// scattering.
constexpr int kInputs = 8, kExtinction = 6, kAsymmetry = 7;
using RayDual = Dual<double, Tangents<double, kInputs>>;

template <class N>
struct RayLight {
  N light[kMaxLines];  ///< sums of the samples
  N depth;             ///< optical
  N scattered;         ///< of a lamp of flux 1, by an albedo of 1, in rayleighs to 10^6 photons cm^-2 s^-1
  double scattered_km = 0.0;  ///< the same times the distance
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

/// The lamp that lights the grid.
struct Lamp {
  const LampPlace& place;
  const LampColumns& columns;
  double voxel_km;
};

bool same_place(const LampPlace& a, const LampPlace& b) {
  return a.is_far == b.is_far && a.stop == b.stop && std::equal(a.at, a.at + 3, b.at);
}

double with_input(double value, int, double) { return value; }
RayDual with_input(double value, int input, const RayDual&) {
  RayDual out(value);
  out.d.t[input] = 1.0;
  return out;
}
double on_ray(const GridRay& ray, int axis, double t, double) { return ray.from[axis] + t * ray.along[axis]; }
RayDual on_ray(const GridRay& ray, int axis, double t, const RayDual&) {
  RayDual out(ray.from[axis] + t * ray.along[axis]);
  out.d.t[axis] = 1.0;
  out.d.t[3 + axis] = t;
  return out;
}

/// 4 pi times the phase function towards the ray's beginning, and the lamp's flux, at the distance t.
template <class N>
N lamp_at(const Lamp& lamp, const GridRay& ray, double t, const N& asymmetry) {
  N to_lamp[3], square(0.0), cosine(0.0), flux(1.0);
  for (int a = 0; a < 3; ++a) {
    if (lamp.place.is_far)
      to_lamp[a] = N(lamp.place.at[a]);
    else
      to_lamp[a] = N(lamp.place.at[a]) - on_ray(ray, a, t, asymmetry);
    square = square + to_lamp[a] * to_lamp[a];
    cosine = cosine + to_lamp[a] * with_input(ray.along[a], 3 + a, asymmetry);
  }
  cosine = cosine * lamp.voxel_km;
  if (!lamp.place.is_far) {
    if (value_of(square) <= lamp.place.stop * lamp.place.stop) return N(0.0);
    constexpr double kNearest = 0.5;  // voxels, within which a point's light is left out
    if (value_of(square) < kNearest * kNearest) return N(0.0);
    cosine = cosine / square_root(square);
    flux = N(1.0) / square;
  }
  return flux * henyey_greenstein(cosine, asymmetry) * (4.0 * kPi);
}

/// One ray, sample by sample. `extinction` per km. Without a lamp nothing is scattered.
template <class N>
RayLight<N> march_ray(const GridBricks& grid, const GridRay& ray, double end_km, double step_km, bool absorbs,
                      const N& extinction, const Lamp* lamp, const N& asymmetry) {
  RayLight<N> out;
  out.scattered = N(0.0);
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
        if (lamp != nullptr) {
          const N column = sample(cell, lamp->columns.of_brick(brick), 1, t, extinction);
          const N light = seen * x * lamp_at(*lamp, ray, t, asymmetry) * kept_through(extinction * column);
          out.scattered = out.scattered + light;
          out.scattered_km += value_of(light) * t;
        }
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

constexpr double kBrick = GridBricks::kEdge, kCoarseCell = kBrick * GridBricks::kCoarse;

}  // namespace

template <class T>
GridEmitter<T>::GridEmitter(const GridBricks& grid, const Volume& volume, const NumberAs<T>& number,
                            const Sun* sun, double share, double turned_rad, int threads,
                            const GridEmitter* other)
    : grid_(grid),
      home_(grid_home(grid, volume, sun, number, turned_rad)),
      extinction_(number(volume.extinction_per_km)),
      step_km_(volume.step_voxels * home_.voxel_km),
      absorbs_(grid.has_density() && volume.extinction_per_km > 0.0),
      albedo_(number(volume.albedo)),
      asymmetry_(number(volume.asymmetry)) {
  for (T& light : home_.light)
    if (share != 1.0) light = light * share;
  // A free extinction that is 0 at present has a derivative, and so has an albedo.
  bool scatters = volume.albedo > 0.0;
  if constexpr (std::is_same_v<T, FreeDual>)
    for (int i = 0; i < kTangentWidth; ++i) {
      absorbs_ = absorbs_ || (grid.has_density() && extinction_.d.t[i] != 0.0);
      scatters = scatters || albedo_.d.t[i] != 0.0;
    }
  is_lit_ = absorbs_ && scatters && volume.lamp != VolumeLamp::none && !grid.empty();
  if (!is_lit_) return;
  lamp_ = lamp_place(grid, volume, sun, turned_rad);
  flux_ = lamp_flux(grid, volume, sun);
  if (other != nullptr && other->is_lit_ && same_place(other->lamp_, lamp_))
    columns_ = other->columns_;
  else
    columns_ = std::make_shared<const LampColumns>(grid, lamp_, home_.voxel_km, threads);
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
  N asymmetry(value_of(asymmetry_));
  if constexpr (std::is_same_v<T, FreeDual>) {
    extinction.d.t[kExtinction] = 1.0;
    asymmetry.d.t[kAsymmetry] = 1.0;
  }
  const Lamp lamp{lamp_, *columns_, home_.voxel_km};
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
    input[kExtinction] = extinction_;
    input[kAsymmetry] = asymmetry_;
    const RayLight<N> sum = march_ray<N>(grid_, way, rays.end_km[r], step_km_, absorbs_, extinction,
                                         is_lit_ ? &lamp : nullptr, asymmetry);
    double own = 0.0, from_lamp = 0.0;
    for (int l = 0; l < out.lines; ++l) {
      out.rayleigh[l * rays.count + r] = scale[l] * chained(sum.light[l], input);
      if (absorbs_) out.kept[l * rays.count + r] = chained(kept_through(sum.depth), input);
      if (!is_lit_) continue;
      own += value_of(out.rayleigh[l * rays.count + r]);
      const T scattered = albedo_ * chained(sum.scattered, input) * flux_[l];
      from_lamp += value_of(scattered);
      out.rayleigh[l * rays.count + r] = out.rayleigh[l * rays.count + r] + scattered;
    }
    out.entry_km[r] = sum.entry_km;
    if (sum.weight > 0.0) out.depth_km[r] = sum.weighted_km / sum.weight;
    if (from_lamp > 0.0) {
      const double lit_km = sum.scattered_km / value_of(sum.scattered);
      out.depth_km[r] = own > 0.0 ? (own * out.depth_km[r] + from_lamp * lit_km) / (own + from_lamp) : lit_km;
    }
  }
}

template class GridEmitter<double>;
template class GridEmitter<FreeDual>;

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
