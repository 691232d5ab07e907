// Lines, their blur and how points fall on the film: [emission], [blur], [film].
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"

namespace vegard::sim {
namespace {

std::string index_name(const Scene&, int index) { return std::to_string(index); }

}  // namespace

std::vector<Declaration> light_rows() {
  // clang-format off
  return {
      Row("emission", "lines", &Scene::emission, &Emission::lines).of({"<n>"}).named_by(index_name).in("nm")
          .rule(line_complaint).list_rule(lines_complaint).set_by(change_lines)
          .means("wavelengths of the emission lines"),
      Row("emission", "tables", &Scene::emission, &Emission::tables).names_folder().rule(emission_tables_complaint)
          .means("the emission tables: \"vegard\" (our own), \"glow\" (of the GLOW model, whose licence is not free), or a folder relative to the scene's file (docs/file_formats.md)"),
      Row("emission", "oxygen_factor", &Scene::emission, &Emission::oxygen_factor).as(ParameterRole::oxygen_factor)
          .within(kMinOxygenFactor, kMaxOxygenFactor).may_be_free(ParameterScale::logarithmic)
          .means("atomic oxygen, as a multiple of what the tables' air has; other than 1 only for tables of several factors, and within those"),
      Row("emission", "flux_law", &Scene::emission, &Emission::flux_law).one_of<FluxLaw>({{"column", FluxLaw::column}, {"linear", FluxLaw::linear}})
          .means("how light grows with the energy flux of Maxwellian electrons: as the columns of the tables do (GLOW's "
                 "depart from proportion by up to 15 % between 0.1 and 10 mW m⁻²); or in proportion"),
      Row("emission", "lag", &Scene::emission, &Emission::lag).one_of<EmissionLag>({{"lifetime", EmissionLag::lifetime}, {"none", EmissionLag::none}})
          .means("light follows electrons that change after the excited atoms' effective lifetimes, up to 110 s of "
                 "630.0 nm and 0.7 s of 557.7 nm; or at once"),

      Row("blur", "width_deg", &Scene::blur, &Blur::width_deg).as(ParameterRole::blur_width).by_line().in("deg")
          .within(0, 10).list_rule(blur_complaint).may_be_free(ParameterScale::logarithmic)
          .means("standard deviation per emission line, in the order of emission.lines (of the model \"angle\"); a "
                 "component is called by its line's wavelength in ångström, such as blur.width_deg.6300"),
      Row("blur", "kernel", &Scene::blur, &Blur::kernel).one_of<BlurKernelKind>({{"full", BlurKernelKind::full}, {"paper", BlurKernelKind::paper}})
          .means("shape of the blur by angle: untruncated, or truncated as in the paper"),
      Row("blur", "model", &Scene::blur, &Blur::model).one_of<BlurModel>({{"angle", BlurModel::angle}, {"physical", BlurModel::physical}})
          .means("width_deg everywhere; or as far as the excited atoms come within their lifetimes, wider higher "
                 "up, none for prompt lines: width_deg and kernel are then not used"),
      Row("blur", "order", &Scene::blur, &Blur::order).one_of<BlurOrder>({{"lines", BlurOrder::lines}, {"rgb", BlurOrder::rgb}})
          .means("what is blurred by angle: each line's light before it is coloured; or, as in the paper, red, green and "
                 "blue after it, by the widths of 630.0, 557.7 and 427.8 nm (for rendering beams only)"),
      Row("blur", "widths", &Scene::blur, &Blur::widths).one_of<BlurWidths>({{"given", BlurWidths::given}, {"paper", BlurWidths::paper}})
          .means("whether width_deg is used; or exactly the paper's 4.75 pixels for lines that live longer than 10 s, 2.0 for "
                 "those that live longer than 0.1 s and none for others, of a picture 383 pixels high over 35°, in proportion"),
      Row("blur", "wind_m_s", &Scene::blur, &Blur::wind_m_s).of({"east", "north"}).in("m s⁻¹").within(-2000, 2000)
          .means("wind that carries the excited atoms, of the physical model"),

      Row("film", "splat", &Scene::film, &Film::splat).one_of<SplatRule>({{"bilinear", SplatRule::bilinear}, {"nearest", SplatRule::nearest}})
          .means("how a point falls on the pixels; the paper's is nearest"),
      Row("film", "weight", &Scene::film, &Film::weight).one_of<PointWeight>({{"rayleigh", PointWeight::rayleigh}, {"unit", PointWeight::unit}})
          .means("what a point adds: rayleighs, or as in the paper each the same"),
  };
  // clang-format on
}

}  // namespace vegard::sim
