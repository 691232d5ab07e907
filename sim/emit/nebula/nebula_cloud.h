// The gas, glow and dust of a nebula at a point, and their emission and absorption.
//
// With the signed distance d of a node and the nebula's edge e the density is clamp(1 - d / e, 0, 1). Light,
// in rayleighs to a unit of path, is
//
//     brightness (gas^p (inner + (outer - inner) s) + glow glow_rayleigh)
//
// per line, where s is a smooth step of the distance from the middle between inner_radius and outer_radius.
// The extinction is dust_depth dust (λ / 550 nm)^-dust_exponent per unit of path.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "sim/emit/nebula/node_map.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Emission and extinction per line and unit of path.
template <class T>
struct CloudAt {
  T light[kMaxLines], loss[kMaxLines];
};

struct CloudDensity {
  double gas = 0.0, glow = 0.0, dust = 0.0;
};

template <class T>
class NebulaCloud {
 public:
  NebulaCloud(const Scene& scene, const Nebula& nebula, const NumberAs<T>& number);

  bool has_dust() const { return dust_ >= 0; }

  /// Returns the radius around the point within which the nebula is certainly empty, in the nebula's unit; 0
  /// or less if it is not known.
  double empty_about(const double point[3]) const;

  /// Returns false if the nebula is empty at the point; `at` is then not set.
  bool sample(const T point[3], CloudAt<T>& at) const;

  CloudDensity densities(const double point[3]) const;

 private:
  T density(int node, const T point[3]) const;

  NodeMap<T> nodes_;
  int gas_, glow_, dust_, lines_;
  T edge_, power_, brightness_, inner_radius_, outer_radius_;
  T inner_[kMaxLines], outer_[kMaxLines], of_glow_[kMaxLines];  ///< multiplied by the brightness
  T depth_[kMaxLines];
};

extern template class NebulaCloud<double>;
extern template class NebulaCloud<FreeDual>;

}  // namespace vegard::sim
