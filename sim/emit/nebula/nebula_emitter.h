// A nebula's light along rays, emission and absorption, in rayleighs; and the nebula as a field in its own
// frame, for grids.
//
// A ray's path through the bound is cut at multiples of `step` from its point nearest to the middle; each
// piece is taken as uniform, with the values at its middle. From a piece of optical depth tau, (1 -
// exp(-tau)) / tau of its own light emerges, and exp(-tau) of the light behind it (S. Chandrasekhar,
// "Radiative Transfer", 1950, chapter I). Pieces that are certainly empty are skipped, which does not change
// the light. For T = FreeDual the derivatives are exactly those of this sum.
#pragma once

#include <array>

#include "sim/emit/nebula/nebula_cloud.h"
#include "sim/emit/nebula/nebula_frame.h"
#include "sim/emit/nebula/node_map.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

template <class T>
class NebulaEmitter : public Emitter<T> {
 public:
  /// `skip` false: empty pieces are not skipped; for tests.
  NebulaEmitter(const Scene& scene, const Nebula& nebula, const NumberAs<T>& number, bool skip = true);

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override;
  bool absorbs() const override { return cloud_.has_dust(); }

 private:
  void march_ray(const T enu[3], double end_km, std::size_t ray, std::size_t rays,
                 const BundleLight<T>& out) const;

  NebulaFrame<T> frame_;
  NebulaCloud<T> cloud_;
  double step_;
  bool skip_;
};

extern template class NebulaEmitter<double>;
extern template class NebulaEmitter<FreeDual>;

/// The field's density is that of the dust, or of the gas if there is no dust. The integral of its emission
/// along a ray gives the rayleighs that the ray would collect without dust: 1 R is 10^6 photons cm^-2 s^-1.
class NebulaField : public LightField {
 public:
  NebulaField(const Scene& scene, const Nebula& nebula);

  double unit_cm() const override { return unit_cm_; }
  Box3 bounds() const override;
  bool is_dark(const Box3& box) const override;
  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override;

 private:
  NebulaCloud<double> cloud_;
  int lines_;
  double unit_cm_, bound_;
};

// The march of nebulae exactly as in its source, with the source's constants. It gives colours, not
// rayleighs.
//
// Source: the notes "Rendering volume aurorae and nebulae" on Gaia Sky's shaders; docs/nebulae.md lists its
// constants and the three corrections made here: the opacity is limited to [0, 1]; the colour of the light,
// which the source computes but does not use, multiplies its grey; and the depth is the distance along a unit
// vector.

/// The parameters of a nebula that the march needs. `map` must outlive it.
struct LiteralCloud {
  const NodeMap<double>& map;
  int node;
  double bound;  ///< radius of the sphere around it: √8
  double edge;   ///< h: 0.1
  std::array<double, 3> colour_a, colour_b;
};

LiteralCloud literal_cloud(const NodeMap<double>& map, const Nebula& nebula);

/// Returns red, green and blue from 0 to 1, not multiplied by the opacity, which is the fourth number. The
/// ray starts at `origin` along the unit vector `direction` and is stopped at the distance `depth`, all in
/// the nebula's frame and unit.
std::array<double, 4> literal_march(const LiteralCloud& cloud, const std::array<double, 3>& origin,
                                    const std::array<double, 3>& direction, double depth);

}  // namespace vegard::sim
