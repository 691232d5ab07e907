// The files of voxels that a scene names: OpenVDB, or pbrt's volumegrid.
#pragma once

#include <string>

#include "sim/base/grid/sparse_grid.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// "emission_5577": tenths of a nanometre.
std::string emission_grid_name(double line_nm);

/// What a scene's volume reads from its file.
struct VolumeGridFile {
  std::string place;          ///< the file's path, for messages
  SparseGrid grid;            ///< in km, or in the scene's units of the Sun's frame
  std::vector<int> emission;  ///< [line of the scene] which channel, -1 where the file is dark
  int density = -1;           ///< the channel that absorbs, -1 for none
  Site
      site;  ///< whose frame the grid is in: that of the volume's home if the file names none, or the scene's
};

/// A file without a grid for any line, but with `density` and no other emission, shines by that in every
/// line; with density_rayleigh every file does. A density below 0 is taken as 0. A file whose metadata has
/// "frame" = "sun" and "unit_km" is the Sun's, and one that vegard has written of anything else is not; other
/// files are where the volume says. Throws Error(unreadable_input) that names the key, also for a file of the
/// other frame.
VolumeGridFile read_volume_grid(const Scene& scene, const Volume& volume);

}  // namespace vegard::sim
