// Footprints from pictures: over a box, around the Earth, or on the faces of a cube.
//
// Source of the projections: "Rendering volume nebulae and aurorae" (Gaia Sky), as read in docs/volumes.md,
// "Footprints": u = 1/2 - atan2(-z, -x) / 2π, v = 1/2 + asin(-y) / π, with y to the north pole.
#pragma once

#include <array>

#include "sim/base/image.h"
#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {

/// The pictures of a footprint from files: one channel each, as read_picture() returns it, top row first.
/// Null: none.
struct FootprintPictures {
  const Image* flux = nullptr;
  const Image* energy = nullptr;
  std::array<const Image*, 6> face{};  ///< px, nx, py, ny, pz, nz
  std::array<const Image*, 6> energy_face{};
};

/// A place on a picture, as a fraction of its width from the left and of its height from the top.
struct PicturePlace {
  double u, v;
};

/// Returns the place of a direction on an equirectangular picture of the Earth: north is up, east to the
/// right, longitude 0 in the middle, 180 degrees at both edges.
PicturePlace equirectangular_place(const double direction[3]);

/// Which of six pictures contains a direction, and where: 0 to 5 for px, nx, py, ny, pz, nz in the layout of
/// OpenGL's cube maps, whose y is the north pole and whose -x is longitude 0 (so that z is 90 degrees east).
struct CubePlace {
  int picture;
  PicturePlace at;
};
CubePlace cube_place(const double direction[3]);

/// Returns the map of a picture stretched over a box, north up, in units of energy_flux_mw_m2.
PlaneFootprint<double> picture_plane(const Footprint& footprint, const FootprintPictures& pictures,
                                     int threads);

/// Returns the map around the Earth from one picture or from six, in mW m^-2.
CubeFootprint<double> picture_cube(const Footprint& footprint, const FootprintPictures& pictures,
                                   int threads);

}  // namespace vegard::sim
