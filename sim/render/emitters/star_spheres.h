// The stars of the Sun's scene as spheres of density, for grids.
//
// Source: "Solar Corona" (docs/corona.md, C19) has stars as small spheres of density in the volume. Places,
// brightness and colours are here those of the picture's stars (sim/view/sky/stars.h), and so is the size
// as seen; how the density falls off is ours.
#pragma once

#include <vector>

#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A star in the Sun's frame and unit.
struct StarSphere {
  double middle[3];
  std::vector<double> emission;  ///< in the middle, photons cm^-3 s^-1, per line
};

/// The density is (1 - q²)² of the middle's, q being the distance over the radius.
class StarField : public LightField {
 public:
  /// `lines`: of each sphere.
  StarField(std::vector<StarSphere> spheres, double radius, double unit_cm, int lines);

  double unit_cm() const override { return unit_cm_; }
  Box3 bounds() const override;
  bool is_dark(const Box3& box) const override;
  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override;

  const std::vector<StarSphere>& spheres() const { return spheres_; }
  double radius() const { return radius_; }

 private:
  std::vector<StarSphere> spheres_;
  double radius_, unit_cm_;
  int lines_;
};

/// True if a grid of the scene has its stars: they are shown and stars.sphere_distance is not 0, with the
/// Sun.
bool has_star_spheres(const Scene& scene);

/// Returns the spheres' radius in the Sun's unit: three standard deviations of a star's image, which the
/// spheres have as seen from the observer.
double star_sphere_radius(const Scene& scene);

/// Returns the stars that the scene's picture shows at its start. A star's light in the sensor is as in the
/// picture as far as the lines can have its colour (line_amounts()).
StarField star_field(const Scene& scene);

}  // namespace vegard::sim
