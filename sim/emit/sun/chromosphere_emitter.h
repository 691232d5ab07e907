// A chromosphere's light along rays: emission and absorption, in rayleighs.
//
// A ray has one way through it or two: from the sphere outside to the one inside, and out again; where it
// misses the one inside they meet at its place nearest to the middle. Each way is cut at multiples of `step`
// from its beginning, so that neighbouring rays look at the same depths; a piece is taken as uniform, with
// what stands in its middle. Within one of optical depth tau, (1 - exp(-tau)) / tau of its light comes out
// and exp(-tau) of the light behind it (S. Chandrasekhar, "Radiative Transfer", 1950, chapter I). For T =
// FreeDual the derivatives are those of the very sum.
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
  /// Of chromosphere `index` of the scene; `biasmap` and instant as in sim/emit/sun/chromosphere_density.h.
  ChromosphereEmitter(const Scene& scene, int index, const Image* biasmap, const NumberAs<T>& number,
                      std::optional<double> instant_s = std::nullopt);

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override;
  bool absorbs() const override { return absorbs_; }

 private:
  struct RaySum;
  void march_ray(const SkyRay<T>& ray, const T& end_km, std::size_t index, std::size_t rays,
                 const BundleLight<T>& out) const;
  /// False once nothing more comes through.
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
