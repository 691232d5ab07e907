#include "apps/studio/studio_map.h"

#include <cmath>
#include <vector>

#include "fit/map/precipitation_planes.h"
#include "fit/triangulation/map_marks.h"

namespace vegard::apps {
namespace studio_map_parts {

/// To four digits: more would only be sent.
double shortened(double value) {
  if (!std::isfinite(value) || value == 0.0) return value;
  return fit::rounded_to(value, 3 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
}

nlohmann::ordered_json cells_json(const std::vector<double>& values) {
  auto cells = nlohmann::ordered_json::array();
  for (const double value : values) cells.push_back(fit::number_or_null(shortened(value)));
  return cells;
}

}  // namespace studio_map_parts

nlohmann::ordered_json studio_map(const std::string& directory) {
  using studio_map_parts::cells_json;
  const fit::PrecipitationPlanes planes = fit::read_precipitation_planes(directory);
  return {{"latitude_deg", planes.site.latitude_deg},
          {"longitude_deg", planes.site.longitude_deg},
          {"columns", planes.columns},
          {"rows", planes.rows},
          {"west_km", planes.west_km},
          {"south_km", planes.south_km},
          {"step_km", planes.step_km},
          {"height_km", planes.height_km},
          {"flux_is_absolute", planes.flux_is_absolute},
          {"energy_flux_mw_m2", cells_json(planes.energy_flux_mw_m2)},
          {"energy_kev", cells_json(planes.energy_kev)}};
}

}  // namespace vegard::apps
