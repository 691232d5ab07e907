// Lines, their blur and how points fall on the film: [emission], [blur], [film].
#include <algorithm>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

template <class Value>
Row<OwnLine> row(const char* key, Value OwnLine::*value) {
  return Row("line", key, &Scene::own_lines, value);
}

bool is_not_drawn(const OwnLine& line, const Scene& scene) {
  return line_index(scene.emission.lines, line.wavelength_nm) < 0;
}

bool nothing_makes_it_shine(const OwnLine& line, const Scene& scene) {
  const bool may_be_dark = std::all_of(scene.sheets.begin(), scene.sheets.end(), [&](const Sheet& sheet) {
    const bool is_of_it =
        sheet.profile == ProfileKind::line && line_index({line.wavelength_nm}, sheet.line_nm) == 0;
    return !is_of_it && sheet.profile != ProfileKind::file && sheet.profile != ProfileKind::spline;
  });
  const bool shines_otherwise = scene.sun.shown || !scene.nebulae.empty() || !scene.volumes.empty() ||
                                !scene.loops.empty() || !scene.coronae.empty() || !scene.bundles.empty() ||
                                !scene.ejections.empty();
  return line.follows_nm <= 0.0 && line.rayleigh_per_mw_m2 <= 0.0 && may_be_dark && !shines_otherwise &&
         !(scene.sheets.empty() && scene.footprints.empty());
}

/// A row of the line's own layer.
Row<OwnLine> of_layer(Row<OwnLine> row) {
  return row.inert_if([](const OwnLine& line) { return line.rayleigh_per_mw_m2 <= 0.0; },
                      {"the line has no layer of its own, so {key} has no effect",
                       "a number that the light depends on", "set rayleigh_per_mw_m2"});
}

}  // namespace

std::vector<Declaration> own_line_rows() {
  using L = OwnLine;
  // clang-format off
  return {
      row("name", &L::name).means("by which paths call the line"),
      row("wavelength_nm", &L::wavelength_nm).in("nm").within(10, 30000)
          .means("its name in emission.lines, and its colour; replaces a line of the program")
          .inert_if(is_not_drawn, {"the line is not among emission.lines, so it is not drawn", "its wavelength there", ""})
          .inert_if(nothing_makes_it_shine, {"nothing makes the line shine", "follows_nm and ratio, rayleigh_per_mw_m2, a sheet of profile \"line\", or a column of it in a sheet's profile_file", ""}),
      row("spectrum_file", &L::spectrum_file).names_table()
          .means("a continuum: CSV of wavelength_nm and photons (per nm, relative); empty: one wavelength"),
      row("lifetime_s", &L::lifetime_s).in("s").within(0, 1e6)
          .means("of the upper state, without collisions; below 0.001 the light is prompt"),
      row("follows_nm", &L::follows_nm).in("nm").within(0, 30000)
          .means("line of the tables to which ratio applies, with its quenching; 0: none"),
      row("ratio", &L::ratio).within(0, 1000).means("photons for each photon of that line")
          .inert_if([](const L& line) { return line.follows_nm <= 0.0; }, {"the line follows no other, so its ratio has no effect", "a number that the light depends on", "set follows_nm"}),
      row("rayleigh_per_mw_m2", &L::rayleigh_per_mw_m2).in("R per mW m⁻²").within(0, 1e9)
          .means("a layer of its own, from straight below; 0: none"),
      of_layer(row("peak_km", &L::peak_km)).in("km").within(80, 640).means("where that layer is brightest"),
      of_layer(row("scale_height_km", &L::scale_height_km)).in("km").within(0, 500).rule(layer_complaint)
          .means("of that Chapman layer; 0: that of the air of [body]"),
  };
  // clang-format on
}

namespace {

template <class Value>
Row<March> row(const char* key, Value March::*value) {
  return Row("march", key, &Scene::march, value);
}

}  // namespace

