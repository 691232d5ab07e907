// [sun]: where the Sun stands, and its photosphere.
#include "sim/scene/table/rows/line_component.h"
#include "sim/scene/table/rows/row.h"
#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value Sun::*value) {
  return Row("sun", key, &Scene::sun, value);
}

std::string line_of_component(const Scene& scene, int index) { return name_by_line(scene, 0, index); }

}  // namespace

std::vector<Declaration> sun_rows() {
  // clang-format off
  return {
      row("shown", &Sun::shown).means("the Sun, and what stands on it, is in the scene"),
      row("azimuth_deg", &Sun::azimuth_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("direction of its middle, from north to the east"),
      row("elevation_deg", &Sun::elevation_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("direction of its middle above the horizon"),
      row("distance_km", &Sun::distance_km).in("km").within(1, 1e12).may_be_free(ParameterScale::logarithmic).means("distance of its middle"),
      row("position_angle_deg", &Sun::position_angle_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("how far its north pole is turned anticlockwise, as the observer sees it (P)"),
      row("latitude_deg", &Sun::latitude_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("heliographic latitude of the middle of its disc (B0)"),
      row("longitude_deg", &Sun::longitude_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("heliographic longitude of the middle of its disc (L0), growing to the west"),
      row("unit_km", &Sun::unit_km).in("km").within(1e-3, 1e9).means("its unit of length, which all lengths on it are in: a megametre"),
      row("radius", &Sun::radius).within(1e-3, 1e9).means("radius of the photosphere"),
      row("photosphere_rayleigh", &Sun::photosphere_rayleigh).of({"<line>"}).named_by(line_of_component).in("R").within(0, 1e18).may_be_free(ParameterScale::linear)
          .means("light of the photosphere at the middle of the disc, per emission line; empty: it is dark"),
      row("limb_darkening", &Sun::limb_darkening).within(0, 1).may_be_free(ParameterScale::linear).means("u of the law 1 - u (1 - μ) - v (1 - μ)², μ the cosine of the angle between ray and vertical; 0: a uniform disc"),
      row("limb_darkening_square", &Sun::limb_darkening_square).within(-1, 1).may_be_free(ParameterScale::linear).means("v of that law"),
  };
  // clang-format on
}

}  // namespace vegard::sim
