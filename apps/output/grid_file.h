// Reads files of voxels, of the kind given by their names: OpenVDB, or pbrt's volumegrid.
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
  /// Of a volumegrid: its number of voxels along each axis, and its colours.
  std::array<int, 3> size{0, 0, 0};
  std::map<std::string, std::array<double, 3>> colours;
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

}  // namespace vegard::apps
