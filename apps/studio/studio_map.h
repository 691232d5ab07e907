// A run's map of precipitation, for the studio's page.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace vegard::apps {

/// Returns the planes of DIRECTORY/precipitation.fits as in fit/map/precipitation_planes.h: the site's
/// `latitude_deg` and `longitude_deg`, `columns`, `rows`, `west_km`, `south_km`, `step_km`, `height_km`,
/// `flux_is_absolute`, and `energy_flux_mw_m2` and `energy_kev` of the cells, null where not known. Throws
/// Error(unreadable_input).
nlohmann::ordered_json studio_map(const std::string& directory);

}  // namespace vegard::apps
