#include "sim/emit/footprint/march_span.h"

#include "sim/emit/footprint/foot.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::sim {

MarchRays::MarchRays(const Scene& scene, const Footprint& footprint, double bottom_km)
    : observer_km_(scene.site.altitude_m * 1e-3),
      bottom_km_(bottom_km),
      top_km_(footprint.top_km),
      step_km_(scene.march.step_km),
      literal_ghosts_(scene.march.ghosts == GhostRule::literal),
      axes_{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}} {
  if (footprint.shape == FootprintShape::shell) {
    const SiteAxes axes = axes_at(scene.site);
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 3; ++a) axes_[i][a] = axes.axis[i][a];
  } else if (is_given_elsewhere(scene, footprint)) {
    const SiteTurn home = turn_between(scene.site, *footprint.home);
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 3; ++a) axes_[i][a] = home.turn[a][i];
  }
}

double MarchRays::foot_share(const double place_km[3], const double direction[3]) const {
  const double radius = std::hypot(place_km[0], place_km[1], place_km[2]);
  double up[3], fall[3];
  for (int a = 0; a < 3; ++a) {
    up[a] = place_km[a] / radius;
    fall[a] = way_ == FootWay::field ? axis_[a] : -up[a];
  }
  if (way_ == FootWay::dipole) {
    const double scale = kEarthRadiusKm + kFootAltitudeKm;
    dipole_fall(axis_, PlaneFoot<double>{up[0] * scale, up[1] * scale, true}, fall);
  }
  const auto along_up = [&](const double x[3]) { return x[0] * up[0] + x[1] * up[1] + x[2] * up[2]; };
  // Back to the height that the point came from, along the fall.
  const double back = along_up(direction) / std::min(along_up(fall), -1.0 / kMostFootShare);
  return std::hypot(direction[0] - back * fall[0], direction[1] - back * fall[1],
                    direction[2] - back * fall[2]);
}

}  // namespace vegard::sim
