// The density nodes of a scene, prepared for evaluation: the signed distance of any node at any point.
//
// distance() is the node's signed distance. hull() is a lower bound of it, needs no evaluation of noise, and
// decreases by at most steepness() per unit of length. So, with h = hull(p), the distance is above e within
// (h - e) / steepness() around p; a march skips this.
//
// With a cutoff, distance() is exact where it is below the cutoff, and otherwise any number not below the
// cutoff, which saves work.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/emit/nebula/noise_octaves.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/nebula.h"

namespace vegard::sim {

struct Scene;

template <class T>
class NodeMap {
 public:
  /// `number` gives the scene's parameters as T.
  NodeMap(const Scene& scene, const NumberAs<T>& number);

  /// Returns the index of a node; -1 for an empty name. Any other name must be that of a node.
  int node(const std::string& name) const;

  T distance(int node, const T point[3], double cutoff = std::numeric_limits<double>::infinity()) const;
  double hull(int node, const double point[3]) const;
  double steepness(int node) const { return nodes_[node].steepness; }

 private:
  using Kind = NodeKind;
  struct Placed {
    Kind kind;
    std::vector<int> children;
    bool is_placed;  ///< false: upright and unstretched, in the middle
    T center[3];
    T turn[9];  ///< matrix by rows, from outer to inner coordinates, after the shift
    T stretch[3];
    T scale;  ///< factor on distances, from inner to outer coordinates
    T radius, thickness, length, waist, amplitude, blend;
    NoiseNumbers<T> noise;
    std::shared_ptr<const NoiseLattice> lattice;
    double steepness = 0.0;  ///< largest decrease of the hull per unit of length; 0: not known yet
  };

  Placed worked_out(const Scene& scene, const Node& node, const NumberAs<T>& number);
  void set_steepness(int index);
  T shape(const Placed& node, const T p[3]) const;
  T displaced(const Placed& node, const T p[3], double cutoff) const;
  T combined(const Placed& node, const T p[3], double cutoff) const;
  double hull_inside(const Placed& node, const double p[3]) const;

  std::vector<Placed> nodes_;
  std::map<std::string, int> by_name_;
  std::map<int, std::shared_ptr<const NoiseLattice>> lattices_;  ///< by the node's seed
};

extern template class NodeMap<double>;
extern template class NodeMap<FreeDual>;

}  // namespace vegard::sim
