#include "sim/emit/sun/photosphere_emitter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/number/constants.h"
#include "sim/emit/sun/line_light.h"

namespace vegard::sim {
namespace {

/// Nearer to touching than this, of a pixel's radius, the share (below 1e-9) is left out, or whole.
constexpr double kTouching = 1e-6;

}  // namespace

template <class T>
PhotosphereEmitter<T>::PhotosphereEmitter(const Scene& scene, const NumberAs<T>& number)
    : frame_(scene.sun, number),
      radius_(scene.sun.radius),
      light_(line_light(scene, scene.sun.photosphere_rayleigh, 0.0, number)),
      darkening_(number(scene.sun.limb_darkening)),
      darkening_square_(number(scene.sun.limb_darkening_square)) {}

template <class T>
bool PhotosphereEmitter<T>::cover(const SkyRay<T>& ray, const T& cell_radius, Covered& covered) const {
  covered.share = T(1.0);
  T aside = ray.aside * (1.0 / (radius_ * radius_));
  // The root is taken only near the limb: it has no slope in the middle of the disc.
  const double off = std::sqrt(value_of(ray.aside)) - radius_, cell = value_of(cell_radius);
  if (off >= cell * (1.0 - kTouching)) return false;
  if (off > cell * (kTouching - 1.0)) {
    const T passes = square_root(ray.aside), t = (passes - radius_) / cell_radius;
    const T square = T(1.0) - t * t, root = square_root(square);
    covered.share = (arctangent(root, t) - t * root) * (1.0 / kPi);
    const T inwards = square * root / covered.share * (2.0 / (3.0 * kPi)) * cell_radius;
    const T middle = (passes - inwards) * (1.0 / radius_);
    aside = middle * middle;
  }
  const T square_mu = T(1.0) - aside;
  covered.mu = value_of(square_mu) > 0.0 ? square_root(square_mu) : T(0.0);
  return true;
}

template <class T>
void PhotosphereEmitter<T>::march(const RayBundle<T>& rays, const BundleLight<T>& out) const {
  const T distance = frame_.sky().observer_distance();
  const T cell_radius =
      square_root(distance * distance - radius_ * radius_) * (rays.cell_rad / std::sqrt(kPi));
  for (std::size_t i = 0; i < rays.count; ++i) {
    const T enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
    const SkyRay<T> ray = frame_.ray(enu);
    if (!(value_of(ray.observer) < 0.0)) continue;  // it looks away
    Covered covered;
    if (!cover(ray, cell_radius, covered)) continue;
    double half = 0.0;
    const double square = radius_ * radius_ - value_of(ray.aside);
    if (square > 0.0) half = std::sqrt(square);
    const double entry_km = (-half - value_of(ray.observer)) * frame_.unit_km();
    constexpr double kRounding = 1e-12;
    if (rays.end_km[i] < entry_km * (1.0 - kRounding)) continue;  // something stands before it
    // Where the ray ends at the ball this is that very end, however it has been rounded.
    out.entry_km[i] = std::min(entry_km, rays.end_km[i]);
    if (out.entry_moving != nullptr)  // at the limb, where it is a root, as of a place that stays beside it
      out.entry_moving[i] = (T(-half) - ray.observer) * frame_.unit_km();
    const T dark = T(1.0) - covered.mu;
    const T of_light = covered.share * (T(1.0) - darkening_ * dark - darkening_square_ * dark * dark);
    double bright = 0.0;
    for (int l = 0; l < out.lines; ++l) {
      const std::size_t to = static_cast<std::size_t>(l) * rays.count + i;
      out.kept[to] = T(1.0) - covered.share;
      if (light_.empty()) continue;
      out.rayleigh[to] = light_[l] * of_light;
      bright += value_of(out.rayleigh[to]);
    }
    if (bright > 0.0) out.depth_km[i] = out.entry_km[i];
  }
}

template class PhotosphereEmitter<double>;
template class PhotosphereEmitter<FreeDual>;

}  // namespace vegard::sim
