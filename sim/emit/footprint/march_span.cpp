#include "sim/emit/footprint/march_span.h"

namespace vegard::sim {

MarchRays::MarchRays(const Scene& scene, const Footprint& footprint, double bottom_km)
    : observer_km_(scene.site.altitude_m * 1e-3),
      bottom_km_(bottom_km),
      top_km_(footprint.top_km),
      step_km_(scene.march.step_km),
      literal_ghosts_(scene.march.ghosts == "literal"),
      axes_{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}} {
  if (footprint.shape != "shell") return;
  const double lat = scene.site.latitude_deg * kRadiansPerDegree,
               lon = scene.site.longitude_deg * kRadiansPerDegree;
  const double axes[3][3] = {{-std::sin(lon), std::cos(lon), 0.0},
                             {-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)},
                             {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)}};
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < 3; ++a) axes_[i][a] = axes[i][a];
}

}  // namespace vegard::sim
