// What a file of voxels says of itself, and its colours.
#pragma once

#include <array>
#include <vector>

#include "sim/base/grid/vdb_io.h"
#include "sim/render/volumes/scene_grid.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Whether a grid of the scene's light is in the Sun's frame: grids never hold light of two frames.
bool is_of_sun(const sim::Scene& scene);

/// See docs/openvdb.md and docs/corona/grids.md for what the entries mean.
sim::VdbMetadata volume_metadata(const sim::Scene& scene, const sim::SceneGrid& made);

/// Linear RGB of a unit of length of 1 photon cm^-3 s^-1 of each channel, `lines` of the scene (empty: all)
/// and the density, which has none.
std::vector<std::array<float, 3>> colours_of_channels(const sim::Scene& scene, const sim::SceneGrid& made,
                                                      const std::vector<int>& lines);

}  // namespace vegard::apps
