// One sheet and two cameras on a line across it, and what they see.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "sim/base/number/random.h"
#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/photo_scene.h"
#include "tests/support/small_scene.h"

namespace vegard::tests {

/// A sheet from west to east, 180 km to the north of a camera, and another camera `apart_km` on the way
/// there. Both know where they look. Its light has a form, not a spectrum.
inline sim::Scene two_stations(double apart_km = 100.0) {
  sim::Scene scene = small_scene();
  scene.site.latitude_deg = 68.0;
  scene.site.longitude_deg = 20.0;
  scene.camera.azimuth_deg = 0.0;
  scene.camera.elevation_deg = 35.0;
  scene.camera.roll_deg = 0.0;
  scene.field.model = sim::FieldModel::dipole;  // the same beams for both
  scene.sheets[0].center_km = {0.0, 180.0};
  scene.sheets[0].bearing_deg = 90.0;
  scene.sheets[0].profile = sim::ProfileKind::form;
  scene.sheets[0].peak_km = 112.0;
  scene.sheets[0].lower_km = 9.0;
  scene.sheets[0].upper_km = 45.0;
  scene.sky.level = {0.01, 0.01, 0.015};
  scene.fit.bands = 8;
  scene.fit.scan_points = 0;
  const double latitude_deg = scene.site.latitude_deg + apart_km / 6371.0 * 180.0 / 3.14159265358979323846;
  scene.fit.photos = {
      {"south", "south.png", "", "", {}, 0},
      {"north",
       "north.png",
       "",
       "",
       {{"site.latitude_deg", std::to_string(latitude_deg)}, {"camera.elevation_deg", "50.0"}},
       0}};
  return scene;
}

/// To be fitted: the place of the sheet, and the height of its light, of which nothing is known.
inline sim::Scene with_unknown_height(const sim::Scene& truth) {
  sim::Scene start = truth;
  start.seed += 1;
  sim::Sheet& sheet = start.sheets[0];
  sheet.ray_contrast = 0.0;
  sheet.center_km.north *= 1.08;
  sheet.peak_km += 6.0;
  sheet.lower_km += 3.0;
  sheet.upper_km += 15.0;
  for (const char* key : {"center_km.north", "bearing_deg", "peak_km", "lower_km", "upper_km"}) {
    sim::FreeParameter free;
    free.path = "sheet.main." + std::string(key);
    start.fit.free.push_back(free);
  }
  return start;
}

/// What a camera of the scene makes of it, with noise of this standard deviation in every channel.
inline fit::Photo photo_of(const sim::Scene& scene, double noise = 0.0, std::uint64_t seed = 1) {
  fit::Photo photo;
  photo.linear = sim::render(scene).rgb;
  for (std::size_t i = 0; i < photo.linear.data.size() && noise > 0.0; ++i) {
    const auto words =
        sim::random_words(seed, sim::Stream::search, 1, static_cast<std::uint32_t>(i));  // any stream
    const double u = (words[0] + 0.5) / 4294967296.0, v = (words[1] + 0.5) / 4294967296.0;
    photo.linear.data[i] +=
        static_cast<float>(noise * std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v));
  }
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  return photo;
}

/// One photograph of every entry.
inline std::vector<fit::Photo> photos_of(const sim::Scene& scene, double noise = 0.0,
                                         std::uint64_t seed = 1) {
  std::vector<fit::Photo> photos;
  for (const sim::PhotoEntry& entry : scene.fit.photos)
    photos.push_back(photo_of(sim::scene_of_photo(scene, entry), noise, seed++));
  return photos;
}

}  // namespace vegard::tests
