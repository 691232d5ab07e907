// The shell of a mass ejection ([[ejection]] of kind "shell"). A model of our own: the source only names
// mass ejections.
//
// The front is a ball that touches the cone of width_deg about the vertical of the place that it leaves, from
// the Sun's middle, and whose farthest point is at the height h of the front (flux_rope.h) over the
// photosphere, radius R: with w half the width, its middle is at the distance D and its radius is b,
//   D = (R + h) / (1 + sin w),   b = D sin w
// (the "ice-cream cone" of R. R. Fisher and R. H. Munro 1984, ApJ 280, 428, without its cone). So it always
// spans the width, and grows as the distance of its front does. Its shell is aspect h thick, inwards, b at
// most. With p the distance from the ball's middle, i the inner radius, the density is
//   density_now 4 (p² - i²)(b² - p²) / (b² - i²)²
// in the shell: density_now half-way, as areas go, and 0 at both of its surfaces. Along a ray that is a
// polynomial of fourth degree, for which three Gauss-Legendre nodes are exact.
//
// Mass is kept: density_now is `density` times the mass outside of the photosphere at age 0 over the same
// now, each for density_now = 1. What is within the photosphere is not seen and does not count.
#pragma once

#include <vector>

#include "sim/base/number/vec3.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

template <class T>
struct EjectionShell {
  Vec3<T> middle;
  T outer, inner;  ///< radii
  T density;       ///< density_now

  /// With its front at a height, the place that it leaves at a longitude, and density 1.
  EjectionShell(const Sun& sun, const Ejection& ejection, const T& longitude_deg, const T& front,
                const NumberAs<T>& number);
  /// As it is at an instant of the scene's clock.
  EjectionShell(const Sun& sun, double instant_s, const Ejection& ejection, const NumberAs<T>& number);

  /// At the square of the distance from the middle.
  T density_at(const T& square) const;
  /// The integral of density over space outside of a photosphere.
  T mass(const T& sun_radius) const;
};

template <class T>
class EjectionShellEmitter : public Emitter<T> {
 public:
  /// `light` per line, of density 1 to a unit of path (line_light.h); empty: dark.
  EjectionShellEmitter(const EjectionShell<T>& body, const Sun& sun, const SunFrame<T>& frame,
                       std::vector<T> light);

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override;
  bool is_mixed() const override { return true; }

 private:
  void march_ray(const T enu[3], const T& end_km, std::size_t ray, std::size_t rays,
                 const BundleLight<T>& out) const;

  EjectionShell<T> body_;
  SunFrame<T> frame_;
  double radius_;  ///< of the photosphere
  std::vector<T> light_;
};

/// The same as a field, in the Sun's frame: dark within the photosphere. Nothing absorbs, and the density
/// given is 0.
class EjectionShellField : public LightField {
 public:
  EjectionShellField(const Scene& scene, const Ejection& ejection);

  double unit_cm() const override { return unit_cm_; }
  Box3 bounds() const override;
  bool is_dark(const Box3& box) const override;
  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override;

 private:
  EjectionShell<double> body_;
  std::vector<double> light_;
  int lines_;
  double unit_cm_, sun_radius_;
};

extern template struct EjectionShell<double>;
extern template struct EjectionShell<FreeDual>;
extern template class EjectionShellEmitter<double>;
extern template class EjectionShellEmitter<FreeDual>;

}  // namespace vegard::sim
