#include "sim/emit/nebula/nebula_emitter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "sim/base/number/escaping_share.h"
#include "sim/emit/nebula/nebula_frame.h"
#include "sim/light/emitter.h"

namespace vegard::sim {
namespace {

constexpr double kNebulaNothingComesThrough = 1e-10;

}  // namespace

template <class T>
NebulaEmitter<T>::NebulaEmitter(const Scene& scene, const Nebula& nebula, const NumberAs<T>& number,
                                bool skip)
    : frame_(nebula, number), cloud_(scene, nebula, number), step_(nebula.step), skip_(skip) {}

template <class T>
void NebulaEmitter<T>::march(const RayBundle<T>& rays, const BundleLight<T>& out) const {
  for (std::size_t i = 0; i < rays.count; ++i) {
    const T enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
    march_ray(enu, rays.end_km[i], i, rays.count, out);
  }
}

template <class T>
void NebulaEmitter<T>::march_ray(const T enu[3], double end_km, std::size_t index, std::size_t rays,
                                 const BundleLight<T>& out) const {
  const NebulaRay<T> ray = frame_.ray(enu);
  if (!ray.meets) return;
  // From the nearest place: the observer is at ray.observer, and the way begins there or at the bound.
  T first = T(0.0) - ray.half_chord, last = ray.half_chord;
  const double observer = value_of(ray.observer);
  if (value_of(first) < observer) first = ray.observer;
  const double end = observer + end_km / frame_.unit_km();
  if (value_of(last) > end) last = T(end);
  if (!(value_of(first) < value_of(last))) return;
  out.entry_km[index] = (value_of(first) - observer) * frame_.unit_km();

  double bright = 0.0, weighted = 0.0, max_kept = 1.0;
  T light[kMaxLines], kept[kMaxLines];
  for (int l = 0; l < out.lines; ++l) {
    light[l] = T(0.0);
    kept[l] = T(1.0);
  }
  const double begin = std::floor(value_of(first) / step_), finish = std::ceil(value_of(last) / step_);
  for (double piece = begin; piece < finish; piece += 1.0) {
    const double low = piece * step_, high = low + step_;
    if (skip_) {
      const double middle = low + 0.5 * step_;
      double here[3];
      for (int axis = 0; axis < 3; ++axis)
        here[axis] = value_of(ray.nearest[axis]) + middle * value_of(ray.direction[axis]);
      // The middle of a piece cut short is half a step nearer at most.
      const double empty = cloud_.empty_about(here) - 0.5 * step_;
      if (empty > 0.0) {
        piece += std::floor(std::min(empty / step_, finish - piece));
        continue;
      }
    }
    const T from = low < value_of(first) ? first : T(low), to = high > value_of(last) ? last : T(high);
    const T length = to - from, middle = (from + to) * 0.5;
    T point[3];
    for (int axis = 0; axis < 3; ++axis) point[axis] = ray.nearest[axis] + ray.direction[axis] * middle;
    CloudAt<T> at;
    if (!cloud_.sample(point, at)) continue;
    double seen_here = 0.0;
    max_kept = 0.0;
    for (int l = 0; l < out.lines; ++l) {
      T seen = kept[l] * at.light[l] * length;
      if (cloud_.has_dust()) {
        const T tau = at.loss[l] * length;
        seen = seen * escaping_share(tau);
        kept[l] = kept[l] * exponential(T(0.0) - tau);
      }
      light[l] = light[l] + seen;
      seen_here += value_of(seen);
      max_kept = std::max(max_kept, value_of(kept[l]));
    }
    bright += seen_here;
    weighted += seen_here * value_of(middle);
    if (std::is_same_v<T, double> && max_kept < kNebulaNothingComesThrough) break;
  }
  for (int l = 0; l < out.lines; ++l) {
    const std::size_t to = static_cast<std::size_t>(l) * rays + index;
    out.rayleigh[to] = light[l];
    out.kept[to] = kept[l];
  }
  if (bright > 0.0) out.depth_km[index] = (weighted / bright - observer) * frame_.unit_km();
}

template class NebulaEmitter<double>;
template class NebulaEmitter<FreeDual>;

NebulaField::NebulaField(const Scene& scene, const Nebula& nebula)
    : cloud_(scene, nebula, plain_number),
      lines_(static_cast<int>(scene.emission.lines.size())),
      unit_cm_(nebula.unit_pc * kKmPerParsec * kCmPerKm),
      bound_(nebula.bound) {}

Box3 NebulaField::bounds() const { return {{-bound_, -bound_, -bound_}, {bound_, bound_, bound_}}; }

bool NebulaField::is_dark(const Box3& box) const {
  double middle[3], half_square = 0.0, nearest_square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    middle[axis] = 0.5 * (box.low[axis] + box.high[axis]);
    const double half = 0.5 * (box.high[axis] - box.low[axis]);
    const double outside = std::max(std::abs(middle[axis]) - half, 0.0);
    half_square += half * half;
    nearest_square += outside * outside;
  }
  return nearest_square > bound_ * bound_ || cloud_.empty_about(middle) > std::sqrt(half_square);
}

void NebulaField::sample(std::size_t count, const double* const point[3], float* const emission[],
                         float* density) const {
  for (std::size_t i = 0; i < count; ++i) {
    const double here[3] = {point[0][i], point[1][i], point[2][i]};
    for (int l = 0; l < lines_; ++l) emission[l][i] = 0.0f;
    density[i] = 0.0f;
    if (here[0] * here[0] + here[1] * here[1] + here[2] * here[2] > bound_ * bound_) continue;
    CloudAt<double> at;
    if (cloud_.empty_about(here) > 0.0 || !cloud_.sample(here, at)) continue;
    const CloudDensity densities = cloud_.densities(here);
    density[i] = static_cast<float>(cloud_.has_dust() ? densities.dust : densities.gas);
    for (int l = 0; l < lines_; ++l)
      emission[l][i] = static_cast<float>(photons_per_volume(at.light[l], unit_cm_));
  }
}

}  // namespace vegard::sim
