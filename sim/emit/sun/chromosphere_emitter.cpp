#include "sim/emit/sun/chromosphere_emitter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "sim/base/number/escaping_share.h"
#include "sim/emit/sun/line_light.h"
#include "sim/emit/sun/sun_frame.h"

namespace vegard::sim {
namespace {

constexpr double kChromosphereNothingComesThrough = 1e-10;

}  // namespace

/// What a ray has collected. Extinction is the same for all lines, and so is the share of a piece's light.
template <class T>
struct ChromosphereEmitter<T>::RaySum {
  T light{0.0};  ///< of density 1 where the line's is 1
  T kept{1.0};
  double weighted = 0.0;  ///< places, by their light
};

template <class T>
ChromosphereEmitter<T>::ChromosphereEmitter(const Scene& scene, int index, const Image* biasmap,
                                            const NumberAs<T>& number, std::optional<double> instant_s)
    : frame_(scene.sun, number), density_(scene, index, biasmap, number, instant_s), ball_(scene.sun.radius) {
  const Chromosphere& c = scene.chromospheres[static_cast<std::size_t>(index)];
  inner_ = c.innerradius;
  outer_ = c.outerradius;
  step_ = c.step;
  light_ = line_light(scene, c.rayleigh, 0.0, number);
  extinction_ = number(c.extinction);
  // A fit may let it grow from 0, and asks for its slope there.
  absorbs_ = std::is_same_v<T, FreeDual> || value_of(extinction_) > 0.0;
}

template <class T>
void ChromosphereEmitter<T>::march(const RayBundle<T>& rays, const BundleLight<T>& out) const {
  for (std::size_t i = 0; i < rays.count; ++i) {
    const T enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
    march_ray(frame_.ray(enu), rays.end(i), i, rays.count, out);
  }
}

template <class T>
void ChromosphereEmitter<T>::march_ray(const SkyRay<T>& ray, const T& end_km, std::size_t index,
                                       std::size_t rays, const BundleLight<T>& out) const {
  T outer, inner;
  if (!meets_sphere(ray, T(outer_), outer)) return;
  if (!meets_sphere(ray, T(inner_), inner)) inner = T(0.0);
  const T stop = ray_stop(frame_, ray, ball_, end_km);
  const double observer = value_of(ray.observer);
  RaySum sum;
  bool entered = false, comes_through = true;
  for (const bool near : {true, false}) {
    T first = near ? T(0.0) - outer : inner, last = near ? T(0.0) - inner : outer;
    if (value_of(first) < observer) first = ray.observer;
    if (value_of(last) > value_of(stop)) last = stop;
    if (!comes_through || !(value_of(first) < value_of(last))) continue;
    if (!entered) {
      const T entry = (first - ray.observer) * frame_.unit_km();
      out.entry_km[index] = value_of(entry);
      if (out.entry_moving != nullptr) out.entry_moving[index] = entry;
    }
    entered = true;
    comes_through = march_way(ray, first, last, sum);
  }
  double bright = 0.0;
  for (int l = 0; l < out.lines; ++l) {
    const std::size_t to = static_cast<std::size_t>(l) * rays + index;
    out.kept[to] = sum.kept;
    if (light_.empty()) continue;
    out.rayleigh[to] = sum.light * light_[l];
    bright += value_of(out.rayleigh[to]);
  }
  if (bright > 0.0) out.depth_km[index] = (sum.weighted / value_of(sum.light) - observer) * frame_.unit_km();
}

template <class T>
bool ChromosphereEmitter<T>::march_way(const SkyRay<T>& ray, const T& first, const T& last,
                                       RaySum& sum) const {
  const double steps = std::ceil((value_of(last) - value_of(first)) / step_);
  for (double k = 0.0; k < steps; k += 1.0) {
    const T from = first + k * step_, to = k + 1.0 < steps ? first + (k + 1.0) * step_ : last;
    const T length = to - from, middle = (from + to) * 0.5;
    T place[3];
    for (int axis = 0; axis < 3; ++axis) place[axis] = ray.nearest[axis] + ray.direction[axis] * middle;
    const T density = density_.at(place);
    if (!(value_of(density) > 0.0)) continue;
    T seen = sum.kept * density * length;
    if (absorbs_) {
      const T tau = extinction_ * density * length;
      seen = seen * escaping_share(tau);
      sum.kept = sum.kept * exponential(T(0.0) - tau);
    }
    sum.light = sum.light + seen;
    sum.weighted += value_of(seen) * value_of(middle);
    if (std::is_same_v<T, double> && value_of(sum.kept) < kChromosphereNothingComesThrough) return false;
  }
  return true;
}

template class ChromosphereEmitter<double>;
template class ChromosphereEmitter<FreeDual>;

}  // namespace vegard::sim
