// Reads the picture of depths that a scene names (march.depth), and finds where rays end.
#pragma once

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/film/depth_image.h"

namespace vegard::sim {

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
