// Lines, their blur and how points fall on the film: [emission], [blur], [film].
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/table/parameter_rules.h"
#include "sim/scene/table/rows/row.h"
#include "sim/scene/table/rows/rows.h"

namespace vegard::sim {
namespace {

std::string index_name(const Scene&, int index) { return std::to_string(index); }

std::string name_by_emission_line(const Scene& scene, int index) {
  const auto& lines = scene.emission.lines;
  return index < static_cast<int>(lines.size()) ? line_name(lines[index]) : std::to_string(index);
}

}  // namespace

std::vector<Declaration> light_rows() {
  // clang-format off
  return {
      Row("emission", "lines", &Scene::emission, &Emission::lines).of({"<n>"}).named_by(index_name).in("nm")
          .rule(line_complaint).list_rule(lines_complaint).set_by(change_lines)
          .means("wavelengths of the emission lines"),
      Row("emission", "flux_law", &Scene::emission, &Emission::flux_law).one_of({"column", "linear"})
          .means("how light grows with the energy flux of Maxwellian electrons: as the columns of GLOW do, which "
                 "depart from proportion by up to 15 % between 0.1 and 10 mW m⁻²; or in proportion"),

      Row("blur", "width_deg", &Scene::blur, &Blur::width_deg).of({"<line>"}).named_by(name_by_emission_line).in("deg")
          .within(0, 10).list_rule(blur_complaint).may_be_free(ParameterScale::logarithmic)
          .means("standard deviation per emission line, in the order of emission.lines (of the model \"angle\"); a "
                 "component is called by its line's wavelength in ångström, such as blur.width_deg.6300"),
      Row("blur", "kernel", &Scene::blur, &Blur::kernel).one_of({"full", "paper"})
          .means("shape of the blur by angle: untruncated, or truncated as in the paper"),
      Row("blur", "model", &Scene::blur, &Blur::model).one_of({"angle", "physical"})
          .means("width_deg everywhere; or as far as the excited atoms come within their lifetimes, wider higher "
                 "up, none for prompt lines: width_deg and kernel are then not used, and a fit refuses it"),
      Row("blur", "wind_m_s", &Scene::blur, &Blur::wind_m_s).of({"east", "north"}).in("m s⁻¹").within(-2000, 2000)
          .means("wind that carries the excited atoms, of the physical model"),

      Row("film", "splat", &Scene::film, &Film::splat).one_of({"bilinear", "nearest"})
          .means("how a point falls on the pixels; the paper's is nearest"),
      Row("film", "weight", &Scene::film, &Film::weight).one_of({"rayleigh", "unit"})
          .means("what a point adds: rayleighs, or as in the paper each the same"),
  };
  // clang-format on
}

}  // namespace vegard::sim
