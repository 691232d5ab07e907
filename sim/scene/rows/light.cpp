// Lines, their blur and how points fall on the film: [emission], [blur], [film].
#include <algorithm>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"

namespace vegard::sim {
namespace {

/// Whether no light comes from the emission tables.
bool has_no_electrons(const Emission&, const Scene& scene) {
  const auto is_lit_by_tables = [](const auto& each) { return is_of_electrons(each.profile); };
  return std::none_of(scene.footprints.begin(), scene.footprints.end(), is_lit_by_tables) &&
         std::none_of(scene.sheets.begin(), scene.sheets.end(), is_lit_by_tables);
}

bool is_physical(const Blur& blur) { return blur.model == BlurModel::physical; }

}  // namespace

std::vector<Declaration> light_rows() {
  // clang-format off
  return {
      Row("emission", "lines", &Scene::emission, &Emission::lines).numbered().in("nm")
          .list_rule(lines_complaint).set_by(change_lines)
          .means("emission lines, the program's (vegard lines) or those of [[line]]"),
      Row("emission", "tables", &Scene::emission, &Emission::tables).names_folder().rule(emission_tables_complaint)
          .means("emission tables: \"vegard\", \"glow\" (not free), or a folder (docs/file_formats.md)"),
      Row("emission", "oxygen_factor", &Scene::emission, &Emission::oxygen_factor).as(ParameterRole::oxygen_factor)
          .within(kMinOxygenFactor, kMaxOxygenFactor).may_be_free(ParameterScale::logarithmic)
          .means("factor on the atomic oxygen of the tables")
          .inert_if(has_no_electrons, "nothing shines by the emission tables", "set a sheet's profile to a spectrum of electrons"),
      Row("emission", "flux_law", &Scene::emission, &Emission::flux_law).one_of<FluxLaw>({{"column", FluxLaw::column}, {"linear", FluxLaw::linear}})
          .means("light against the energy flux: by the tables' columns, or proportional"),
      Row("emission", "lag", &Scene::emission, &Emission::lag).one_of<EmissionLag>({{"lifetime", EmissionLag::lifetime}, {"none", EmissionLag::none}})
          .means("delay of light: the atoms' effective lifetimes, or none"),

      Row("blur", "width_deg", &Scene::blur, &Blur::width_deg).as(ParameterRole::blur_width).by_line().in("deg")
          .within(0, 10).list_rule(blur_complaint).may_be_free(ParameterScale::logarithmic)
          .means("standard deviation per line of emission.lines (for \"angle\"); a component by its wavelength in ångström: blur.width_deg.6300")
          .inert_if(is_physical, "the blur is physical", "set blur.model to \"angle\"")
          .inert_if([](const Blur& blur) { return blur.widths == BlurWidths::paper; }, "the widths of the blur are the paper's", "set blur.widths to \"given\""),
      Row("blur", "kernel", &Scene::blur, &Blur::kernel).one_of<BlurKernelKind>({{"full", BlurKernelKind::full}, {"paper", BlurKernelKind::paper}})
          .means("blur by angle: a full Gaussian, or truncated as in the paper")
          .noted_if(is_physical, "the blur is physical, so kernel has no effect"),
      Row("blur", "model", &Scene::blur, &Blur::model).one_of<BlurModel>({{"angle", BlurModel::angle}, {"physical", BlurModel::physical}})
          .means("width_deg everywhere; or the diffusion of excited atoms in their lifetimes"),
      Row("blur", "order", &Scene::blur, &Blur::order).one_of<BlurOrder>({{"lines", BlurOrder::lines}, {"rgb", BlurOrder::rgb}})
          .means("what is blurred by angle: each line; or, as in the paper, red, green and blue of beams"),
      Row("blur", "widths", &Scene::blur, &Blur::widths).one_of<BlurWidths>({{"given", BlurWidths::given}, {"paper", BlurWidths::paper}})
          .means("width_deg; or the paper's pixels (docs/physics.md)"),
      Row("blur", "wind_m_s", &Scene::blur, &Blur::wind_m_s).of({"east", "north"}).in("m s⁻¹").within(-2000, 2000)
          .means("wind that carries the excited atoms, of the physical model")
          .noted_if([](const Blur& blur) { return blur.model == BlurModel::angle; }, "the blur is by angle, so the wind has no effect"),

      Row("film", "splat", &Scene::film, &Film::splat).one_of<SplatRule>({{"bilinear", SplatRule::bilinear}, {"nearest", SplatRule::nearest}})
          .means("distribution of a point on pixels; the paper: nearest"),
      Row("film", "weight", &Scene::film, &Film::weight).one_of<PointWeight>({{"rayleigh", PointWeight::rayleigh}, {"unit", PointWeight::unit}})
          .means("weight of a point: rayleighs, or as in the paper each the same"),
  };
  // clang-format on
}

}  // namespace vegard::sim
