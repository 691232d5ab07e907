// A corona's light along rays, in rayleighs. It is transparent.
//
// A ray is cut at its point nearest to the middle, s = 0, and at |s| = 3 a, where a is the distance at which
// it passes the middle, or the photosphere's radius if this is larger. Inside, s = a tan(psi), which turns
// powers of r into powers of a cosine; psi = end ± w x² concentrates the nodes towards the Sun, since the
// light scattered near the photosphere varies as the root of the height. Outside, s = ± exp(tau). The
// quadrature over x and tau is Gauss's. Its error, against sums of two million pieces for rays at 0 to 7.5
// radii, is below 1e-7 of the light where the light falls with up to the 32nd power of r, and 3e-6 with the
// 100th.
#pragma once

#include <vector>

#include "sim/base/number/gauss_quadrature.h"
#include "sim/emit/sun/corona_source.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

template <class T>
class CoronaEmitter : public Emitter<T> {
 public:
  CoronaEmitter(const Scene& scene, const Corona& corona, const NumberAs<T>& number);

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override;
  bool is_mixed() const override { return true; }

 private:
  struct RaySum {
    T light{0.0};  ///< for rayleigh = 1 of the line
    double weighted = 0.0;
  };
  void march_ray(const SkyRay<T>& ray, const T& end_km, std::size_t index, std::size_t rays,
                 const BundleLight<T>& out) const;
  void add(const SkyRay<T>& ray, const T& s, const T& weight, RaySum& sum) const;
  /// Adds the light from s = `from` to `to`, both on one side of the nearest point.
  void add_near(const SkyRay<T>& ray, const T& a, const T& from, const T& to, RaySum& sum) const;
  void add_far(const SkyRay<T>& ray, const T& from, const T& to, RaySum& sum) const;

  static constexpr int kNear = 16, kFar = 10;

  SunFrame<T> frame_;
  CoronaSource<T> source_;
  double ball_, reach_;
  std::vector<T> light_;  ///< per line
  GaussLegendre<kNear> near_;
  GaussLegendre<kFar> far_;
};

extern template class CoronaEmitter<double>;
extern template class CoronaEmitter<FreeDual>;

}  // namespace vegard::sim
