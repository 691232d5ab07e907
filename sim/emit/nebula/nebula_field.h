// A nebula as a field in space, in its own frame, for grids.
#pragma once

#include "sim/emit/nebula/nebula_cloud.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

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

}  // namespace vegard::sim
