// Reads the voxel files that a scene names: OpenVDB, or pbrt's volumegrid.
#pragma once

#include <string>

#include "sim/base/grid/sparse_grid.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the name of a line's grid in such a file: "emission_5577" for 557.7 nm.
std::string emission_grid_name(double line_nm);

/// The grid of a scene's volume, read from its file.
struct VolumeGridFile {
  std::string place;          ///< the file's path, for messages
  SparseGrid grid;            ///< in km, or in sun.unit_km in the Sun's frame
  std::vector<int> emission;  ///< [line of the scene]: channel of the grid, -1: no light
  int density = -1;           ///< channel of the absorbing density, -1: none
  Site site;  ///< site of the grid's frame: from the file, else the volume's home, else the scene's
};

/// Reads the file of a volume. Light comes from the grids emission_grid_name(); but from the grid "density",
/// in every line, if the volume has density_rayleigh or the file has no emission at all. A volumegrid has
/// emission where it says a line's light of density 1 (VolumegridFile::numbers). A density below 0 is taken
/// as 0. If the metadata of the file has "frame" = "sun" (with "unit_km") or a site, volume.frame must agree;
/// files without both are placed by volume.frame. Throws Error(unreadable_input) that names the key, also for
/// a wrong frame.
VolumeGridFile read_volume_grid(const Scene& scene, const Volume& volume);

}  // namespace vegard::sim
