// Marches a coarser film and upsamples its light to the wanted film.
#pragma once

#include <functional>
#include <vector>

#include "sim/render/volumes/volumes.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Returns where the rays of a film end (ray_ends_km() in sim/render/emitters/depth_file.h).
using EndsOfRays = std::function<std::vector<float>(const FilmGeometry& film)>;

/// Computes the light of a film from that of a film with cells `shrink` times as wide and high
/// (sim/view/film/depth_image.h). Cells that no coarse ray represents, at the edges of objects in the
/// scene and of the lens's image circle, are marched directly.
VolumeLight march_coarsely(const FilmGeometry& film, int shrink, const EndsOfRays& ends,
                           const MarchCells& march, int threads);

}  // namespace vegard::sim
