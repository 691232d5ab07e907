// The files that a scene's volumes are made from.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/emit/grid/grid_bricks.h"
#include "sim/scene/file/precipitation_file.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/film/depth_image.h"

namespace vegard::sim {

struct VolumeFiles {
  DepthImage depth;                                      ///< march.depth
  std::map<std::string, Image> pictures;                 ///< one channel, 0 to 1, by the name in the scene
  std::map<std::string, PrecipitationMap> maps;          ///< maps of precipitation, by the name in the scene
  std::vector<std::shared_ptr<const GridBricks>> grids;  ///< [volume of the scene]
};

/// Reads all files. Throws Error(unreadable_input) that names the key.
VolumeFiles read_volume_files(const Scene& scene);

/// Returns the chromosphere's map of bias, which lives as long as `files`; null if it has none.
inline const Image* bias_map(const VolumeFiles& files, const Chromosphere& chromosphere) {
  const auto found = files.pictures.find(chromosphere.biasmap);
  return found == files.pictures.end() ? nullptr : &found->second;
}

/// Returns the depths. From an EXR file it takes the channel "Z", or that of a layer, whose name ends in
/// ".Z", or else the first channel; from other pictures the first channel, with white = 1 and no transfer
/// curve. Empty if the scene names none. Throws Error(unreadable_input) with the key if the file is missing,
/// damaged, of another size than the camera's picture, or has negative depths or NaN.
DepthImage read_depth(const Scene& scene);

/// Returns the distance in km at which a ray is stopped by the body or by an object in the scene. `direction`
/// is a unit vector in east, north, up.
double ray_end_km(const CameraView<double>& view, const Scene& scene, const DepthImage& depth, double x_px,
                  double y_px, const double direction[3]);

/// Returns these distances for a film's cells, [row][column]; NaN where the lens sees nothing.
std::vector<float> ray_ends_km(const Scene& scene, const FilmGeometry& film, const DepthImage& depth,
                               int threads);

}  // namespace vegard::sim
