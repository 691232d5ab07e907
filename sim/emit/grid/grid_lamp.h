// What lights a grid that scatters, and how much of its light comes to each voxel.
//
// Single scattering, as the volumes of pbrt have it (M. Pharr and G. Humphreys 2004, "Physically based
// rendering", section 16.3; S. Chandrasekhar 1950, "Radiative transfer", chapter I): of the lamp's photons F,
// per area, what the grid itself leaves on the way to a place, exp(-tau), is scattered there once, and then
// only weakened. With sigma the extinction at a place, a the albedo and p the phase function, a ray of light
// from s = 0 to the end has
//   photons per area, time and solid angle = integral of T(s) sigma(s) a p F exp(-tau(s)) ds,
// T what is left of the way to the camera. A rayleigh is 10^6 / (4 pi) photons cm^-2 s^-1 sr^-1, so that with
// F in 10^6 photons cm^-2 s^-1 the rayleighs are 4 pi times that.
//
// The column of density between lamp and voxel is worked out once for the corners of the grid's cells, as the
// exact integral of the interpolated density, and is linear in between.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/base/large_vector.h"
#include "sim/emit/grid/grid_bricks.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Where a lamp is, in the voxels of its grid.
struct LampPlace {
  bool is_far = true;
  double at[3] = {0.0, 0.0, 0.0};  ///< of a lamp that is far the direction to it, of length 1; else its place
  double stop = 0.0;               ///< radius about the place where its light begins, in voxels
};

/// Of the Sun as a lamp: parallel light from where it stands in the sky, or for a grid on the Sun the middle
/// of its frame, its light beginning at the photosphere. `turned_rad` of the grid as by grid_turn_rad().
LampPlace lamp_place(const GridBricks& grid, const Volume& volume, const Sun* sun, double turned_rad = 0.0);

/// Per line, in 10^6 photons cm^-2 s^-1: parallel, or of a point at a distance of one voxel's edge. The Sun's
/// is that of its disc, photosphere_rayleigh / 4 (R / d)² (1 - u / 3 - v / 6): brightness over 4 pi times
/// solid angle times the disc's mean (photosphere_emitter.h).
std::vector<double> lamp_flux(const GridBricks& grid, const Volume& volume, const Sun* sun);

/// Columns of density from the lamp.
class LampColumns {
 public:
  LampColumns() = default;
  /// `voxel_km`: the edge of a voxel in km. The bits do not depend on `threads`. Takes as much memory as the
  /// grid's density.
  LampColumns(const GridBricks& grid, const LampPlace& lamp, double voxel_km, int threads);

  /// [voxel of GridBricks::kSide^3], in km of density 1
  const float* of_brick(std::int32_t brick) const {
    return columns_.data() + static_cast<std::size_t>(brick) * GridBricks::kVoxels;
  }

 private:
  LargeVector<float> columns_;
};

}  // namespace vegard::sim
