#include "apps/options/direction_maps.h"

#include "apps/options/file_names.h"
#include "apps/options/refusals.h"
#include "fit/photo/direction_map_file.h"
#include "sim/base/error.h"
#include "sim/base/image.h"

namespace vegard::apps {
void add_map_options(const Command& command, MapOptions& options) {
  command.option("--azimuth-map", options.azimuth_map,
                 "Azimuth of every pixel in degrees: FITS, EXR (channel azimuth_deg, or its only one) or "
                 "TIFF of floats");
  command.option("--elevation-map", options.elevation_map,
                 "Elevation of every pixel (channel elevation_deg; default: the file of --azimuth-map)");
  command
      .option("--skymap", options.skymap,
              "Azimuth and elevation in one file: .sav or CDF of THEMIS, REGO and TREx, HDF5, MATLAB, FITS "
              "of two planes, EXR")
      .type_name("FILE");
  command
      .option("--skymap-flip", options.skymap_flip,
              "Flip the maps' rows, columns or both, if they run against the picture's")
      .type_name("WHICH");
}

void check_camera_size(const sim::Scene& scene, int width_px, int height_px, const std::string& picture) {
  if (scene.camera.width == width_px && scene.camera.height == height_px) return;
  throw with_place(
      sim::Error(sim::ErrorKind::scene,
                 "the scene's camera has " + sim::size_text(scene.camera.width, scene.camera.height) +
                     " pixels, the photograph " + picture + " has " + sim::size_text(width_px, height_px))
          .key("camera.width")
          .hint("set camera.width and camera.height to the photograph's"),
      scene);
}

fit::SkyMapFlip flip_of(const MapOptions& options) {
  const std::string& which = options.skymap_flip;
  const fit::SkyMapFlip flip{which == "rows" || which == "both", which == "columns" || which == "both"};
  if (!which.empty() && !flip.rows && !flip.columns)
    throw usage_error("--skymap-flip", "'" + which + "' is nothing that can be flipped",
                      "rows, columns or both");
  return flip;
}

KnownDirections maps_of(const MapOptions& options) {
  const std::string& az = options.azimuth_map;
  if (options.first().empty() && options.elevation_map.empty())
    throw usage_error("--skymap-flip", "there is no skymap", "--skymap or --azimuth-map with it");
  if (!options.skymap.empty()) {
    if (!az.empty() || !options.elevation_map.empty())
      throw usage_error("--skymap", "it has azimuths and elevations",
                        "no --azimuth-map or --elevation-map with it");
    const fit::SkyMapFile file = fit::read_sky_map(options.skymap, flip_of(options));
    return {file.map, "skymap " + file_name_of(options.skymap), file.place};
  }
  if (az.empty())
    throw usage_error("--elevation-map", "a map of elevations alone is not enough", "--azimuth-map with it");
  const std::string& el = options.elevation_map.empty() ? az : options.elevation_map;
  KnownDirections known{fit::read_direction_map(az, el), "maps " + file_name_of(az), {}};
  fit::flip_map(flip_of(options), known.map);
  if (el != az) known.words += ", " + file_name_of(el);
  return known;
}

std::optional<KnownDirections> known_directions(const MapOptions& options, const sim::Scene* scene,
                                                int width_px, int height_px, const std::string& picture) {
  if (!options.any()) {
    if (scene == nullptr) return std::nullopt;
    check_camera_size(*scene, width_px, height_px, picture);
    return KnownDirections{sim::direction_map(scene->camera), "the scene's camera", {}};
  }
  KnownDirections known = maps_of(options);
  if (known.map.width != width_px || known.map.height != height_px) {
    throw sim::Error(sim::ErrorKind::unreadable_input,
                     "the maps have " + sim::size_text(known.map.width, known.map.height) + " pixels")
        .file(options.first())
        .expected(sim::size_text(width_px, height_px) + ", the size of " + picture);
  }
  return known;
}

}  // namespace vegard::apps
