#include "sim/emit/sun/corona_emitter.h"

#include <cstddef>

#include "sim/emit/sun/line_light.h"
#include "sim/emit/sun/sun_frame.h"

namespace vegard::sim {

template <class T>
CoronaEmitter<T>::CoronaEmitter(const Scene& scene, const Corona& corona, const NumberAs<T>& number)
    : frame_(scene.sun, number),
      source_(scene, corona, number),
      ball_(scene.sun.radius),
      reach_(corona.reach * scene.sun.radius),
      light_(line_light(scene, corona.rayleigh, corona.temperature_mk, number)) {}

template <class T>
void CoronaEmitter<T>::march(const RayBundle<T>& rays, const BundleLight<T>& out) const {
  for (std::size_t i = 0; i < rays.count; ++i) {
    const T enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
    march_ray(frame_.ray(enu), rays.end(i), i, rays.count, out);
  }
}

template <class T>
void CoronaEmitter<T>::march_ray(const SkyRay<T>& ray, const T& end_km, std::size_t index, std::size_t rays,
                                 const BundleLight<T>& out) const {
  T half;
  if (!meets_sphere(ray, T(reach_), half)) return;
  const double observer = value_of(ray.observer);
  T first = T(0.0) - half, last = half;
  if (value_of(first) < observer) first = ray.observer;
  const T stop = ray_stop(frame_, ray, ball_, end_km);
  if (value_of(last) > value_of(stop)) last = stop;
  if (!(value_of(first) < value_of(last))) return;
  out.entry_km[index] = (value_of(first) - observer) * frame_.unit_km();

  const T a = value_of(ray.aside) > ball_ * ball_ ? square_root(ray.aside) : T(ball_);
  const T turn = a * 3.0;
  RaySum sum;
  const T knot[5] = {first, T(0.0) - turn, T(0.0), turn, last};
  for (int k = 0; k < 4; ++k) {
    const T& from = value_of(knot[k]) < value_of(first) ? first : knot[k];
    const T& to = value_of(knot[k + 1]) > value_of(last) ? last : knot[k + 1];
    if (!(value_of(from) < value_of(to))) continue;
    if (k == 0 || k == 3)
      add_far(ray, from, to, sum);
    else
      add_near(ray, a, from, to, sum);
  }
  for (int l = 0; l < out.lines; ++l)
    out.rayleigh[static_cast<std::size_t>(l) * rays + index] = sum.light * light_[l];
  if (value_of(sum.light) > 0.0)
    out.depth_km[index] = (sum.weighted / value_of(sum.light) - observer) * frame_.unit_km();
}

template <class T>
void CoronaEmitter<T>::add(const SkyRay<T>& ray, const T& s, const T& weight, RaySum& sum) const {
  const T square = ray.aside + s * s, north = ray.nearest[2] + ray.direction[2] * s;
  const T light = weight * source_.light(square, north * north / square, ray.aside / square);
  sum.light = sum.light + light;
  sum.weighted += value_of(light) * value_of(s);
}

template <class T>
void CoronaEmitter<T>::add_near(const SkyRay<T>& ray, const T& a, const T& from, const T& to,
                                RaySum& sum) const {
  const T low = arctangent(from, a), high = arctangent(to, a), width = high - low;
  const bool before = value_of(to) <= 0.0;  // the nearest place: the Sun is at the end
  for (int i = 0; i < kNear; ++i) {
    const double x = near_.place[i];
    const T slope = tangent(before ? high - width * (x * x) : low + width * (x * x));
    add(ray, a * slope, a * (slope * slope + 1.0) * width * (2.0 * x * near_.weight[i]), sum);
  }
}

template <class T>
void CoronaEmitter<T>::add_far(const SkyRay<T>& ray, const T& from, const T& to, RaySum& sum) const {
  const double side = value_of(from) < 0.0 ? -1.0 : 1.0;
  const T low = logarithm(from * side), width = logarithm(to * side) - low;
  for (int i = 0; i < kFar; ++i) {
    const T distance = exponential(low + width * far_.place[i]);
    add(ray, distance * side, distance * width * (side * far_.weight[i]), sum);
  }
}

template class CoronaEmitter<double>;
template class CoronaEmitter<FreeDual>;

template <class T>
CoronaSource<T>::CoronaSource(const Scene& scene, const Corona& corona, const NumberAs<T>& number)
    : kind_(corona.light),
      square_radius_(scene.sun.radius * scene.sun.radius),
      density_(number(corona.density)),
      polar_(number(corona.polar)),
      darkening_(number(scene.sun.limb_darkening)),
      darkening_square_(number(scene.sun.limb_darkening_square)),
      scattered_below_(scattered_light(T(1.0), T(1.0), darkening_, darkening_square_)) {
  for (std::size_t k = 0; k < corona.share.size(); ++k) {
    share_.push_back(number(corona.share[k]));
    power_.push_back(number(corona.power[k]));
  }
}

template <class T>
T CoronaSource<T>::density(const T& square, const T& square_sine_latitude) const {
  const T height = logarithm(square * (1.0 / square_radius_)) * -0.5;
  T sum(0.0);
  for (std::size_t k = 0; k < share_.size(); ++k) sum = sum + share_[k] * exponential(height * power_[k]);
  return density_ * sum * ((polar_ - 1.0) * square_sine_latitude + 1.0);
}

template <class T>
T CoronaSource<T>::light(const T& square, const T& square_sine_latitude, const T& square_sine_chi) const {
  const T here = density(square, square_sine_latitude);
  if (kind_ == CoronaLight::density) return here;
  if (kind_ == CoronaLight::square) return here * here;
  return here * scattered_light(square_radius_ / square, square_sine_chi, darkening_, darkening_square_) /
         scattered_below_;
}

template class CoronaSource<double>;
template class CoronaSource<FreeDual>;

}  // namespace vegard::sim
