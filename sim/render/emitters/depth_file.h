// The picture of depths that a scene names: march.depth.
#pragma once

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/film/depth_image.h"

namespace vegard::sim {

/// Of an EXR the channel "Z", or a layer's that ends in ".Z", or else its first one; of other pictures the
/// first channel, white = 1, without any curve. Empty if the scene names none. Throws
/// Error(unreadable_input) that names the key: a file that is missing, damaged, of another size than the
/// camera's picture, with negative depths or such as are no numbers.
DepthImage read_depth(const Scene& scene);

/// Where rays are stopped by the body or by what stands in the scene. `direction` is of length 1, in east,
/// north, up.
double ray_end_km(const CameraView<double>& view, const Scene& scene, const DepthImage& depth, double x_px,
                  double y_px, const double direction[3]);

/// That of a film's cells, in km along their rays, [row][column]; NaN where the lens sees nothing.
std::vector<float> ray_ends_km(const Scene& scene, const FilmGeometry& film, const DepthImage& depth,
                               int threads);

}  // namespace vegard::sim
