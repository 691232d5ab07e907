#include "sim/emit/nebula/node_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "sim/emit/nebula/node_shapes.h"
#include "sim/scene/structs/nebula.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

/// Returns the most that noise of amplitude 1 can change a distance.
template <class T>
double reach_of(const NoiseNumbers<T>& noise) {
  return NoiseLattice::kLargest * octave_total(noise);
}

/// True if a node has a placement to apply; for derivatives it always has, since its numbers may be free.
template <class T>
bool must_place(const Node& node) {
  if (!std::is_same_v<T, double>) return true;
  for (int axis = 0; axis < 3; ++axis)
    if (node.center[axis] != 0.0 || node.angles_deg[axis] != 0.0 || node.stretch[axis] != 1.0) return true;
  return false;
}

}  // namespace

template <class T>
NodeMap<T>::NodeMap(const Scene& scene, const NumberAs<T>& number) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) by_name_[scene.nodes[i].name] = static_cast<int>(i);
  for (const Node& node : scene.nodes) nodes_.push_back(worked_out(scene, node, number));
  for (std::size_t i = 0; i < nodes_.size(); ++i) set_steepness(static_cast<int>(i));
}

template <class T>
int NodeMap<T>::node(const std::string& name) const {
  return name.empty() ? -1 : by_name_.at(name);
}

template <class T>
typename NodeMap<T>::Placed NodeMap<T>::worked_out(const Scene& scene, const Node& node,
                                                   const NumberAs<T>& number) {
  Placed to;
  to.kind = node.kind;
  for (const std::string& name : node_names(node.of)) to.children.push_back(by_name_.at(name));
  to.is_placed = must_place<T>(node);
  T angle[3], product(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    to.center[axis] = number(node.center[axis]);
    angle[axis] = number(node.angles_deg[axis]);
    to.stretch[axis] = number(node.stretch[axis]);
    product = product * to.stretch[axis];
  }
  turn_inside(angle, to.turn);
  const double mean = std::cbrt(value_of(product));
  to.scale = T(mean) * (product * (1.0 / (3.0 * value_of(product))) + (2.0 / 3.0));  // its first two terms
  to.radius = number(node.radius);
  to.thickness = number(node.thickness);
  to.length = number(node.length);
  to.waist = number(node.waist);
  to.amplitude = number(node.amplitude);
  to.blend = number(node.blend);
  to.noise = {number(node.frequency), number(node.gain), node.octaves};
  if (to.kind == Kind::filaments || to.kind == Kind::turbulence || to.kind == Kind::warp) {
    auto& lattice = lattices_[node.seed];
    if (!lattice)
      lattice = std::make_shared<const NoiseLattice>(scene.seed, Stream::nebula,
                                                     static_cast<std::uint32_t>(node.seed));
    to.lattice = lattice;
  }
  return to;
}

template <class T>
void NodeMap<T>::set_steepness(int index) {
  Placed& node = nodes_[index];
  if (node.steepness > 0.0) return;
  double inside = node.children.empty() ? 1.0 : 0.0;
  for (const int child : node.children) {
    set_steepness(child);
    inside = std::max(inside, nodes_[child].steepness);
  }
  double least = value_of(node.stretch[0]);
  for (const T& stretch : node.stretch) least = std::min(least, value_of(stretch));
  node.steepness = inside * value_of(node.scale) / least;
}

template <class T>
T NodeMap<T>::distance(int index, const T point[3], double cutoff) const {
  const Placed& node = nodes_[index];
  T inner[3] = {point[0], point[1], point[2]};
  if (node.is_placed) {
    to_inside(node, point, inner);
    cutoff = cutoff / value_of(node.scale);
  }
  T d(0.0);
  switch (node.kind) {
    case Kind::filaments:
    case Kind::turbulence:
    case Kind::warp:
      d = displaced(node, inner, cutoff);
      break;
    case Kind::unite:
    case Kind::intersect:
    case Kind::subtract:
      d = combined(node, inner, cutoff);
      break;
    case Kind::scale:
    case Kind::rotate:
    case Kind::move:
      d = distance(node.children[0], inner, cutoff);
      break;
    case Kind::sphere:
    case Kind::shell:
    case Kind::lobes:
    case Kind::torus:
    case Kind::tube:
    case Kind::slab:
      d = shape(node, inner);
      break;
  }
  return node.is_placed ? d * node.scale : d;
}

template <class T>
T NodeMap<T>::shape(const Placed& node, const T p[3]) const {
  switch (node.kind) {
    case Kind::sphere:
      return sphere_distance(p, node.radius);
    case Kind::shell:
      return shell_distance(p, node.radius, node.thickness);
    case Kind::lobes:
      return lobes_distance(p, node.radius, node.length, node.waist, node.thickness);
    case Kind::torus:
      return torus_distance(p, node.radius, node.thickness);
    case Kind::tube:
      return tube_distance(p, node.radius, node.length);
    default:
      assert(node.kind == Kind::slab);
      return slab_distance(p, node.thickness);
  }
}

