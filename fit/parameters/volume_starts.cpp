#include "fit/parameters/volume_starts.h"
#include "sim/scene/table/parameter_id.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {
namespace {

using sim::ParameterRole;

constexpr double kMinError_km = 20.0, kAngleError_deg = 20.0, kSunError_deg = 0.1;
constexpr double kVolumeApart = 0.1, kEnergyApart = 0.25;

/// 0: east, 1: north; -1: no place.
int axis_of(const FreeNumber& n) {
  switch (n.id.role()) {
    case ParameterRole::footprint_centre:
      return n.id.component;
    case ParameterRole::footprint_east:
      return 0;
    case ParameterRole::footprint_north:
      return 1;
    default:
      return -1;
  }
}

bool is_energy(const FreeNumber& n) { return n.id.role() == ParameterRole::footprint_energy; }

double centre_of(const sim::Scene& scene, const FreeNumber& n, int axis) {
  const sim::EastNorth& centre = scene.footprints[static_cast<std::size_t>(n.id.element)].center_km;
  return axis == 0 ? centre.east : centre.north;
}

double distance_of(const sim::Scene& scene, const FreeNumber& n) {
  return std::hypot(centre_of(scene, n, 0), centre_of(scene, n, 1));
}

}  // namespace

std::vector<double> moved_footprints(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                     std::vector<double> values, double distance, double energy) {
  const auto free_centre = [&](const FreeNumber& point, int axis) {
    const sim::ParameterId centre =
        sim::parameter_with(ParameterRole::footprint_centre, point.id.element, axis);
    return std::any_of(free.begin(), free.end(), [&](const FreeNumber& n) { return n.id == centre; });
  };
  for (std::size_t j = 0; j < free.size(); ++j) {
    const int axis = axis_of(free[j]);
    if (axis >= 0) {
      // Points count from the centre, which goes along if it can.
      const bool stays = free[j].id.role() != ParameterRole::footprint_centre && !free_centre(free[j], axis);
      const double from_centre = stays ? centre_of(scene, free[j], axis) : 0.0;
      values[j] = distance * (from_centre + values[j]) - from_centre;
    }
    if (is_energy(free[j])) values[j] *= energy;
    values[j] = free[j].within_limits(values[j]);
  }
  return values;
}

bool has_movable_footprint(const std::vector<FreeNumber>& free) {
  return std::any_of(free.begin(), free.end(),
                     [](const FreeNumber& n) { return axis_of(n) >= 0 || is_energy(n); });
}

std::optional<double> usual_error(const sim::Scene& scene, const FreeNumber& number, double share) {
  if (!is_of_volume(number)) return {};
  if (axis_of(number) >= 0) return std::max(kMinError_km, share * distance_of(scene, number));
  // Across a disc of half a degree a tenth of a degree is far.
  if (number.id.role() == ParameterRole::sun_azimuth || number.id.role() == ParameterRole::sun_elevation)
    return kSunError_deg;
  if (number.is_angle() || number.unit() == "deg") return kAngleError_deg;
  if (number.start == 0.0) return {};
  return 2.0 * share * std::abs(number.start);
}

bool footprints_differ(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                       const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (axis_of(free[j]) >= 0 && std::abs(a[j] - b[j]) > kVolumeApart * distance_of(scene, free[j]))
      return true;
    if (is_energy(free[j]) && std::abs(std::log(a[j] / b[j])) > kEnergyApart) return true;
  }
  return false;
}

}  // namespace vegard::fit
