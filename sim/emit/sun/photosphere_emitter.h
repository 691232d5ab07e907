// The photosphere: an opaque sphere, luminous or dark.
//
// Its brightness follows the law of limb darkening
//   I = I0 (1 - u (1 - mu) - v (1 - mu)²),   mu² = 1 - b² / R²
// (E. Böhm-Vitense, "Introduction to stellar astrophysics" II, 1989; the mean over the disc is 1 - u / 3 - v
// / 6 of I0), where b is the distance at which a ray passes the Sun's middle. u = v = 0 is a uniform disc
// (row C1 of the source).
//
// At the limb a ray represents a round pixel of the cell's area, with the radius p = cell / sqrt(pi), of
// which the disc covers, with the limb taken as straight within the pixel,
//   share = (acos t - t sqrt(1 - t²)) / pi,   t = (b - R) / p,
// where |t| < 1. The light is that at the middle of the covered part. The area of the disc thus becomes pi R²
// (1 + p² / 4 R²).
#pragma once

#include <vector>

#include "sim/emit/sun/sun_frame.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

struct Scene;

template <class T>
class PhotosphereEmitter : public Emitter<T> {
 public:
  PhotosphereEmitter(const Scene& scene, const NumberAs<T>& number);

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override;
  bool absorbs() const override { return true; }

 private:
  struct Covered {
    T share, mu;
  };
  /// Finds the covered part of a ray's pixel, whose radius at the limb's distance is `cell_radius`. Returns
  /// false if nothing is covered.
  bool cover(const SkyRay<T>& ray, const T& cell_radius, Covered& covered) const;

  SunFrame<T> frame_;
  double radius_;
  std::vector<T> light_;  ///< per line, or empty
  T darkening_, darkening_square_;
};

extern template class PhotosphereEmitter<double>;
extern template class PhotosphereEmitter<FreeDual>;

}  // namespace vegard::sim
