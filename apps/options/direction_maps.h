// The directions of a photograph's pixels, from maps or from a scene's camera.
#pragma once

#include <optional>
#include <string>

#include "apps/options/command.h"

#include "fit/photo/sky_map_file.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::apps {

/// The options of direction maps; empty where not given. If elevation_map is not given, the file of azimuths
/// contains the elevations too.
struct MapOptions {
  std::string azimuth_map, elevation_map, skymap, skymap_flip;

  bool any() const {
    return !azimuth_map.empty() || !elevation_map.empty() || !skymap.empty() || !skymap_flip.empty();
  }
  /// The file that messages name.
  const std::string& first() const { return skymap.empty() ? azimuth_map : skymap; }
};

/// Adds --azimuth-map, --elevation-map, --skymap and --skymap-flip; `options` must outlive the parsing.
void add_map_options(const Command& command, MapOptions& options);

struct KnownDirections {
  sim::DirectionMap map;
  std::string words;                      ///< their source: "maps az.exr, el.exr", "the scene's camera"
  std::optional<fit::SkyMapPlace> place;  ///< where the camera stands, if a skymap gives it
};

/// The value of --skymap-flip. Throws Error(usage).
fit::SkyMapFlip flip_of(const MapOptions& options);

/// Reads the maps, of any size. Throws Error(usage, unreadable_input).
KnownDirections maps_of(const MapOptions& options);

/// Returns the directions from the maps or, where none are given, from the scene's camera; none without
/// either. Throws Error(usage, unreadable_input, scene), also if the picture has another size.
std::optional<KnownDirections> known_directions(const MapOptions& options, const sim::Scene* scene,
                                                int width_px, int height_px, const std::string& picture);

/// Throws Error(scene) unless the scene's camera has as many pixels as the picture.
void check_camera_size(const sim::Scene& scene, int width_px, int height_px, const std::string& picture);

}  // namespace vegard::apps
