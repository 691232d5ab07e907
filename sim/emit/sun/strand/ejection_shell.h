// The shell of a mass ejection ([[ejection]] of kind "shell"). A model of our own: the source only names
// mass ejections.
//
// The front is a ball that touches the cone of full angle width_deg, with its apex in the Sun's middle,
// around the vertical of the place of origin. Its farthest point is at the height h of the front
// (flux_rope.h) above the photosphere of radius R: with w half the width, its middle is at the distance D and
// its radius is b,
//   D = (R + h) / (1 + sin w),   b = D sin w
// (the "ice-cream cone" of R. R. Fisher and R. H. Munro 1984, ApJ 280, 428, without its cone). So it always
// spans the width, and grows in proportion to the distance of its front. Its shell extends inwards by aspect
// h, but at most by b. With p the distance from the ball's middle and i the inner radius, the density is
//   density_now 4 (p² - i²)(b² - p²) / (b² - i²)²
// in the shell: density_now where p² is half-way between i² and b², and 0 at both surfaces. Along a ray this
// is a polynomial of fourth degree, for which three Gauss-Legendre nodes are exact.
//
// Mass is conserved: density_now is `density` times the ratio of the mass outside the photosphere at age 0 to
// that now, both for density_now = 1. Mass within the photosphere is invisible and not included.
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

  /// The shell with its front at the height `front`, its place of origin at a longitude, and density 1.
  EjectionShell(const Sun& sun, const Ejection& ejection, const T& longitude_deg, const T& front,
                const NumberAs<T>& number);
  /// The shell at an instant of the scene's clock.
  EjectionShell(const Sun& sun, double instant_s, const Ejection& ejection, const NumberAs<T>& number);

  /// Returns the density at the square of a distance from the middle.
  T density_at(const T& square) const;
  /// Returns the integral of the density over the space outside a photosphere.
  T mass(const T& sun_radius) const;
};

template <class T>
class EjectionShellEmitter : public Emitter<T> {
 public:
  /// `light`: per line, for density 1 and a unit of path (line_light.h); empty: dark.
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

/// The shell as a field in the Sun's frame, dark within the photosphere. It absorbs nothing: its density is
/// 0.
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
