// A chromosphere's light along rays: emission and absorption, in rayleighs.
//
// A ray has one or two paths through it: from the outer sphere to the inner one, and out again; if it misses
// the inner sphere, the paths meet at its point nearest to the middle. Each path is cut at multiples of
// `step` from its beginning, so that neighbouring rays are sampled at the same depths; a piece is taken as
// uniform, with the values at its middle. From a piece of optical depth tau, (1 - exp(-tau)) / tau of its own
// light emerges, and exp(-tau) of the light behind it (S. Chandrasekhar, "Radiative Transfer", 1950, chapter
// I). For T = FreeDual the derivatives are exactly those of this sum.
#pragma once

#include <optional>
#include <vector>

#include "sim/emit/sun/chromosphere_density.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

template <class T>
class ChromosphereEmitter : public Emitter<T> {
 public:
  /// The emitter of chromosphere `index` of the scene; `biasmap` and `instant_s` are as in
  /// sim/emit/sun/chromosphere_density.h.
  ChromosphereEmitter(const Scene& scene, int index, const Image* biasmap, const NumberAs<T>& number,
                      std::optional<double> instant_s = std::nullopt);

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override;
  bool absorbs() const override { return absorbs_; }

 private:
  struct RaySum;
  void march_ray(const SkyRay<T>& ray, const T& end_km, std::size_t index, std::size_t rays,
                 const BundleLight<T>& out) const;
  /// Marches one path. Returns false once the transmission is negligible.
  bool march_way(const SkyRay<T>& ray, const T& first, const T& last, RaySum& sum) const;

  SunFrame<T> frame_;
  ChromosphereDensity<T> density_;
  double ball_, inner_, outer_, step_;
  std::vector<T> light_;  ///< per line, or empty
  T extinction_;
  bool absorbs_;
};

extern template class ChromosphereEmitter<double>;
extern template class ChromosphereEmitter<FreeDual>;

}  // namespace vegard::sim
