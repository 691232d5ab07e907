// A grid as a field in space, to be sampled anew.
#pragma once

#include "sim/emit/grid/grid_bricks.h"
#include "sim/light/emitter.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

class GridField : public LightField {
 public:
  /// `grid` must outlive it.
  GridField(const GridBricks& grid, const Volume& volume);

  Box3 bounds() const override;
  bool is_dark(const Box3& box) const override;
  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override;

 private:
  /// The smallest box in voxels about one of the observer's.
  Box3 in_voxels(const Box3& box) const;

  const GridBricks& grid_;
  double gain_, from_[3];
};

}  // namespace vegard::sim
