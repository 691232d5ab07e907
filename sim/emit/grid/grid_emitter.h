// Light from a grid: an emitter for cameras.
//
// A ray is sampled every step_voxels of a voxel's edge, in the middles of steps counted from the camera, by
// linear interpolation between the voxels' centres. A kilometre of 1 photon cm^-3 s^-1 is 0.1 rayleigh; light
// of a density is as the scene says (grid_home.h). Where the grid has a density and the scene an extinction
// for it, light of a step is weakened by what lies before it, and by the step itself as a uniform one:
// rayleighs += kept 0.1 e h (1 - exp(-x)) / x with x = extinction density h, and kept *= exp(-x).
// With an albedo and a lamp the step scatters the lamp's light besides (grid_lamp.h): rayleighs += kept (1 -
// exp(-x)) albedo 4 pi p F exp(-extinction column).
#pragma once

#include <memory>
#include <vector>

#include "sim/emit/grid/grid_bricks.h"
#include "sim/emit/grid/grid_home.h"
#include "sim/emit/grid/grid_lamp.h"
#include "sim/emit/grid/grid_walk.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

template <class T>
class GridEmitter : public Emitter<T> {
 public:
  /// `grid` must outlive it. `number` gives the volume's and the Sun's numbers as T; `sun` is the scene's,
  /// for a volume whose frame it is or that it lights; `share` is a factor of the grid's own light,
  /// `turned_rad` as by grid_turn_rad(). What the lamp's light passes is taken over from `other`, of the same
  /// volume, where its lamp is in the same place of the grid.
  GridEmitter(const GridBricks& grid, const Volume& volume, const NumberAs<T>& number,
              const Sun* sun = nullptr, double share = 1.0, double turned_rad = 0.0, int threads = 1,
              const GridEmitter* other = nullptr);

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override;
  bool absorbs() const override { return absorbs_; }
  bool is_mixed() const override { return !absorbs_; }

 private:
  const GridBricks& grid_;
  GridHome<T> home_;
  T extinction_;
  double step_km_;
  bool absorbs_;
  // What scatters a lamp's light:
  bool is_lit_ = false;
  T albedo_, asymmetry_;
  LampPlace lamp_;
  std::vector<double> flux_;  ///< [line] as lamp_flux()
  std::shared_ptr<const LampColumns> columns_;
};

extern template class GridEmitter<double>;
extern template class GridEmitter<FreeDual>;

}  // namespace vegard::sim
