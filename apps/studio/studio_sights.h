// Lines of sight for the studio's page: where the pixels of its pictures look, and where places stand in
// them.
//
// A request names cameras, files of the folder: {"cameras": [{"file": "camera.toml", "changes":
// ["site.latitude_deg=67"]}], "earth": "wgs84" or "sphere", "is_refracted": true}. Answers give a pixel for
// each of them, [x_px, y_px], or null where a camera does not have the place in its picture. All functions
// throw Json::exception for a request of another shape, Error(usage) for what is outside of the folder, and
// as scene_of() does.
#pragma once

#include <nlohmann/json.hpp>

namespace vegard::apps {

class StudioFolder;

/// "height_km" too. Returns "views": for each camera its `width` and `height` in pixels, the `place` where it
/// stands, [latitude_deg, longitude_deg], and the `outline` of what it sees at this height, as such places.
nlohmann::ordered_json studio_views(const StudioFolder& folder, const nlohmann::ordered_json& asked);

/// "pixel" of the first camera and "heights_km" too. Returns `azimuth_deg` and the apparent `elevation_deg`,
/// null outside of the lens's picture, and `points` of the line of sight, one for each height that it
/// reaches: `height_km`, `place`, `distance_km` along the line, and `pixels`.
nlohmann::ordered_json studio_sight(const StudioFolder& folder, const nlohmann::ordered_json& asked);

/// "places" too, [latitude_deg, longitude_deg, height_km]. Returns `pixels` for each of them.
nlohmann::ordered_json studio_seen(const StudioFolder& folder, const nlohmann::ordered_json& asked);

}  // namespace vegard::apps
