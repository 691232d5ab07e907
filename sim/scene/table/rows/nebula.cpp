// [[nebula]]: clouds beyond the air, by their density maps.
#include "sim/scene/table/parameter_rules.h"
#include "sim/scene/table/rows/line_component.h"
#include "sim/scene/table/rows/row.h"
#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value Nebula::*value) {
  return Row("nebula", key, &Scene::nebulae, value);
}

}  // namespace

std::vector<Declaration> nebula_rows() {
  using N = Nebula;
  // clang-format off
  return {
      row("name", &N::name).rule(element_name_complaint).means("by which paths call the nebula"),
      row("method", &N::method).one_of({"physical", "literal"})
          .means("emission and absorption along each ray, in rayleighs; or the source's march with its constants, which gives colours only"),
      row("azimuth_deg", &N::azimuth_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("direction of its middle, from north to the east"),
      row("elevation_deg", &N::elevation_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("direction of its middle above the horizon"),
      row("distance_pc", &N::distance_pc).in("pc").within(0, 1e7).may_be_free(ParameterScale::logarithmic).means("distance of its middle; less than its bound: the camera is inside"),
      row("unit_pc", &N::unit_pc).in("pc").within(1e-6, 1e6).may_be_free(ParameterScale::logarithmic).means("its unit of length, which all its lengths are in"),
      row("position_angle_deg", &N::position_angle_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("how far it is turned anticlockwise, as the observer sees it"),
      row("bound", &N::bound).within(0.01, 1000).means("radius of the sphere that holds it; the source's is √8"),
      row("edge", &N::edge).within(1e-6, 100).may_be_free(ParameterScale::logarithmic).means("over which the density falls from 1 to 0 outside of a node's surface (h of the source)"),
      row("step", &N::step).within(1e-4, 1).means("step of the march; the literal march has its own"),
      row("gas", &N::gas).means("name of the node of what shines by lines, and of the literal march's map; empty: none"),
      row("glow", &N::glow).means("name of the node of a second light; empty: none"),
      row("dust", &N::dust).means("name of the node of what absorbs; empty: none"),
      row("inner_rayleigh", &N::inner_rayleigh).of({"<line>"}).named_by(name_by_line).in("R").within(0, 1e9).may_be_free(ParameterScale::linear)
          .means("light of the gas at density 1 to a unit of path, per emission line, near the middle"),
      row("outer_rayleigh", &N::outer_rayleigh).of({"<line>"}).named_by(name_by_line).in("R").within(0, 1e9).may_be_free(ParameterScale::linear)
          .means("the same far out"),
      row("glow_rayleigh", &N::glow_rayleigh).of({"<line>"}).named_by(name_by_line).in("R").within(0, 1e9).may_be_free(ParameterScale::linear)
          .means("light of the glow at density 1 to a unit of path, per emission line"),
      row("inner_radius", &N::inner_radius).within(0, 1000).may_be_free(ParameterScale::linear).means("distance from the middle up to which inner_rayleigh holds"),
      row("outer_radius", &N::outer_radius).within(1e-6, 1000).may_be_free(ParameterScale::linear).means("distance from which on outer_rayleigh holds"),
      row("density_power", &N::density_power).within(0.1, 4).may_be_free(ParameterScale::linear).means("light goes as density to this power: 2 for recombination"),
      row("brightness", &N::brightness).within(0, 1e9).may_be_free(ParameterScale::logarithmic).means("times all its light"),
      row("dust_depth", &N::dust_depth).within(0, 1e6).may_be_free(ParameterScale::linear).means("optical depth at 550 nm of dust of density 1 to a unit of path"),
      row("dust_exponent", &N::dust_exponent).within(-4, 8).may_be_free(ParameterScale::linear).means("optical depth goes as wavelength to minus this power"),
      row("colour_a", &N::colour_a).of({"r", "g", "b"}).within(0, 100).means("of the literal march: light's colour at the middle"),
      row("colour_b", &N::colour_b).of({"r", "g", "b"}).within(0, 100).means("of the literal march: and at distance 1"),
  };
  // clang-format on
}

}  // namespace vegard::sim
