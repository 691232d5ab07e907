#include "sim/emit/nebula/nebula_cloud.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace vegard::sim {
namespace {

constexpr double kDustNm = 550.0;  // where dust_depth is meant

double power_of(double base, double exponent) { return base > 0.0 ? std::pow(base, exponent) : 0.0; }

template <class D>
Dual<double, D> power_of(const Dual<double, D>& base, const Dual<double, D>& exponent) {
  if (!(base.v > 0.0)) return Dual<double, D>(0.0);
  const double power = std::pow(base.v, exponent.v);
  return {power, base.d * (exponent.v * power / base.v) + exponent.d * (power * std::log(base.v))};
}

template <class T>
T smooth_step_of(const T& x) {
  if (value_of(x) <= 0.0) return T(0.0);
  if (value_of(x) >= 1.0) return T(1.0);
  return x * x * (T(3.0) - x * 2.0);
}

/// The numbers of a list as T, zeros where it has none.
template <class T>
void fill(const std::vector<double>& list, const NumberAs<T>& number, const T& times, int lines, T* to) {
  for (int l = 0; l < lines; ++l)
    to[l] = static_cast<std::size_t>(l) < list.size() ? number(list[l]) * times : T(0.0);
}

}  // namespace

template <class T>
NebulaCloud<T>::NebulaCloud(const Scene& scene, const Nebula& nebula, const NumberAs<T>& number)
    : nodes_(scene, number),
      gas_(nodes_.node(nebula.gas)),
      glow_(nodes_.node(nebula.glow)),
      dust_(nodes_.node(nebula.dust)),
      lines_(static_cast<int>(scene.emission.lines.size())),
      edge_(number(nebula.edge)),
      power_(number(nebula.density_power)),
      brightness_(number(nebula.brightness)),
      inner_radius_(number(nebula.inner_radius)),
      outer_radius_(number(nebula.outer_radius)) {
  fill(nebula.inner_rayleigh, number, brightness_, lines_, inner_);
  fill(nebula.outer_rayleigh, number, brightness_, lines_, outer_);
  fill(nebula.glow_rayleigh, number, brightness_, lines_, of_glow_);
  const T depth = number(nebula.dust_depth), exponent = number(nebula.dust_exponent);
  for (int l = 0; l < lines_; ++l)
    depth_[l] = depth * power_of(T(kDustNm / scene.emission.lines[l]), exponent);
}

template <class T>
double NebulaCloud<T>::empty_about(const double point[3]) const {
  double empty = std::numeric_limits<double>::infinity();
  for (const int node : {gas_, glow_, dust_})
    if (node >= 0)
      empty = std::min(empty, (nodes_.hull(node, point) - value_of(edge_)) / nodes_.steepness(node));
  return empty;
}

template <class T>
T NebulaCloud<T>::density(int node, const T point[3]) const {
  if (node < 0) return T(0.0);
  const T d = nodes_.distance(node, point, value_of(edge_));
  if (value_of(d) <= 0.0) return T(1.0);
  if (value_of(d) >= value_of(edge_)) return T(0.0);
  return T(1.0) - d / edge_;
}

template <class T>
bool NebulaCloud<T>::sample(const T point[3], CloudAt<T>& at) const {
  const T gas = density(gas_, point), glow = glow_ == gas_ ? gas : density(glow_, point),
          dust = dust_ == gas_ ? gas : density(dust_, point);
  const bool is_gas = value_of(gas) > 0.0, is_glow = value_of(glow) > 0.0, is_dust = value_of(dust) > 0.0;
  if (!is_gas && !is_glow && !is_dust) return false;
  T shining(0.0), far(0.0);
  if (is_gas) {
    const T distance = root(point[0] * point[0] + point[1] * point[1] + point[2] * point[2]);
    shining = power_of(gas, power_);
    far = smooth_step_of((distance - inner_radius_) / (outer_radius_ - inner_radius_));
  }
  for (int l = 0; l < lines_; ++l) {
    at.light[l] = T(0.0);
    if (is_gas) at.light[l] = shining * (inner_[l] + (outer_[l] - inner_[l]) * far);
    if (is_glow) at.light[l] = at.light[l] + glow * of_glow_[l];
    at.loss[l] = is_dust ? dust * depth_[l] : T(0.0);
  }
  return true;
}

template <class T>
CloudDensity NebulaCloud<T>::densities(const double point[3]) const {
  const T here[3] = {T(point[0]), T(point[1]), T(point[2])};
  return {value_of(density(gas_, here)), value_of(density(glow_, here)), value_of(density(dust_, here))};
}

template class NebulaCloud<double>;
template class NebulaCloud<FreeDual>;

}  // namespace vegard::sim
