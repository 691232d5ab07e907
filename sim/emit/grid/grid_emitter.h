// The emitter of a grid: its light along rays.
//
// A ray is sampled in steps of step_voxels voxel edges, at the middles of steps that begin at the camera, by
// linear interpolation between the voxels' centres. A kilometre of 1 photon cm^-3 s^-1 gives 0.1 rayleigh;
// the light of a density is given by the scene (grid_home.h). Where the grid has a density and the scene an
// extinction for it, the light of a step is attenuated by the grid in front of it, and by the step itself as
// a uniform one: rayleighs += kept 0.1 e h (1 - exp(-x)) / x with x = extinction density h, and kept *=
// exp(-x). With an albedo and a lamp the step also scatters the lamp's light (grid_lamp.h): rayleighs += kept
// (1 - exp(-x)) albedo 4 pi p F exp(-extinction column).
#pragma once

#include <memory>
#include <vector>

#include "sim/emit/grid/grid_bricks.h"
#include "sim/emit/grid/grid_home.h"
#include "sim/emit/grid/grid_lamp.h"
#include "sim/emit/grid/grid_walk.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/sun.h"
#include "sim/scene/structs/volume.h"

namespace vegard::sim {

template <class T>
class GridEmitter : public Emitter<T> {
 public:
  /// `grid` must outlive it. `number` gives the parameters of volume and Sun as T; `sun` is the scene's Sun,
  /// needed if the volume is in its frame or lit by it; `share` is a factor on the grid's own light;
  /// `turned_rad` is that of grid_turn_rad(). The columns of density towards the lamp are taken over from
  /// `other`, an emitter of the same volume, if its lamp is at the same place in the grid.
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
  // For the scattering of a lamp's light:
  bool is_lit_ = false;
  T albedo_, asymmetry_;
  LampPlace lamp_;
  std::vector<double> flux_;  ///< [line] as lamp_flux()
  std::shared_ptr<const LampColumns> columns_;
};

extern template class GridEmitter<double>;
extern template class GridEmitter<FreeDual>;

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
