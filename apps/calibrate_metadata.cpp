#include "apps/calibrate_metadata.h"

#include <set>

#include "fit/photo/photo_defaults.h"
#include "sim/view/sky/instant.h"

namespace vegard::apps {

PictureSays with_metadata(const CalibrateOptions& options, const std::optional<sim::Scene>& camera_scene,
                          const sim::PictureMetadata& metadata) {
  PictureSays says;
  says.sky = sky_of(options, camera_scene);
  says.camera = camera_scene;
  if (options.no_metadata) return says;

  sim::Scene scene;
  if (camera_scene) scene = *camera_scene;
  scene.lines.erase("site.time_utc");
  // What is no matter of a calibration is as good as given: exposure, and a magnetic field to warn of.
  std::set<std::string> given = {"sensor.f_number", "sensor.iso", "time.exposure_s", "field.inclination_deg"};
  if (says.sky.julian_date) given.insert("site.time_utc");
  if (says.sky.observer || !metadata.latitude_deg)
    for (const char* key : {"site.latitude_deg", "site.longitude_deg", "site.altitude_m"}) given.insert(key);
  // An angle across the picture's width means nothing across another.
  if (!camera_scene || scene.lines.count("camera.width") + scene.lines.count("camera.height") > 0 ||
      scene.lines.count("camera.hfov_deg") + scene.lines.count("camera.focal_px") > 0 ||
      scene.camera.model != sim::LensModel::pinhole)
    for (const char* key : {"camera.hfov_deg", "camera.width", "camera.height"}) given.insert(key);

  fit::PhotoDefaults defaults = fit::with_photo_defaults(scene, metadata, given);
  says.taken = defaults.taken;
  says.notes = defaults.notes;
  const sim::Site& site = defaults.scene.site;
  bool place = false;
  for (const fit::PhotoFact& fact : says.taken) {
    if (fact.path == "site.time_utc") says.sky.julian_date = sim::julian_date(site.time_utc);
    place = place || fact.path == "site.latitude_deg";
  }
  if (place)
    says.sky.observer =
        sim::Observer{site.latitude_deg, site.longitude_deg, site.altitude_m, !options.vacuum};
  if (camera_scene) says.camera = defaults.scene;
  return says;
}

}  // namespace vegard::apps
