// March of a coarser film, brought up to the film that is wanted.
#pragma once

#include <functional>
#include <vector>

#include "sim/render/volumes/volumes.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Where the rays of a film end: sim/render/emitters/depth_file.h.
using EndsOfRays = std::function<std::vector<float>(const FilmGeometry& film)>;

/// The light of a film by that of one with cells `shrink` times as wide and high
/// (sim/view/film/depth_upsampling.h). Cells that no coarse ray represents, at the edges of what stands in
/// the scene and of the lens's picture, are marched by themselves.
VolumeLight march_coarsely(const FilmGeometry& film, int shrink, const EndsOfRays& ends,
                           const MarchCells& march, int threads);

}  // namespace vegard::sim
