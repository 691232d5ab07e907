// [[node]]: what the density maps of nebulae are made of.
#include "sim/scene/table/parameter_rules.h"
#include "sim/scene/table/rows/row.h"
#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value Node::*value) {
  return Row("node", key, &Scene::nodes, value);
}

}  // namespace

std::vector<Declaration> node_rows() {
  // clang-format off
  return {
      row("name", &Node::name).rule(element_name_complaint).means("by which other nodes, nebulae and paths call it"),
      row("kind", &Node::kind)
          .one_of({"sphere", "shell", "lobes", "torus", "tube", "slab", "filaments", "turbulence", "warp", "union", "intersection", "difference", "scale", "rotate", "move"})
          .means("what it is: docs/nebulae.md"),
      row("of", &Node::of).means("names of the nodes that it works on, separated by commas"),
      row("center", &Node::center).of({"right", "up", "near"}).within(-1000, 1000).may_be_free(ParameterScale::linear)
          .means("place of a shape's middle: to the right, up and towards the observer"),
      row("angles_deg", &Node::angles_deg).of({"right", "up", "near"}).in("deg").within(-720, 720).may_be_free(ParameterScale::angle)
          .means("turns of what it is or works on, about these axes one after the other"),
      row("stretch", &Node::stretch).of({"right", "up", "near"}).within(0.01, 100).may_be_free(ParameterScale::logarithmic)
          .means("stretch of what it is or works on along these axes, before any turn"),
      row("radius", &Node::radius).within(0, 1000).may_be_free(ParameterScale::linear).means("of a sphere, shell, torus, tube; the largest of lobes"),
      row("thickness", &Node::thickness).within(1e-6, 1000).may_be_free(ParameterScale::logarithmic).means("of a shell's, slab's and lobes' walls and of a torus's ring, from side to side"),
      row("length", &Node::length).within(0, 1000).may_be_free(ParameterScale::linear).means("from the middle to the end of lobes or of a tube"),
      row("waist", &Node::waist).within(0, 1000).may_be_free(ParameterScale::linear).means("radius of lobes in the middle"),
      row("amplitude", &Node::amplitude).within(-100, 100).may_be_free(ParameterScale::linear).means("of filaments, turbulence and warp, in lengths"),
      row("frequency", &Node::frequency).within(1e-3, 1e3).may_be_free(ParameterScale::logarithmic).means("of the largest waves of noise, to a unit of length"),
      row("gain", &Node::gain).within(0, 1).may_be_free(ParameterScale::linear).means("height of an octave of noise over that of the one before"),
      row("blend", &Node::blend).within(0, 100).may_be_free(ParameterScale::linear).means("length over which a union, intersection or difference is rounded; 0: sharp"),
      row("octaves", &Node::octaves).within(1, 12).means("of noise"),
      row("seed", &Node::seed).within(0, 1e9).means("of its noise, beside the scene's"),
  };
  // clang-format on
}

}  // namespace vegard::sim
