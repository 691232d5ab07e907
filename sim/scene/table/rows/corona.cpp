// [[corona]] and [[bundle]]: the corona at large, and its straight lines.
#include "sim/scene/table/parameter_rules.h"
#include "sim/scene/table/rows/line_component.h"
#include "sim/scene/table/rows/row.h"
#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row corona(const char* key, Value Corona::*value) {
  return Row("corona", key, &Scene::coronae, value);
}

template <class Value>
Row bundle(const char* key, Value Bundle::*value) {
  return Row("bundle", key, &Scene::bundles, value);
}

std::string name_by_term(const Scene&, int, int index) { return std::to_string(index); }

}  // namespace

std::vector<Declaration> corona_rows() {
  using C = Corona;
  // clang-format off
  return {
      corona("name", &C::name).rule(element_name_complaint).means("by which paths call the corona"),
      corona("density", &C::density).within(0, 1e18).may_be_free(ParameterScale::logarithmic).means("at the photosphere, where the shares add up to 1: density (Σ share (r / R)^-power)"),
      corona("share", &C::share).of({"<n>"}).named_by(name_by_term).within(0, 1e6).may_be_free(ParameterScale::linear).means("of the falloff's terms"),
      corona("power", &C::power).of({"<n>"}).named_by(name_by_term).within(0, 100).may_be_free(ParameterScale::linear).means("of the falloff's terms"),
      corona("polar", &C::polar).within(0, 10).may_be_free(ParameterScale::linear).means("density over the poles, of that over the equator; between them by the square of the sine of the latitude"),
      corona("reach", &C::reach).within(1.001, 1000).means("where it ends, in radii of the photosphere"),
      corona("light", &C::light).one_of({"density", "square", "scattered"}).means("light as density; as its square, as of collisions; or as density times the photosphere's light scattered by free electrons (Thomson)"),
      corona("rayleigh", &C::rayleigh).of({"<line>"}).named_by(name_by_line).in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light of density 1 to a unit of path, per emission line; of scattered light at the photosphere's edge"),
      corona("temperature_mk", &C::temperature_mk).in("MK").within(0, 100).may_be_free(ParameterScale::logarithmic).means("if not 0, lines with a response to temperature (docs/lines.md) shine by it"),
  };
  // clang-format on
}

std::vector<Declaration> bundle_rows() {
  using B = Bundle;
  // clang-format off
  return {
      bundle("name", &B::name).rule(element_name_complaint).means("by which paths call the bundle"),
      bundle("count", &B::count).within(1, 100000).means("how many lines it has"),
      bundle("length", &B::length).within(1e-6, 1e9).may_be_free(ParameterScale::logarithmic).means("of a line, in units of the Sun's frame, as all its lengths"),
      bundle("gradient_deg", &B::gradient_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("of a line from the vertical, towards the equator: its gradient at the start"),
      bundle("slope_noise_deg", &B::slope_noise_deg).in("deg").within(0, 90).may_be_free(ParameterScale::linear).means("standard deviation of a line's slope, in either direction"),
      bundle("position_noise_deg", &B::position_noise_deg).in("deg").within(0, 90).may_be_free(ParameterScale::linear).means("standard deviation of a foot's place, off places that are spread evenly"),
      bundle("density_noise", &B::density_noise).within(0, 5).may_be_free(ParameterScale::linear).means("standard deviation of the logarithm of a line's density"),
      bundle("density", &B::density).within(0, 1e18).may_be_free(ParameterScale::logarithmic).means("in the middle of a line at its foot"),
      bundle("falloff_length", &B::falloff_length).within(1e-6, 1e9).may_be_free(ParameterScale::logarithmic).means("along a line, over which its density falls to 1 / e"),
      bundle("foot_radius", &B::foot_radius).within(1e-9, 1e9).may_be_free(ParameterScale::logarithmic).means("of a line at its foot, beyond which it has no density"),
      bundle("top_radius", &B::top_radius).within(1e-9, 1e9).may_be_free(ParameterScale::logarithmic).means("the same at its end"),
      bundle("density_falloff", &B::density_falloff).one_of({"smooth", "linear", "gaussian"}).means("density across a line, as of a loop's strand"),
      bundle("filaments", &B::filaments).within(0, 10000).means("places that feet are drawn together to; 0: none"),
      bundle("filament_pull", &B::filament_pull).within(0, 1).may_be_free(ParameterScale::linear).means("how near a foot comes to its place: 1 - this is what is left of their distance"),
      bundle("lowest_latitude_deg", &B::lowest_latitude_deg).in("deg").within(-90, 90).means("of feet"),
      bundle("highest_latitude_deg", &B::highest_latitude_deg).in("deg").within(-90, 90).means("of feet"),
      bundle("horizon_deg", &B::horizon_deg).in("deg").within(0.1, 90).means("feet are at most so far from the limb, as the observer sees it: streaks over the horizon; 90: anywhere"),
      bundle("rayleigh", &B::rayleigh).of({"<line>"}).named_by(name_by_line).in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light of density 1 to a unit of path, per emission line"),
      bundle("temperature_mk", &B::temperature_mk).in("MK").within(0, 100).may_be_free(ParameterScale::logarithmic).means("if not 0, lines with a response to temperature (docs/lines.md) shine by it"),
  };
  // clang-format on
}

}  // namespace vegard::sim
