// [[loop]]: macro-loops of strands.
#include "sim/scene/table/parameter_rules.h"
#include "sim/scene/table/rows/line_component.h"
#include "sim/scene/table/rows/row.h"
#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value Loop::*value) {
  return Row("loop", key, &Scene::loops, value);
}

}  // namespace

std::vector<Declaration> loop_rows() {
  using L = Loop;
  // clang-format off
  return {
      row("name", &L::name).rule(element_name_complaint).means("by which paths call the loop"),
      row("latitude_deg", &L::latitude_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("heliographic, of the middle between its feet"),
      row("longitude_deg", &L::longitude_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("the same, growing to the west"),
      row("bearing_deg", &L::bearing_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("from the first foot to the second, from solar north to the west"),
      row("height", &L::height).within(0, 1e9).may_be_free(ParameterScale::logarithmic).means("of its top over the middle between the feet, in units of the Sun's frame, as all its lengths"),
      row("width", &L::width).within(1e-6, 1e9).may_be_free(ParameterScale::logarithmic).means("from foot to foot"),
      row("sharpness", &L::sharpness).within(-2, 1).may_be_free(ParameterScale::linear).means("0: rounded, the control points stand over the feet; 1: pointed, they meet over the middle; below 0: they lean outwards"),
      row("skew", &L::skew).within(-1e9, 1e9).may_be_free(ParameterScale::linear).means("by which the two control points are moved across the loop's plane, one to the right and one to the left"),
      row("tilt_deg", &L::tilt_deg).in("deg").within(-180, 180).may_be_free(ParameterScale::linear).means("of its plane from the vertical, to the right of the bearing"),
      row("tilt_per_distance_deg", &L::tilt_per_distance_deg).in("deg").within(-1e6, 1e6).may_be_free(ParameterScale::linear).means("by which a strand is tilted more to a unit of its distance from the loop's middle"),
      row("strands", &L::strands).within(1, 100000).means("how many it has"),
      row("spread", &L::spread).within(0, 1e9).may_be_free(ParameterScale::linear).means("strands stand up to so far from its middle plane, to either side"),
      row("strand_radius", &L::strand_radius).within(1e-9, 1e9).may_be_free(ParameterScale::logarithmic).means("of a strand, beyond which it has no density (the density falloff's)"),
      row("density_falloff", &L::density_falloff).one_of({"smooth", "linear", "gaussian"}).means("density across a strand, with q = distance / strand_radius: (1 - q²)², 1 - q, or exp(-4.5 q²), all 0 beyond q = 1"),
      row("height_falloff", &L::height_falloff).one_of({"none", "grow", "fade", "logarithmic", "inverse-square"}).means("density along a strand, by the height over its feet: growing or fading linearly, fading as the logarithm or as the inverse square"),
      row("falloff_least", &L::falloff_least).within(0, 1).may_be_free(ParameterScale::linear).means("density of the height falloff where it is least, of that where it is most"),
      row("base_density", &L::base_density).within(0, 1e9).may_be_free(ParameterScale::logarithmic).means("density in the middle of a strand where no falloff lessens it"),
      row("root_noise", &L::root_noise).within(0, 1e9).may_be_free(ParameterScale::linear).means("standard deviation of the places of the feet, along and across"),
      row("height_noise", &L::height_noise).within(0, 1).may_be_free(ParameterScale::linear).means("standard deviation of the height, a fraction of it"),
      row("tilt_noise_deg", &L::tilt_noise_deg).in("deg").within(0, 90).may_be_free(ParameterScale::linear).means("standard deviation of the tilt"),
      row("density_noise", &L::density_noise).within(0, 5).may_be_free(ParameterScale::linear).means("standard deviation of the logarithm of a strand's density"),
      row("filaments", &L::filaments).within(0, 10000).means("bunches that the strands are drawn to near the top; 0: none"),
      row("filament_pull", &L::filament_pull).within(0, 1).may_be_free(ParameterScale::linear).means("how near a strand's top comes to its bunch's: 1 - this is what is left of their distance"),
      row("brightening", &L::brightening).within(0, 1e6).may_be_free(ParameterScale::linear).means("added to the density along a strand at its height, a multiple of base_density"),
      row("brightening_at", &L::brightening_at).within(0, 1).may_be_free(ParameterScale::linear).means("where it is brightest: 0 at the feet, 1 at the top"),
      row("brightening_width", &L::brightening_width).within(1e-3, 10).may_be_free(ParameterScale::logarithmic).means("standard deviation of its Gaussian in height, of the strand's height"),
      row("rayleigh", &L::rayleigh).of({"<line>"}).named_by(name_by_line).in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light of density 1 to a unit of path, per emission line"),
      row("temperature_mk", &L::temperature_mk).in("MK").within(0, 100).may_be_free(ParameterScale::logarithmic).means("if not 0, lines with a response to temperature (docs/lines.md) shine by it"),
      row("voxel", &L::voxel).within(0, 1e9).means("if not 0, the loop is drawn by a grid with voxels of this edge; 0: strand by strand"),
      row("blur", &L::blur).within(0, 20).means("how often that grid is blurred"),
      row("sharpen", &L::sharpen).within(0, 20).means("how often it is sharpened, after that"),
  };
  // clang-format on
}

}  // namespace vegard::sim