template <class T>
T NodeMap<T>::displaced(const Placed& node, const T p[3], double cutoff) const {
  const int child = node.children[0];
  const double amplitude = value_of(node.amplitude);
  if (node.kind == Kind::filaments) {
    const double below = std::min(amplitude, 0.0);
    const T smooth = distance(child, p, cutoff - below);
    if (value_of(smooth) + below >= cutoff) return smooth + below;
    const double least = amplitude > 0.0 ? 1.0 - (cutoff - value_of(smooth)) / amplitude
                                         : -std::numeric_limits<double>::infinity();
    return smooth + node.amplitude * (T(1.0) - ridges_of(*node.lattice, node.noise, p, least));
  }
  const double reach = std::abs(amplitude) * reach_of(node.noise);
  if (node.kind == Kind::turbulence) {
    const T smooth = distance(child, p, cutoff + reach);
    if (value_of(smooth) - reach >= cutoff) return smooth - reach;
    return smooth + node.amplitude *
                        octaves_of(*node.lattice, node.noise, p, 0.0, amplitude, cutoff - value_of(smooth));
  }
  const double here[3] = {value_of(p[0]), value_of(p[1]), value_of(p[2])};
  const double least = hull_inside(node, here);
  if (least >= cutoff) return T(least);
  T warped[3];
  constexpr double kShift = 23.37;  // between the three noises that are the vector
  for (int axis = 0; axis < 3; ++axis)
    warped[axis] = p[axis] + node.amplitude * octaves_of(*node.lattice, node.noise, p, axis * kShift);
  return distance(child, warped, cutoff);
}

template <class T>
T NodeMap<T>::combined(const Placed& node, const T p[3], double cutoff) const {
  const double blend = value_of(node.blend);
  if (node.kind == Kind::unite) {
    // A branch left undone may hide a rounding, which reaches blend far and takes off blend / 4.
    const double loose = cutoff + 1.25 * blend * static_cast<double>(node.children.size());
    T all = distance(node.children[0], p, loose);
    for (std::size_t i = 1; i < node.children.size(); ++i)
      all = blended_least(all, distance(node.children[i], p, loose), node.blend);
    return all;
  }
  T all = distance(node.children[0], p, cutoff);
  for (std::size_t i = 1; i < node.children.size(); ++i) {
    if (value_of(all) >= cutoff) return all;
    if (node.kind == Kind::intersect) {
      const T next = distance(node.children[i], p, cutoff);
      if (value_of(next) >= cutoff) return next;
      all = blended_most(all, next, node.blend);
    } else {
      all = blended_most(all, T(0.0) - distance(node.children[i], p, blend - value_of(all)), node.blend);
    }
  }
  return all;
}

template <class T>
double NodeMap<T>::hull(int index, const double point[3]) const {
  const Placed& node = nodes_[index];
  if (!node.is_placed) return hull_inside(node, point);
  double inner[3];
  to_inside(node, point, inner);
  return hull_inside(node, inner) * value_of(node.scale);
}

template <class T>
double NodeMap<T>::hull_inside(const Placed& node, const double p[3]) const {
  const double amplitude = value_of(node.amplitude);
  const auto child = [&](std::size_t i) { return hull(node.children[i], p); };
  switch (node.kind) {
    case Kind::sphere:
      return sphere_distance(p, value_of(node.radius));
    case Kind::shell:
      return shell_distance(p, value_of(node.radius), value_of(node.thickness));
    case Kind::lobes:
      return cylinder_distance(p, value_of(node.radius), value_of(node.length)) -
             0.5 * value_of(node.thickness);
    case Kind::torus:
      return torus_distance(p, value_of(node.radius), value_of(node.thickness));
    case Kind::tube:
      return tube_distance(p, value_of(node.radius), value_of(node.length));
    case Kind::slab:
      return slab_distance(p, value_of(node.thickness));
    case Kind::filaments:
      return child(0) + std::min(amplitude, 0.0);
    case Kind::turbulence:
      return child(0) - std::abs(amplitude) * reach_of(node.noise);
    case Kind::warp:
      return child(0) -
             nodes_[node.children[0]].steepness * std::sqrt(3.0) * std::abs(amplitude) * reach_of(node.noise);
    case Kind::unite: {
      double least = child(0);
      for (std::size_t i = 1; i < node.children.size(); ++i) least = std::min(least, child(i));
      return least - 0.25 * value_of(node.blend) * static_cast<double>(node.children.size() - 1);
    }
    case Kind::intersect: {
      double most = child(0);
      for (std::size_t i = 1; i < node.children.size(); ++i) most = std::max(most, child(i));
      return most;
    }
    case Kind::subtract:
    case Kind::scale:
    case Kind::rotate:
    case Kind::move:
      return child(0);
  }
  return 0.0;
}

template class NodeMap<double>;
template class NodeMap<FreeDual>;

}  // namespace vegard::sim
