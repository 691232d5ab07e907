#include "fit/parameters/phase_anchor.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {
namespace {

/// Distance along a sheet from its start to where the camera's azimuth meets it.
double distance_in_view_km(const sim::Scene& scene, const sim::Sheet& sheet) {
  const double bearing = sheet.bearing_deg * sim::kRadiansPerDegree;
  const double azimuth = scene.camera.azimuth_deg * sim::kRadiansPerDegree;
  const double along[2] = {std::sin(bearing), std::cos(bearing)};
  const double look[2] = {std::sin(azimuth), std::cos(azimuth)};
  // centre + t along = u look, with u above 0
  const double cross = along[0] * look[1] - along[1] * look[0];
  const double half = 0.5 * sheet.length_km;
  if (std::abs(cross) < 0.1) return half;
  const double t = -(sheet.center_km.east * look[1] - sheet.center_km.north * look[0]) / cross;
  const double u =
      (sheet.center_km.east + t * along[0]) * look[0] + (sheet.center_km.north + t * along[1]) * look[1];
  return u > 0.0 && std::abs(t) < half ? half + t : half;
}

}  // namespace

double PhaseAnchor::more(double wavelength_km) const {
  return sim::kTwoPi * distance_km * (1.0 / wavelength_km - 1.0 / start_wavelength_km);
}

double PhaseAnchor::slope(double wavelength_km) const {
  return -sim::kTwoPi * distance_km / (wavelength_km * wavelength_km);
}

std::vector<PhaseAnchor> phase_anchors(const sim::Scene& scene, const std::vector<FreeNumber>& moved,
                                       const std::vector<double>& values) {
  std::vector<PhaseAnchor> anchors;
  for (std::size_t p = 0; p < moved.size(); ++p) {
    // Limits of the user's are those of the phase at the start.
    if (moved[p].id.role() != sim::ParameterRole::phase || moved[p].limited()) continue;
    for (std::size_t w = 0; w < moved.size(); ++w)
      if (moved[w].id == sim::parameter_with(sim::ParameterRole::wavelength, moved[p].id.element))
        anchors.push_back({static_cast<int>(p), static_cast<int>(w),
                           distance_in_view_km(scene, scene.sheets[moved[p].id.element]), values[w]});
  }
  return anchors;
}

}  // namespace vegard::fit
