// The lamp of a grid that scatters light, and how much of its light reaches each voxel.
//
// Single scattering, as for the volumes of pbrt (M. Pharr and G. Humphreys 2004, "Physically based
// rendering", section 16.3; S. Chandrasekhar 1950, "Radiative transfer", chapter I): of the lamp's photon
// flux F the grid itself transmits exp(-tau) on the way to a place; this light is scattered there once, and
// then only attenuated. With sigma the extinction at a place, a the albedo and p the phase function, a ray
// from s = 0 to the end collects
//   photons per area, time and solid angle = integral of T(s) sigma(s) a p F exp(-tau(s)) ds,
// where T is the transmission from the place to the camera. A rayleigh is 10^6 / (4 pi) photons cm^-2 s^-1
// sr^-1, so that with F in 10^6 photons cm^-2 s^-1 the rayleighs are 4 pi times that.
//
// The column of density between lamp and voxel is computed once for the corners of the grid's cells, as the
// exact integral of the interpolated density, and interpolated linearly.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/base/large_vector.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/emit/grid/grid_bricks.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/sun.h"
#include "sim/scene/structs/volume.h"

namespace vegard::sim {

/// The place of a lamp, in voxels of its grid.
struct LampPlace {
  bool is_far = true;
  double at[3] = {0.0, 0.0, 0.0};  ///< if is_far, the unit vector to the lamp; else its place
  double stop = 0.0;               ///< radius around the place at which its light begins, in voxels
};

/// Returns the place of the Sun as a lamp: parallel light from its direction in the sky; or, for a grid on
/// the Sun, the middle of the Sun's frame, with the light beginning at the photosphere. `turned_rad` is that
/// of grid_turn_rad().
LampPlace lamp_place(const GridBricks& grid, const Volume& volume, const Sun* sun, double turned_rad = 0.0);

/// Returns the lamp's flux per line, in 10^6 photons cm^-2 s^-1: of parallel light, or of a point lamp at the
/// distance of one voxel's edge. The Sun's flux is that of its disc, photosphere_rayleigh / 4 (R / d)² (1 - u
/// / 3 - v / 6): the brightness over 4 pi, times the solid angle, times the disc's mean limb darkening
/// (photosphere_emitter.h).
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

/// L. G. Henyey and J. L. Greenstein (1941, ApJ 93, 70): phase function per steradian; `cosine` is that of
/// the angle between the directions of light before and after scattering, and g, between -1 and 1, the mean
/// cosine. Its integral over all directions is 1.
///   (1 - g²) / (4 pi (1 + g² - 2 g cosine)^(3/2))
template <class T>
T henyey_greenstein(const T& cosine, const T& g) {
  const T square = g * g, base = square + 1.0 - g * cosine * 2.0;
  return (T(1.0) - square) / (base * square_root(base)) * (1.0 / (4.0 * kPi));
}

}  // namespace vegard::sim
