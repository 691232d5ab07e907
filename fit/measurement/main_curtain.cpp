#include "fit/measurement/main_curtain.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace main_curtain_means {

constexpr double kAtEnd = 0.03;  // of an energy: as near to the last of the map's energies it stands there

double weight_of(const CurtainPoint& p) {
  const double weight = p.flux_mw_m2.value * p.width_km.value;
  return p.border_in_view && std::isfinite(weight) && weight > 0.0 ? weight : 0.0;
}

/// The sum of weights of the points along the border, or of all.
double weight_of(const Curtain& curtain, const BorderTrace& trace, const sim::Scene& scene, bool along) {
  double sum = 0.0;
  for (const CurtainPoint& p : curtain.points)
    if (!along || std::isfinite(distance_along(trace, scene, p.azimuth_deg).km)) sum += weight_of(p);
  return sum;
}

}  // namespace main_curtain_means

bool MainCurtain::agrees() const {
  // A map without error bars has none of its distances either.
  const double error = std::isfinite(distance_km.error) ? distance_km.error : 0.0;
  return is_along_border && std::abs(distance_km.value - border_distance_km.value) <=
                                2.0 * std::hypot(error, border_distance_km.error);
}

std::optional<MainCurtain> main_curtain(const MapResult& map, const std::vector<Curtain>& curtains,
                                        const BorderTrace& trace, const sim::Scene& scene) {
  using namespace main_curtain_means;
  MainCurtain m;
  double most = 0.0;
  for (const bool along : {true, false}) {
    for (std::size_t c = 0; c < curtains.size(); ++c) {
      const double weight = weight_of(curtains[c], trace, scene, along);
      if (weight <= most) continue;
      most = weight;
      m.curtain = c;
    }
    m.is_along_border = along;
    if (most > 0.0) break;
  }
  if (!(most > 0.0)) return std::nullopt;
  double ln_energy = 0.0, ln_error = 0.0, east = 0.0, north = 0.0;
  m.lowest_kev = sim::kNaN;
  for (const CurtainPoint& p : curtains[m.curtain].points) {
    const DistanceAlong beside = distance_along(trace, scene, p.azimuth_deg);
    if (m.is_along_border && !std::isfinite(beside.km)) continue;
    const double w = weight_of(p) / most;
    if (w == 0.0) continue;
    ln_energy += w * std::log(p.energy_kev.value);
    ln_error += w * p.energy_kev.error / p.energy_kev.value;
    m.distance_km.value += w * p.distance_km;
    m.distance_km.error += w * p.distance_error_km;
    m.border_distance_km.value += w * beside.km;
    m.border_distance_km.error += w * beside.error_km;
    m.lower_border_km.value += w * p.lower_border_km.value;
    m.lower_border_km.error += w * p.lower_border_km.error;
    east += w * std::sin(p.azimuth_deg * sim::kRadiansPerDegree);
    north += w * std::cos(p.azimuth_deg * sim::kRadiansPerDegree);
    m.lowest_kev = std::fmin(m.lowest_kev, p.energy_kev.value);
    m.highest_kev = std::max(m.highest_kev, p.energy_kev.value);
    if (!map.energies_kev.empty() && (p.energy_kev.value >= (1.0 - kAtEnd) * map.energies_kev.back() ||
                                      p.energy_kev.value <= (1.0 + kAtEnd) * map.energies_kev.front()))
      m.share_at_end += w;
  }
  m.energy_kev = {std::exp(ln_energy), std::exp(ln_energy) * ln_error};
  m.azimuth_deg = std::fmod(std::atan2(east, north) / sim::kRadiansPerDegree + 360.0, 360.0);
  return m;
}

}  // namespace vegard::fit