std::vector<Declaration> march_rows() {
  // clang-format off
  return {
      row("step_km", &March::step_km).in("km").within(0.01, 100).means("along a ray through aurora by its footprint"),
      row("step_cells", &March::step_cells).within(0.1, 100).means("largest step across a footprint, in its cells"),
      row("skip", &March::skip).means("skip empty space"),
      row("ghosts", &March::ghosts).one_of<GhostRule>({{"span", GhostRule::span}, {"literal", GhostRule::literal}})
          .means("rays from the camera; or both ways (the source's rule), losing the near half of the Earth"),
      row("depth", &March::depth).names_file().means("depth picture of the camera's size"),
      row("depth_is", &March::depth_is).one_of<DepthMeaning>({{"distance", DepthMeaning::distance}, {"forward", DepthMeaning::forward}, {"log", DepthMeaning::log}})
          .means("depth along the ray, along the camera's axis, or its logarithm (as the source)"),
      row("depth_gain", &March::depth_gain).in("km").within(1e-9, 1e9).means("kilometres to a unit of that picture"),
      row("depth_far_km", &March::depth_far_km).in("km").within(1e-3, 1e12).means("distance of a logarithmic depth of 1"),
      row("blend", &March::blend).one_of<BlendRule>({{"alpha", BlendRule::alpha}, {"add", BlendRule::add}})
          .means("volumes absorb what is behind, or are only added"),
      row("shrink", &March::shrink).within(1, 16).means("one pixel of so many across and down is marched, others are interpolated"),
      row("smooth_px", &March::smooth_px).in("px").within(0, 100).means("standard deviation of a blur of the marched light, against grain"),
      row("glow", &March::glow).within(0, 1).means("share of the volumes' light that glows"),
      row("glow_deg", &March::glow_deg).in("deg").within(0.001, 45).means("standard deviation of the glow"),
  };
  // clang-format on
}

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
      Row("emission", "lines", &Scene::emission, &Emission::lines).stands_still("lines are what all light is made of, and stay the same ones").numbered().in("nm")
          .list_rule(lines_complaint).set_by(change_lines)
          .means("the program's (vegard lines) or those of [[line]]"),
      Row("emission", "tables", &Scene::emission, &Emission::tables).names_folder().rule(emission_tables_complaint)
          .means("\"vegard\", \"glow\" (not free), or a folder (docs/file_formats.md)"),
      Row("emission", "oxygen_factor", &Scene::emission, &Emission::oxygen_factor).as(ParameterRole::oxygen_factor)
          .within(kMinOxygenFactor, kMaxOxygenFactor).may_be_free(ParameterScale::logarithmic)
          .means("factor on the atomic oxygen of the tables")
          .inert_if(has_no_electrons, "nothing shines by the emission tables", "set a sheet's profile to a spectrum of electrons"),
      Row("emission", "modes", &Scene::emission, &Emission::modes).called("mode").as(ParameterRole::light_mode).numbered()
          .within(-5, 5).may_be_free(ParameterScale::linear)
          .means("of the tables' uncertainty, in standard deviations")
          .inert_if(has_no_electrons, "nothing shines by the emission tables", "set a sheet's profile to a spectrum of electrons"),
      Row("emission", "uncertainty", &Scene::emission, &Emission::uncertainty).one_of<TablesUncertainty>({{"modes", TablesUncertainty::modes}, {"none", TablesUncertainty::none}})
          .means("the tables are uncertain by their modes, or exact"),
      Row("emission", "flux_law", &Scene::emission, &Emission::flux_law).one_of<FluxLaw>({{"column", FluxLaw::column}, {"linear", FluxLaw::linear}})
          .means("light by energy flux: by the tables' columns, or proportional"),
      Row("emission", "lag", &Scene::emission, &Emission::lag).one_of<EmissionLag>({{"lifetime", EmissionLag::lifetime}, {"none", EmissionLag::none}})
          .means("delay of light: the atoms' lifetimes, or none"),

      Row("blur", "width_deg", &Scene::blur, &Blur::width_deg).as(ParameterRole::blur_width).by_line().in("deg")
          .within(0, 10).list_rule(blur_complaint).may_be_free(ParameterScale::logarithmic)
          .means("standard deviation of each of emission.lines (for \"angle\"); a component: blur.width_deg.6300")
          .inert_if(is_physical, "the blur is physical", "set blur.model to \"angle\"")
          .inert_if([](const Blur& blur) { return blur.widths == BlurWidths::paper; }, "the widths of the blur are the paper's", "set blur.widths to \"given\""),
      Row("blur", "kernel", &Scene::blur, &Blur::kernel).one_of<BlurKernelKind>({{"full", BlurKernelKind::full}, {"paper", BlurKernelKind::paper}})
          .means("a full Gaussian, or truncated (the paper)")
          .noted_if(is_physical, "the blur is physical, so kernel has no effect"),
      Row("blur", "model", &Scene::blur, &Blur::model).one_of<BlurModel>({{"angle", BlurModel::angle}, {"physical", BlurModel::physical}})
          .means("width_deg everywhere; or the diffusion of excited atoms in their lifetimes"),
      Row("blur", "order", &Scene::blur, &Blur::order).one_of<BlurOrder>({{"lines", BlurOrder::lines}, {"rgb", BlurOrder::rgb}})
          .means("blurred by angle: each line; or (the paper) red, green and blue of beams"),
      Row("blur", "widths", &Scene::blur, &Blur::widths).one_of<BlurWidths>({{"given", BlurWidths::given}, {"paper", BlurWidths::paper}})
          .means("width_deg; or the paper's pixels (docs/physics.md)"),
      Row("blur", "wind_m_s", &Scene::blur, &Blur::wind_m_s).of({"east", "north"}).in("m s⁻¹").within(-2000, 2000)
          .means("wind that carries excited atoms, for \"physical\"")
          .noted_if([](const Blur& blur) { return blur.model == BlurModel::angle; }, "the blur is by angle, so the wind has no effect"),

      Row("film", "splat", &Scene::film, &Film::splat).one_of<SplatRule>({{"bilinear", SplatRule::bilinear}, {"nearest", SplatRule::nearest}})
          .means("a point on pixels; the paper: nearest"),
      Row("film", "weight", &Scene::film, &Film::weight).one_of<PointWeight>({{"rayleigh", PointWeight::rayleigh}, {"unit", PointWeight::unit}})
          .means("of a point: rayleighs, or each the same (the paper)"),
  };
  // clang-format on
}

}  // namespace vegard::sim
