// The lines of sight of a film, cut into stretches: over which cell of the ground, along the field line, each
// stretch of a ray lies, and between which altitudes.
//
// The foot of a point is where the field line through it meets the sphere of the feet
// (sim/emit/footprint/foot.h), as in the geometry of footprints. A ray is cut where its foot passes to
// another cell: what lies between is told by the light below the altitudes of its ends.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/render/ground/ground_grid.h"
#include "sim/scene/structs/site.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

struct Scene;

/// Bins of altitude from 80 to 640 km, as fine as profiles are steep: 0.5 km below 130 km, 8 km at the top.
class AltitudeBins {
 public:
  AltitudeBins();
  int bins() const { return static_cast<int>(edge_km_.size()) - 1; }
  double edge_km(int bin) const { return edge_km_[static_cast<std::size_t>(bin)]; }
  double height_km(int bin) const { return edge_km(bin + 1) - edge_km(bin); }

  /// Altitudes at which stretches begin and end: each bin is cut into equal parts.
  static constexpr int kLevelsInBin = 4;
  int levels() const { return bins() * kLevelsInBin + 1; }
  double level_km(int level) const {
    const int bin = level / kLevelsInBin, part = level % kLevelsInBin;
    return part == 0 ? edge_km(bin) : edge_km(bin) + height_km(bin) * part / kLevelsInBin;
  }

 private:
  std::vector<double> edge_km_;
};

/// A part of a ray over one cell. Its ends are rounded to levels; what is left without height by that goes to
/// the next stretch, so that no length is lost.
struct SightStretch {
  std::uint32_t cell;
  std::uint16_t from, to;  ///< levels (AltitudeBins), from < to
  float km_per_km;         ///< of path, to one of altitude
};

/// The stretches of all rays; there is one ray per cell of the film, row by row.
struct SightLines {
  std::vector<SightStretch> stretch;
  std::vector<std::size_t> first;  ///< first stretch of each ray, and one entry more for the end
  std::size_t rays() const { return first.size() - 1; }
};

/// Returns the rays through the middles of the film's cells for which `wanted` is nonzero; other rays have no
/// stretches. `scene` is the photograph's own, `home` the site of the grid. A ray ends at the ground.
/// Once `stop` is true, the rays of the rows that are left get no stretches.
SightLines sight_lines(const Scene& scene, const Site& home, const GroundGrid& grid, const FilmGeometry& film,
                       const std::vector<std::uint8_t>& wanted, int threads,
                       const std::atomic<bool>* stop = nullptr);

/// Finds the pixel of the photograph where light at `altitude_km` on the field line through a foot of home's
/// frame appears; returns false if it is not in view.
bool pixel_over_foot(const Scene& scene, const Site& home, EastNorth foot_km, double altitude_km,
                     double& x_px, double& y_px);

}  // namespace vegard::sim
