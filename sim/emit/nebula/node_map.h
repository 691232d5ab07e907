// The density nodes of a scene, worked out for asking: signed distances of any node at any point.
//
// Two things may be asked. distance() is the node's. hull() is below it everywhere, costs no noise, and falls
// no faster than steepness() to a unit of length, so that from h = hull(p) the distance stays above e for
// (h - e) / steepness() about p: that is how a march knows what it may skip.
//
// With a cutoff, distance() is exact below it, and no less than it elsewhere: nodes then leave work undone
// where nothing can come below.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/emit/nebula/noise_octaves.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

template <class T>
class NodeMap {
 public:
  /// `number` gives the scene's numbers as T.
  NodeMap(const Scene& scene, const NumberAs<T>& number);

  /// The index of a node, or -1 of no name. The name must be that of a node.
  int node(const std::string& name) const;

  T distance(int node, const T point[3], double cutoff = std::numeric_limits<double>::infinity()) const;
  double hull(int node, const double point[3]) const;
  double steepness(int node) const { return nodes_[node].steepness; }

 private:
  using Kind = NodeKind;
  struct Placed {
    Kind kind;
    std::vector<int> of;
    bool is_placed;  ///< anywhere but upright, unstretched in the middle
    T center[3];
    T turn[9];  ///< rows: from the outside to the inside, after shifting
    T stretch[3];
    T scale;  ///< of distances, from the inside to the outside
    T radius, thickness, length, waist, amplitude, blend;
    NoiseNumbers<T> noise;
    std::shared_ptr<const NoiseLattice> lattice;
    double steepness = 0.0;  ///< how fast the hull may fall to a unit of length; 0: not known yet
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
