#include "sim/emit/sun/strand/ejection_shell.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/gauss_quadrature.h"
#include "sim/emit/sun/line_light.h"
#include "sim/emit/sun/strand/flux_rope.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/light/emitter.h"

namespace vegard::sim {
template <class T>
EjectionShell<T>::EjectionShell(const Sun& sun, const Ejection& ejection, const T& longitude_deg,
                                const T& front, const NumberAs<T>& number)
    : density(1.0) {
  const T sine_half = sine(number(ejection.width_deg) * (kPi / 360.0));
  const T distance = (number(sun.radius) + front) / (sine_half + 1.0);
  const SunPlace<T> place = sun_place(number(ejection.latitude_deg), longitude_deg);
  for (int i = 0; i < 3; ++i) middle[i] = place.up[i] * distance;
  outer = distance * sine_half;
  const T left = outer - number(ejection.aspect) * front;
  inner = value_of(left) > 0.0 ? left : T(0.0);
}

template <class T>
EjectionShell<T>::EjectionShell(const Sun& sun, double instant_s, const Ejection& ejection,
                                const NumberAs<T>& number)
    : EjectionShell(sun, ejection, ejection_longitude_deg(sun, instant_s, ejection, number),
                    front_height(sun, instant_s, ejection, number), number) {
  const T radius = number(sun.radius);
  const EjectionShell at_first(sun, ejection, number(ejection.longitude_deg), number(ejection.start_height),
                               number);
  density = number(ejection.density) * (at_first.mass(radius) / mass(radius));
}

template <class T>
T EjectionShell<T>::density_at(const T& square) const {
  const T i = inner * inner, o = outer * outer;
  if (!(value_of(square) > value_of(i) && value_of(square) < value_of(o))) return T(0.0);
  const T width = o - i;
  return density * 4.0 * (square - i) * (o - square) / (width * width);
}

template <class T>
T EjectionShell<T>::mass(const T& sun_radius) const {
  // The integral runs over spheres of radius p about the middle, which is at the distance D. The part of a
  // sphere above cos = (R² - D² - p²) / (2 D p) is outside of the photosphere, with the area 2 π p² (1 -
  // cos). At p = |R - D|, where none or all of it is outside, the formula changes; on either side it is a
  // polynomial, and so is the density.
  const T distance = length3(middle);
  const double edge = std::abs(value_of(sun_radius) - value_of(distance));
  const T touching =
      value_of(sun_radius) > value_of(distance) ? sun_radius - distance : distance - sun_radius;
  const auto part = [&](const T& from, const T& to) {
    static const GaussLegendre<4> nodes;  // exact to the seventh degree, which this is of
    T sum(0.0);
    for (int n = 0; n < 4; ++n) {
      const T p = from + (to - from) * nodes.place[n];
      T cosine = (sun_radius * sun_radius - distance * distance - p * p) / (distance * p * 2.0);
      if (value_of(cosine) < -1.0) cosine = T(-1.0);
      if (value_of(cosine) > 1.0) cosine = T(1.0);
      sum = sum + density_at(p * p) * p * p * (1.0 - cosine) * (2.0 * kPi * nodes.weight[n]) * (to - from);
    }
    return sum;
  };
  if (edge <= value_of(inner) || edge >= value_of(outer)) return part(inner, outer);
  return part(inner, touching) + part(touching, outer);
}

template <class T>
EjectionShellEmitter<T>::EjectionShellEmitter(const EjectionShell<T>& body, const Sun& sun,
                                              const SunFrame<T>& frame, std::vector<T> light)
    : body_(body), frame_(frame), radius_(sun.radius), light_(std::move(light)) {}

template <class T>
void EjectionShellEmitter<T>::march(const RayBundle<T>& rays, const BundleLight<T>& out) const {
  if (light_.empty()) return;
  for (std::size_t i = 0; i < rays.count; ++i) {
    const T enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
    march_ray(enu, rays.end(i), i, rays.count, out);
  }
}

template <class T>
void EjectionShellEmitter<T>::march_ray(const T enu[3], const T& end_km, std::size_t index, std::size_t rays,
                                        const BundleLight<T>& out) const {
  const SkyRay<T> ray = frame_.ray(enu);
  const Vec3<T> direction = {ray.direction[0], ray.direction[1], ray.direction[2]};
  const Vec3<T> from = minus3({ray.nearest[0], ray.nearest[1], ray.nearest[2]}, body_.middle);
  const T closest = T(0.0) - dot3(from, direction);
  const Vec3<T> off = along3(from, closest, direction);
  const T miss = dot3(off, off), outer_left = body_.outer * body_.outer - miss;
  if (!(value_of(outer_left) > 0.0)) return;
  const T half = square_root(outer_left), inner_left = body_.inner * body_.inner - miss;

  const T stop = ray_stop(frame_, ray, radius_, end_km);
  const double first = value_of(ray.observer), last = value_of(stop);
  T column(0.0);
  double weighted = 0.0, entry = last;
  const auto add = [&](T low, T high) {
    if (value_of(low) < first) low = ray.observer;
    if (value_of(high) > last) high = stop;
    if (!(value_of(low) < value_of(high))) return;
    entry = std::min(entry, value_of(low));
    static const GaussLegendre<3> nodes;
    for (int n = 0; n < 3; ++n) {
      const T s = low + (high - low) * nodes.place[n], past = s - closest;
      const T here = body_.density_at(miss + past * past) * (high - low) * nodes.weight[n];
      column = column + here;
      weighted += value_of(here) * value_of(s);
    }
  };
  if (value_of(inner_left) > 0.0) {
    const T hollow = square_root(inner_left);
    add(closest - half, closest - hollow);
    add(closest + hollow, closest + half);
  } else {
    add(closest - half, closest + half);
  }
  if (!(value_of(column) > 0.0)) return;
  for (int l = 0; l < out.lines; ++l)
    out.rayleigh[static_cast<std::size_t>(l) * rays + index] = column * light_[l];
  out.entry_km[index] = (entry - first) * frame_.unit_km();
  out.depth_km[index] = (weighted / value_of(column) - first) * frame_.unit_km();
}

EjectionShellField::EjectionShellField(const Scene& scene, const Ejection& ejection)
    : body_(scene.sun, scene.time.start_s, ejection, plain_number),
      light_(line_light<double>(scene, ejection.rayleigh, ejection.temperature_mk, plain_number)),
      lines_(static_cast<int>(scene.emission.lines.size())),
      unit_cm_(scene.sun.unit_km * kCmPerKm),
      sun_radius_(scene.sun.radius) {}

Box3 EjectionShellField::bounds() const {
  Box3 box;
  for (int i = 0; i < 3; ++i) {
    box.low[i] = body_.middle[i] - body_.outer;
    box.high[i] = body_.middle[i] + body_.outer;
  }
  return box;
}

bool EjectionShellField::is_dark(const Box3& box) const {
  if (light_.empty()) return true;
  // Distances of the box's nearest and farthest points from the shell's middle, and the latter from the
  // Sun's.
  double nearest = 0.0, farthest = 0.0, from_sun = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double low = box.low[i] - body_.middle[i], high = box.high[i] - body_.middle[i];
    const double inside = std::max({low, -high, 0.0}), outside = std::max(std::abs(low), std::abs(high));
    nearest += inside * inside;
    farthest += outside * outside;
    const double out = std::max(std::abs(box.low[i]), std::abs(box.high[i]));
    from_sun += out * out;
  }
  return nearest >= body_.outer * body_.outer || farthest <= body_.inner * body_.inner ||
         from_sun <= sun_radius_ * sun_radius_;
}

void EjectionShellField::sample(std::size_t count, const double* const point[3], float* const emission[],
                                float* density) const {
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3<double> here = {point[0][k], point[1][k], point[2][k]}, off = minus3(here, body_.middle);
    const bool hidden = dot3(here, here) < sun_radius_ * sun_radius_;
    const double value = hidden ? 0.0 : body_.density_at(dot3(off, off));
    density[k] = 0.0f;
    for (int l = 0; l < lines_; ++l)
      emission[l][k] =
          light_.empty() ? 0.0f : static_cast<float>(photons_per_volume(value * light_[l], unit_cm_));
  }
}

template struct EjectionShell<double>;
template struct EjectionShell<FreeDual>;
template class EjectionShellEmitter<double>;
template class EjectionShellEmitter<FreeDual>;

}  // namespace vegard::sim
