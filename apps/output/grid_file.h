// Files of voxels, OpenVDB or pbrt's volumegrid by their names: reading them, and the metadata and colours of
// those that hold a scene's light.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "sim/base/grid/sparse_grid.h"
#include "sim/base/grid/vdb_io.h"
#include "sim/render/volumes/scene_grid.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

struct GridFile {
  sim::SparseGrid grid;
  sim::VdbMetadata metadata;  ///< of an OpenVDB file
  /// Of a volumegrid: its number of voxels along each axis, and its colours.
  std::array<int, 3> size{0, 0, 0};
  std::map<std::string, std::array<double, 3>> colours;
  std::map<std::string, double> numbers;
};

bool is_vdb_name(const std::string& path);

/// Throws Error(usage) about the option `key` unless the name is that of an OpenVDB file or a volumegrid.
void check_grid_name(const std::string& key, const std::string& path);

/// Reads the named channels, or all if no names are given, into at most `max_bytes`. Throws Error(usage) that
/// lists the existing channels if one is missing, and as read_vdb() and read_volumegrid() do.
GridFile read_grid_file(const std::string& path, const std::vector<std::string>& channels,
                        std::uint64_t max_bytes = std::uint64_t{8} << 30);

/// The default channel if one is needed and none was named: "density", or the only one; -1 if neither exists.
int usual_channel(const sim::SparseGrid& grid);

/// "density, emission_171"
std::string channel_names(const sim::SparseGrid& grid);

/// The unit of lengths in a file with this metadata: "km", "units of 1000 km", "units".
std::string length_words(const sim::VdbMetadata& metadata);

/// Whether a grid of the scene's light is in the Sun's frame: grids never hold light of two frames.
bool is_of_sun(const sim::Scene& scene);

/// Returns the metadata; the entries are described in docs/openvdb.md and docs/corona/grids.md.
sim::VdbMetadata volume_metadata(const sim::Scene& scene, const sim::SceneGrid& made);

/// Linear RGB of a unit of length of 1 photon cm^-3 s^-1, for the channel of each of the `lines` of the scene
/// (empty: all) and for the density, which has no colour.
std::vector<std::array<float, 3>> colours_of_channels(const sim::Scene& scene, const sim::SceneGrid& made,
                                                      const std::vector<int>& lines);

}  // namespace vegard::apps
