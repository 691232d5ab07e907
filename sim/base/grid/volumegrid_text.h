// Reads and writes volumes of densities in the text format of pbrt, version 1: `Volume "volumegrid"`.
//
//   Volume "volumegrid" "integer nx" [300] "integer ny" [300] "integer nz" [300]
//     "point p0" [-150 -150 -150] "point p1" [150 150 150]
//     "color sigma_a" [0 0 0] "color Le" [1 1 1] "float density" [ 0 0 0.5 ... ]
//
// Densities vary fastest in x, then y, then z, and are those at the centres of the nx ny nz equal cells of
// the box from p0 to p1. Parameters are in any order, a single value is with or without brackets, and #
// begins a comment. Source: M. Pharr, G. Humphreys, Physically Based Rendering (2004), section 12.3, and the
// parser of pbrt 1. Everything else before and after the volume (cameras, transforms, lights) is ignored, so
// the box is not transformed.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "sim/base/grid/sparse_grid.h"

namespace vegard::sim {

/// True for the extensions ".pbrt", ".volumegrid" and ".txt", without regard to case.
bool is_volumegrid_name(const std::string& path);

struct VolumegridFile {
  SparseGrid grid;                   ///< one channel "density"; zeros are not stored
  std::array<int, 3> size{0, 0, 0};  ///< nx, ny, nz: voxels from (0, 0, 0) on
  /// "sigma_a", "sigma_s", "Le" and other parameters of type color, unchanged; others are ignored.
  std::map<std::string, std::array<double, 3>> colours;
  /// Parameters of type float that are one number, such as a line's light ("emission_5577"): of density 1, in
  /// photons cm^-3 s^-1. pbrt has no such parameters, and passes over them.
  std::map<std::string, double> numbers;
};

/// Reads a file piece by piece; memory is needed for the bricks, and for densities only if they come before
/// nx, ny and nz. Missing p0 and p1 have pbrt's defaults, 0 0 0 and 1 1 1. Throws Error(unreadable_input)
/// with file and line for missing or repeated parameters, invalid numbers, too many or too few densities, a
/// truncated file, sides beyond 65536, corners beyond 1e12, voxels below 1e-9, above 1e9 or not cubic to a
/// part in 10000, and if the bricks and the list of bricks of one layer need more than `max_bytes`.
VolumegridFile read_volumegrid(const std::string& path, std::uint64_t max_bytes = std::uint64_t{8} << 30);

struct VolumegridOptions {
  std::array<int, 3> size{0, 0, 0};  ///< the written box contains at least the voxels from (0, 0, 0) to this
  std::map<std::string, std::array<double, 3>> colours;
  std::map<std::string, double> numbers;
  bool overwrite = false;
};

/// Writes one channel, in the smallest box around the voxels that are not 0, completely or not at all.
/// Numbers are the shortest that read back as the same floats. The grid must not be rotated (default axes).
/// Throws Error(unwritable_output), also for more than 2^33 numbers, and as WholeFile.
void write_volumegrid(const std::string& path, const SparseGrid& grid, int channel,
                      const VolumegridOptions& options);

}  // namespace vegard::sim
