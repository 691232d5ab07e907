// Files of voxels, of whatever kind their names say: OpenVDB, or pbrt's volumegrid.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "sim/base/grid/sparse_grid.h"
#include "sim/base/grid/vdb_io.h"

namespace vegard::apps {

struct GridFile {
  sim::SparseGrid grid;
  sim::VdbMetadata metadata;  ///< of an OpenVDB file
  /// Of a volumegrid: its voxels, and its colours.
  std::array<int, 3> size{0, 0, 0};
  std::map<std::string, std::array<double, 3>> colours;
};

bool is_vdb_name(const std::string& path);

/// Throws Error(usage) about the option `key` unless the name is that of an OpenVDB file or a volumegrid.
void check_grid_name(const std::string& key, const std::string& path);

/// Reads the channels of these names, all if there are none, into at most `max_bytes`. Throws Error(usage)
/// that says which there are if one is not, and as read_vdb() and read_volumegrid() do.
GridFile read_grid_file(const std::string& path, const std::vector<std::string>& channels,
                        std::uint64_t max_bytes = std::uint64_t{8} << 30);

/// The channel to look at where one is wanted and none was named: "density", or else the only one; -1
/// if there is no telling.
int usual_channel(const sim::SparseGrid& grid);

/// "density, emission_171"
std::string channel_names(const sim::SparseGrid& grid);

/// Of the lengths in a file with this metadata: "km", "units of 1000 km", "units".
std::string length_words(const sim::VdbMetadata& metadata);

}  // namespace vegard::apps
