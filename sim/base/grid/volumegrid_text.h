// The text in which pbrt, version 1, keeps a volume of densities: `Volume "volumegrid"`, in and out.
//
//   Volume "volumegrid" "integer nx" [300] "integer ny" [300] "integer nz" [300]
//     "point p0" [-150 -150 -150] "point p1" [150 150 150]
//     "color sigma_a" [0 0 0] "color Le" [1 1 1] "float density" [ 0 0 0.5 ... ]
//
// Densities are counted with x fastest, then y, then z, and hold in the middles of the nx ny nz equal cells
// of the box from p0 to p1; parameters come in any order, a single value with or without brackets, and #
// begins a comment. Source: M. Pharr, G. Humphreys, Physically Based Rendering (2004), section 12.3, and pbrt
// 1's own reading of it. What else a file says before and behind the volume (cameras, transforms, lights) is
// passed over, so the box is where the parameters put it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "sim/base/grid/sparse_grid.h"

namespace vegard::sim {

/// ".pbrt", ".volumegrid" or ".txt", in capitals or not.
bool is_volumegrid_name(const std::string& path);

struct VolumegridFile {
  SparseGrid grid;                   ///< one channel "density"; zeros are left empty
  std::array<int, 3> size{0, 0, 0};  /// nx, ny, nz: voxels from (0, 0, 0) on
  /// Of "sigma_a", "sigma_s", "Le" and others of type color, as they stand; all else is passed over.
  std::map<std::string, std::array<double, 3>> colours;
};

/// Reads a piece of the text at a time; beside the bricks there are only densities that come before their nx,
/// ny and nz. p0 and p1 that are left out are pbrt's: 0 0 0 and 1 1 1. Throws Error(unreadable_input) with
/// file and line for what is not there, no number, too many or too few densities, a file that is cut off,
/// sides beyond 65536, corners beyond 1e12, voxels below 1e-9 or above 1e9 or that are no cubes to a part in
/// 10000, what is given twice, and for bricks and the list of those of one layer of more than `max_bytes`.
VolumegridFile read_volumegrid(const std::string& path, std::uint64_t max_bytes = std::uint64_t{8} << 30);

struct VolumegridOptions {
  std::array<int, 3> size{0, 0, 0};  ///< the box that is written is at least from voxel (0, 0, 0) to this
  std::map<std::string, std::array<double, 3>> colours;
  bool overwrite = false;
};

/// Writes one channel, in the smallest box about what is not 0: whole or not at all. Numbers stand as
/// shortly as they can and are read as the same floats. The grid must not be turned (axes as a new one's).
/// Throws Error(unwritable_output), also for what would have more than 2^33 numbers, and as WholeFile.
void write_volumegrid(const std::string& path, const SparseGrid& grid, int channel,
                      const VolumegridOptions& options);

}  // namespace vegard::sim
