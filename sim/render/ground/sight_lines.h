// The lines of sight of a film through bundles of field lines: which cell of the ground each stretch of a ray
// hangs over, and at what altitude.
//
// Light of a point has its foot where the field line through it meets the sphere of the feet
// (sim/emit/footprint/foot.h), the geometry of footprints. A ray is cut at the bounds of the altitude bins
// and wherever its foot goes on to another cell; eight bytes a stretch are all that the light's sums need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/render/ground/ground_grid.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Bins of altitude from 80 to 640 km, as fine as profiles are steep: 0.5 km below 130 km, 8 km at the top.
class AltitudeBins {
 public:
  AltitudeBins();
  int bins() const { return static_cast<int>(edge_km_.size()) - 1; }
  double edge_km(int bin) const { return edge_km_[static_cast<std::size_t>(bin)]; }

 private:
  std::vector<double> edge_km_;
};

struct SightStretch {
  std::uint32_t cell;
  std::uint16_t bin;
  std::uint16_t length;  ///< in kSightUnitKm
};
/// What a ray's stretches are rounded to; the remainder goes on to the next, so that none is lost.
inline constexpr double kSightUnitKm = 1.0 / 256.0;

/// Rays by the film's cells, row by row.
struct SightLines {
  std::vector<SightStretch> stretch;
  std::vector<std::size_t> first;  ///< of a ray; one more than there are rays
  std::size_t rays() const { return first.size() - 1; }
};

/// Rays through the middles of those of a film's cells that are `wanted`; the others have no stretches. The
/// scene is the photograph's own, `home` the site that the grid is about. A ray ends at the ground.
SightLines sight_lines(const Scene& scene, const Site& home, const GroundGrid& grid, const FilmGeometry& film,
                       const std::vector<std::uint8_t>& wanted, int threads);

/// Where light over a foot of home's frame, so high on its field line, is in the photograph's picture, in
/// pixels; false where it is not in view.
bool pixel_over_foot(const Scene& scene, const Site& home, EastNorth foot_km, double altitude_km,
                     double& x_px, double& y_px);

}  // namespace vegard::sim
