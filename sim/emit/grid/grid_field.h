// A grid as a field in space, to be resampled.
#pragma once

#include <vector>

#include "sim/emit/grid/grid_bricks.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/sun.h"
#include "sim/scene/structs/volume.h"

namespace vegard::sim {

class GridField : public LightField {
 public:
  /// `grid` must outlive it. If the volume's frame is "sun", the field is in the Sun's frame too; `sun` is
  /// then the scene's Sun, and `turned_rad` the grid's rotation (grid_home.h).
  GridField(const GridBricks& grid, const Volume& volume, const Sun* sun = nullptr, double share = 1.0,
            double turned_rad = 0.0);

  double unit_cm() const override { return unit_km_ * 1e5; }
  Box3 bounds() const override;
  bool is_dark(const Box3& box) const override;
  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override;

 private:
  /// Returns the smallest box in voxels that contains a box of the frame.
  Box3 in_voxels(const Box3& box) const;

  const GridBricks& grid_;
  double unit_km_, from_[3];
  double turn_[3][3];         ///< from the frame to voxels: index = turn p + from
  std::vector<double> gain_;  ///< [line] photons cm^-3 s^-1 for the value 1
};

}  // namespace vegard::sim
