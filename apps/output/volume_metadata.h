// The metadata of a file of voxels, and its colours.
#pragma once

#include <array>
#include <vector>

#include "sim/base/grid/vdb_io.h"
#include "sim/render/volumes/scene_grid.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Whether a grid of the scene's light is in the Sun's frame: grids never hold light of two frames.
bool is_of_sun(const sim::Scene& scene);

/// Returns the metadata; the entries are described in docs/openvdb.md and docs/corona/grids.md.
sim::VdbMetadata volume_metadata(const sim::Scene& scene, const sim::SceneGrid& made);

/// Linear RGB of a unit of length of 1 photon cm^-3 s^-1, for the channel of each of the `lines` of the scene
/// (empty: all) and for the density, which has no colour.
std::vector<std::array<float, 3>> colours_of_channels(const sim::Scene& scene, const sim::SceneGrid& made,
                                                      const std::vector<int>& lines);

}  // namespace vegard::apps
