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

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/base/number/gauss_quadrature.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

// The light that a corona emits or scatters at a place.
//
//   density = density0 (Σ share (r / R)^-power) (1 + (polar - 1) sin²(latitude)),
// and the light is the density, its square, or, for "scattered", the density times the photosphere's light
// that is scattered at the place to the observer (scattered_light()), relative to that scattered at a
// right angle at the photosphere.

template <class T>
class CoronaSource {
 public:
  CoronaSource(const Scene& scene, const Corona& corona, const NumberAs<T>& number);

  /// `square` is r², in the Sun's unit.
  T density(const T& square, const T& square_sine_latitude) const;
  /// Returns the factor on `rayleigh` of the scene; chi is the angle between the vertical and the direction
  /// to the observer.
  T light(const T& square, const T& square_sine_latitude, const T& square_sine_chi) const;

 private:
  CoronaLight kind_;
  double square_radius_;
  T density_, polar_, darkening_, darkening_square_, scattered_below_;
  std::vector<T> share_, power_;
};

extern template class CoronaSource<double>;
extern template class CoronaSource<FreeDual>;

// Thomson scattering of the photosphere's light by free electrons.
//
// An electron at the distance r sees the Sun as a disc of the half-angle Omega, sin(Omega) = R / r. With
// c = cos(theta), theta the angle from the disc's middle, mu² = 1 - sin²(theta) / sin²(Omega), and
//   a = 2 pi ∫ I dc,   b = 2 pi ∫ I c² dc   from c = cos(Omega) to 1,
//   I = I0 (1 - u (1 - mu) - v (1 - mu)²),
// the light of both polarisations that it scatters in a direction at the angle chi from the vertical is
//   (re² / 2) ((a + b) - sin²(chi) (3 b - a) / 2)
// per unit of solid angle; re is the classical radius of the electron. With v = 0 these are the functions of
// H. C. van de Hulst (1950, Bulletin of the Astronomical Institutes of the Netherlands 11, 135), as in D. E.
// Billings, "A guide to the solar corona" (1966), and T. A. Howard and S. J. Tappin (2009, Space Science
// Reviews 147, 31): a + b = 2 pi I0 ((1 - u) C + u D), (3 b - a) / 2 = pi I0 ((1 - u) A + u B).

/// Returns (a + b) - sin²(chi) (3 b - a) / 2 for I0 = 1, in steradians. `square_sine` is (R / r)², from 0 to
/// 1.
template <class T>
T scattered_light(const T& square_sine, const T& square_sine_chi, const T& u, const T& v) {
  constexpr double kMin = 1e-24;  // of cos²(Omega): at the photosphere its root would have no slope
  const T square = value_of(square_sine) < 1.0 - kMin ? T(1.0) - square_sine : T(kMin);
  const T c = square_root(square), s = square_root(square_sine);
  const T rest = square_sine / (c + 1.0);  // 1 - c, without loss of digits
  const T depth = logarithm((s + 1.0) / c);
  // The integrals of mu^k and mu^k c². That of mu loses digits far out, as 1 / sin²(Omega) of them.
  const T a0 = rest, b0 = rest * (T(1.0) + c + square) * (1.0 / 3.0);
  const T a1 = (s - square * depth) / s * 0.5,
          b1 = ((T(2.0) - square) * s - square * square * depth) / s * 0.125;
  const T a2 = rest * rest / square_sine * (c * 2.0 + 1.0) * (1.0 / 3.0);
  const T b2 = rest * rest / square_sine * (((c * 2.0 + 4.0) * c + 6.0) * c + 3.0) * (1.0 / 15.0);
  const T of_0 = T(1.0) - u - v, of_1 = u + v * 2.0;
  const T a = of_0 * a0 + of_1 * a1 - v * a2, b = of_0 * b0 + of_1 * b1 - v * b2;
  return (a + b - square_sine_chi * (b * 3.0 - a) * 0.5) * (2.0 * kPi);
}

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
