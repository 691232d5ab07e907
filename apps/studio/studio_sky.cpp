#include "apps/studio/studio_sky.h"

#include <array>

#include <nlohmann/json.hpp>

#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/bright_stars.h"
#include "sim/view/sky/sky_of_scene.h"

namespace vegard::apps {

std::string studio_sky_json(const sim::Scene& scene) {
  using Json = nlohmann::ordered_json;
  const double date = sim::julian_date_at(scene, scene.time.start_s);
  const sim::Observer observer = sim::observer_of(scene);
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  Json stars = Json::array();
  for (const sim::BrightStar& star : sim::catalogue_stars()) {
    const std::array<double, 3> enu = sim::direction_of_star(star.place, observer, date);
    double x_px = 0.0, y_px = 0.0;
    if (enu[2] < 0.0 || !sim::pixel_of_enu(view, enu.data(), x_px, y_px)) continue;
    if (x_px < 0.0 || y_px < 0.0 || x_px > scene.camera.width || y_px > scene.camera.height) continue;
    stars.push_back({star.label(), star.magnitude, x_px, y_px});
  }
  return Json{{"time_utc", scene.site.time_utc},
              {"latitude_deg", scene.site.latitude_deg},
              {"longitude_deg", scene.site.longitude_deg},
              {"altitude_m", scene.site.altitude_m},
              {"stars", stars}}
      .dump();
}

}  // namespace vegard::apps
