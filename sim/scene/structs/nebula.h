// [[nebula]] and [[node]]: clouds beyond the air, and what their density maps are made of. "The source" is
// the publication that they follow.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "sim/base/number/vec3.h"

namespace vegard::sim {

enum class NebulaMethod {
  physical,  ///< emission and absorption along each ray, in rayleighs
  literal    ///< the source's algorithm with its constants, which gives colours only
};

/// The colours of NebulaMethod::literal.
enum class LiteralColour {
  two,   ///< colour_a and colour_b
  white  ///< as in the source, which computes a colour and does not use it
};

/// A nebula, or any cloud in space: emission and absorption by a few density maps (docs/nebulae.md).
/// Lengths are in units of `unit_pc`.
struct Nebula {
  std::string name = "nebula";
  NebulaMethod method = NebulaMethod::physical;
  double azimuth_deg = 0.0, elevation_deg = 45.0;  ///< of its middle
  double distance_pc = 1000.0;                     ///< of its middle
  double unit_pc = 1.0;
  double position_angle_deg = 0.0;    ///< anticlockwise in the picture
  double bound = 2.8284271247461903;  ///< radius of the sphere around it; the default is the source's sqrt(8)
  double edge = 0.1;                  ///< distance over which the density falls from 1 to 0 (h)
  double step = 0.02;                 ///< of the march

  std::string gas;   ///< node of the gas that emits lines; empty: none
  std::string glow;  ///< node of a second emission; empty: none
  std::string dust;  ///< node of the absorbing dust; empty: none
  std::vector<double>
      inner_rayleigh;  ///< per line: of the gas at density 1, per unit of path, within inner_radius
  std::vector<double> outer_rayleigh;             ///< the same beyond outer_radius
  std::vector<double> glow_rayleigh;              ///< the same of the glow
  double inner_radius = 0.3, outer_radius = 1.5;  ///< range of the transition from inner to outer
  double density_power = 1.0;                     ///< light is proportional to density to this power
  double brightness = 1.0;                        ///< factor on all light
  double dust_depth = 0.0;                        ///< optical depth at 550 nm of density 1 per unit of path
  double dust_exponent = 1.3;                     ///< optical depth ~ wavelength^-dust_exponent
  std::array<double, 3> colour_a{1.0, 0.5, 0.3}, colour_b{0.3, 0.6, 1.0};  ///< of the literal method
  LiteralColour literal_colour = LiteralColour::two;
};

/// A shape; noise added to another node; a combination of nodes; or a transformation of a node.
enum class NodeKind {
  sphere,
  shell,
  lobes,
  torus,
  tube,
  slab,
  filaments,
  turbulence,
  warp,
  unite,
  intersect,
  subtract,
  scale,
  rotate,
  move
};

/// One node of a density map: a signed distance, negative inside, in its nebula's units.
struct Node {
  std::string name = "node";
  NodeKind kind = NodeKind::sphere;
  std::string of;                                   ///< names of its operand nodes, separated by commas
  std::array<double, 3> center{0.0, 0.0, 0.0};      ///< right, up, towards the observer
  std::array<double, 3> angles_deg{0.0, 0.0, 0.0};  ///< rotations about these axes, one after the other
  std::array<double, 3> stretch{1.0, 1.0, 1.0};     ///< factors along these axes
  double radius = 1.0;
  double thickness = 0.1;
  double length = 1.0;
  double waist = 0.2;
  double amplitude = 0.1;
  double frequency = 1.0;
  double gain = 0.5;  ///< amplitude of an octave over that of the previous one
  double blend = 0.0;
  int octaves = 5;
  int seed = 0;
};

/// Splits Node::of, such as "hull, lobes", into names without blanks around them; empty for an empty text.
std::vector<std::string> node_names(const std::string& of);

/// The number of nodes that a kind of node takes as operands.
struct NodeArity {
  std::size_t least = 0, most = 0;
  std::string words() const;  ///< "no other node", "one node", "two nodes or more"
};

NodeArity arity_of(NodeKind kind);

}  // namespace vegard::sim
