// [[chromosphere]]: noise between two concentric spheres of the Sun.
#include "sim/scene/table/parameter_rules.h"
#include "sim/scene/table/rows/line_component.h"
#include "sim/scene/table/rows/row.h"
#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value Chromosphere::*value) {
  return Row("chromosphere", key, &Scene::chromospheres, value);
}

}  // namespace

std::vector<Declaration> chromosphere_rows() {
  using C = Chromosphere;
  // clang-format off
  return {
      row("name", &C::name).rule(element_name_complaint).means("by which paths call the chromosphere"),
      row("innerradius", &C::innerradius).within(1e-3, 1e9).means("radius of the sphere below it, in units of the Sun's frame, as all its lengths"),
      row("outerradius", &C::outerradius).within(1e-3, 1e9).means("radius of the sphere above it"),
      row("roughness", &C::roughness).within(0, 1).may_be_free(ParameterScale::linear).means("height of an octave of its turbulence over that of the one before (ω)"),
      row("octaves", &C::octaves).within(1, 12).means("octaves of its turbulence"),
      row("scale", &C::scale).within(1e-3, 1e6).may_be_free(ParameterScale::logarithmic).means("length of the largest waves: size of the granules"),
      row("shift", &C::shift).of({"x", "y", "z"}).within(-1e6, 1e6).may_be_free(ParameterScale::linear).means("of the turbulence, in lengths of its largest waves"),
      row("coverage", &C::coverage).within(-1, 10).may_be_free(ParameterScale::linear).means("of the cutoff F(x) = amplitude (1 - exp(-(x - coverage) sharpness)), 0 where that is negative: turbulence up to it is empty"),
      row("sharpness", &C::sharpness).within(0, 1000).may_be_free(ParameterScale::logarithmic).means("of the cutoff: how soon it comes near to its amplitude"),
      row("amplitude", &C::amplitude).within(0, 1e6).may_be_free(ParameterScale::logarithmic).means("of the cutoff: the density that it comes near to"),
      row("biasmap", &C::biasmap).means("picture by latitude (from the north pole down) and longitude (-180° to 180°), beside the scene's file; empty: none"),
      row("peak", &C::peak).within(-1e6, 1e6).may_be_free(ParameterScale::linear).means("density that is added after the cutoff where that picture is white"),
      row("cutoff", &C::cutoff).means("false: the density is the turbulence as it is"),
      row("rayleigh", &C::rayleigh).of({"<line>"}).named_by(name_by_line).in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light of density 1 to a unit of path, per emission line; empty: it is dark"),
      row("extinction", &C::extinction).within(0, 1e6).may_be_free(ParameterScale::linear).means("extinction of density 1, to a unit of path: what lies behind it is dimmed"),
      row("step", &C::step).within(1e-3, 1e6).means("step of the march"),
  };
  // clang-format on
}

}  // namespace vegard::sim
