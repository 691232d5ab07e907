// [[sheet]]: where electrons fall and with what light.
#include <algorithm>

#include "sim/scene/rows/forms.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {
namespace {

constexpr double pi = 3.14159265358979323846;
const char* const affects_light = "a parameter that the light depends on";

int spline_knots(const Scene& scene, int sheet) { return scene.sheets.at(sheet).spline_knots; }

bool is_footprint_of_sheets(const Footprint& f) { return f.source == FootprintSource::sheets; }

/// Whether a flow winds up a footprint that the sheets make: its map has no derivative by most of their
/// numbers.
bool is_wound_up(const Sheet&, const Scene& scene) {
  return std::any_of(scene.footprints.begin(), scene.footprints.end(),
                     [](const Footprint& f) { return is_footprint_of_sheets(f) && flows(f); });
}
const Complaint& words_of_flow() {
  static const Complaint words = {
      "the flow that winds the sheets' footprint up depends on {key}, and its derivative is not known",
      "a footprint that does not flow, or a number that its flow does not depend on",
      "set the footprint's flow_turns = 0, or leave it out of fit.free"};
  return words;
}

template <class Value>
Row<Sheet> row(const char* key, Value Sheet::*value) {
  return Row(key, value).not_free_if(is_wound_up, words_of_flow());
}

bool is_curve(const Sheet& sheet) { return sheet.course == SheetCourse::curve; }

/// A row whose number has an effect on a sine alone.
Row<Sheet> of_sine(Row<Sheet> row) {
  return row.inert_if(is_curve,
                      {"the sheet's course is a curve, so {key} has no effect", affects_light,
                       "leave it out of fit.free; the curve has east_km and north_km of its points"});
}

/// A row whose number is replaced by that of the points of a curve, if they have it.
Row<Sheet> but_of_points(Row<Sheet> row, std::vector<double> Sheet::*of_points) {
  return row.inert_if([=](const Sheet& sheet) { return is_curve(sheet) && !(sheet.*of_points).empty(); },
                      {"the sheet has point_{key}, so {key} has no effect", affects_light,
                       "leave it out of fit.free, or free numbers of point_{key}"});
}

/// Whether the energy flux of a sheet in a footprint follows from its brightness, by its energy.
bool is_footprint_of_brightness(const Sheet& sheet, const Scene& scene) {
  return sheet.brightness_kilorayleigh > 0.0 &&
         std::any_of(scene.footprints.begin(), scene.footprints.end(), is_footprint_of_sheets);
}

/// A row whose number has an effect with one height profile alone.
Row<Sheet> of_profile(ProfileKind profile, const char* else_do, Row<Sheet> row) {
  return row.inert_if([=](const Sheet& sheet) { return sheet.profile != profile; },
                      "the sheet's profile is {profile}", else_do);
}

/// A row of the heights of a form's curve.
Row<Sheet> of_heights(Row<Sheet> row) {
  return row.inert_if([](const Sheet& sheet) { return !has_heights_of_form(sheet.profile); },
                      "the sheet's profile is {profile}", "set the profile to \"form\" or \"line\"");
}

bool is_of_line(const Sheet& sheet) { return sheet.profile == ProfileKind::line; }
bool is_as_given(const Sheet& sheet) { return is_as_bright_as_given(sheet.profile); }

/// The row of the electrons' energy, which is not what every sheet's light depends on.
Row<Sheet> of_energy(Row<Sheet> row) {
  row.noted_if([](const Sheet& s) { return s.profile == ProfileKind::form; },
               "the heights of the light are those of a form's curve (peak_km, lower_km, upper_km), so "
               "energy_kev sets the ratios of the lines and their brightness alone; profile = \"maxwellian\" "
               "has heights by energy")
      .not_free_if(
          is_footprint_of_brightness,
          {"the sheet's brightness is given, and how the energy flux of its footprint depends on its energy "
           "then is not known",
           "a sheet of given energy_flux_mw_m2",
           "set energy_flux_mw_m2 in the place of brightness_kilorayleigh, or leave it out of fit.free"});
  return but_of_points(row, &Sheet::point_energy_kev)
      .inert_if([](const Sheet& s) { return s.profile == ProfileKind::file; },
                {"the sheet's profile comes from a file, so the energy of its electrons has no effect",
                 affects_light, "leave it out of fit.free, or set profile to a spectrum of electrons"})
      .inert_if([](const Sheet& s) { return s.profile == ProfileKind::layer; },
                {"the sheet's light is in layers of the scene's own lines, so the energy of its electrons "
                 "counts for nothing",
                 affects_light, "leave it out of fit.free, or set profile to a spectrum of electrons"})
      .inert_if(is_of_line, {"no electrons make the light of the profile \"line\", so {key} has no effect",
                             affects_light, "leave it out of fit.free; line_kilorayleigh is the light"})
      .inert_if([](const Sheet& s) { return s.profile == ProfileKind::spline; },
                {"the sheet's profile is free, so the electrons' energy has no effect", affects_light,
                 "leave it out of fit.free; sheet.{element}.spline_rate is the light"});
}

/// Who asks for a number of beams does not want a form's, which goes by the length.
void count_beams(Scene& scene, int sheet) { scene.sheets.at(sheet).beams_per_km = 0.0; }

}  // namespace

std::vector<Declaration> sheet_rows() {
  // clang-format off
  return {
      row("name", &Sheet::name).means("name in paths"),
      row("form", &Sheet::form).one_of(form_names()).presets(values_of_form)
          .means("preset of other keys, which override it (docs/forms.md)"),
      of_sine(row("center_km", &Sheet::center_km)).as(ParameterRole::centre).of({"east", "north"}).in("km").within(-3000, 3000).may_be_free(ParameterScale::linear)
          .means("middle of the feet, at 110 km altitude"),
      of_sine(row("bearing_deg", &Sheet::bearing_deg)).as(ParameterRole::bearing).in("deg").within(-720, 720).may_be_free(ParameterScale::angle)
          .means("direction from start to end"),
      of_sine(row("length_km", &Sheet::length_km)).as(ParameterRole::length).in("km").within(0.1, 5000).may_be_free(ParameterScale::logarithmic)
          .means("distance from start to end"),
      of_sine(row("thickness_km", &Sheet::thickness_km)).called("amplitude").as(ParameterRole::amplitude).in("km").within(0.01, 100).may_be_free(ParameterScale::logarithmic)
          .means("amplitude of the sine (1–10 in nature)"),
      of_sine(row("wavelength_km", &Sheet::wavelength_km)).as(ParameterRole::wavelength).in("km").within(1, 5000).may_be_free(ParameterScale::logarithmic)
          .means("wavelength of the sine"),
      of_sine(row("phase_rad", &Sheet::phase_rad)).as(ParameterRole::phase).in("rad").within(-8 * pi, 8 * pi).may_be_free(ParameterScale::angle)
          .means("phase of the first layer's sine at the start"),
      of_sine(row("phase_shift_rad", &Sheet::phase_shift_rad)).in("rad").within(-2 * pi, 2 * pi).may_be_free(ParameterScale::linear)
          .means("phase from the first layer to the last"),
      row("course", &Sheet::course).one_of<SheetCourse>({{"sine", SheetCourse::sine}, {"curve", SheetCourse::curve}})
          .means("a sine about the line from start to end, or a smooth curve through east_km, north_km"),
      row("east_km", &Sheet::east_km).called("east of point").as(ParameterRole::curve_east).numbered().in("km").within(-3000, 3000).may_be_free(ParameterScale::linear)
          .means("points of the curve in order, at 110 km altitude"),
      row("north_km", &Sheet::north_km).called("north of point").as(ParameterRole::curve_north).numbered().in("km").within(-3000, 3000).may_be_free(ParameterScale::linear)
          .means("the same to the north"),
      row("point_brightness", &Sheet::point_brightness).called("brightness of point").as(ParameterRole::curve_brightness).numbered().within(1e-6, 1e4).may_be_free(ParameterScale::logarithmic)
          .means("relative energy flux (or brightness) at the curve's points; empty: 1"),
      row("point_energy_kev", &Sheet::point_energy_kev).called("energy of point").numbered().in("keV").within(0.1, 20).may_be_free(ParameterScale::logarithmic)
          .means("energy at the curve's points; empty: energy_kev"),
      row("point_width_km", &Sheet::point_width_km).called("layer width of point").numbered().in("km").within(0.01, 100).may_be_free(ParameterScale::logarithmic)
          .means("width at the curve's points; empty: width_km"),
      row("layers", &Sheet::layers).within(1, 100).means("parallel sine curves; of a \"curve\" they coincide"),
      but_of_points(row("width_km", &Sheet::width_km), &Sheet::point_width_km).called("layer width").in("km").within(0.01, 100).may_be_free(ParameterScale::logarithmic)
          .means("standard deviation of a layer's Gaussian cross-section"),
      row("beams", &Sheet::beams).within(1, 10000000).then(count_beams)
          .means("in each layer; sets beams_per_km to 0"),
      of_energy(Row("energy_kev", &Sheet::energy_kev)).as(ParameterRole::energy).in("keV").within(0.1, 20).may_be_free(ParameterScale::logarithmic)
          .means("characteristic energy E0 of a Maxwellian (mean energy 2 E0); else the central energy"),
      of_profile(ProfileKind::gaussian, "set profile to \"gaussian\"", row("energy_spread", &Sheet::energy_spread)).as(ParameterRole::energy_spread).within(0.01, 1).may_be_free(ParameterScale::logarithmic)
          .means("relative standard deviation of a Gaussian energy"),
      Row("energy_flux_mw_m2", &Sheet::energy_flux_mw_m2).as(ParameterRole::energy_flux).in("mW m⁻²").within(0, 10000).may_be_free(ParameterScale::logarithmic)
          .means("energy flux Q, at its peak across a layer")
          .not_free_if([](const Sheet& s, const Scene& scene) { return is_wound_up(s, scene) && scene.sheets.size() != 1; }, words_of_flow())
          .inert_if([](const Sheet& s) { return s.brightness_kilorayleigh > 0.0; }, {"the sheet's brightness is given, so its energy flux has no effect", affects_light, "leave it out of fit.free, or brightness_kilorayleigh (and ibc) out of the sheet"})
          .inert_if(is_as_given, {"the sheet is as bright as line_kilorayleigh says, so {key} has no effect", affects_light, "leave it out of fit.free; line_kilorayleigh is the light"}),
      row("path_spread", &Sheet::path_spread).within(0, 1)
          .means("largest random shortening of a path, as a fraction"),
      row("loss_cone_deg", &Sheet::loss_cone_deg).called("pitch angle").as(ParameterRole::loss_cone).in("deg").within(0, 30).may_be_free(ParameterScale::linear)
          .means("pitch angle at the lower end of the path"),
      row("pitch_step_rad", &Sheet::pitch_step_rad).as(ParameterRole::pitch_step).in("rad").within(0, 0.5).may_be_free(ParameterScale::linear)
          .means("decrease of the pitch angle to the upper end"),
      row("pitch_law", &Sheet::pitch_law).one_of<PitchLaw>({{"reduced", PitchLaw::reduced}, {"product", PitchLaw::product}, {"increment", PitchLaw::increment}, {"constant", PitchLaw::constant}})
          .means("the paper's equation (4): αD−Δα(1−t), αD·t·Δα (literal), t·Δα or αD"),
      row("path_step", &Sheet::path_step).within(1e-5, 0.5)
          .means("largest step, as a fraction of the path"),
      row("top_km", &Sheet::top_km).in("km").within(150, 640).means("where beams start"),
      row("spacing_jitter", &Sheet::spacing_jitter).within(0, 0.999)
          .means("random shift of the beams, as a fraction of the spacing"),
      row("spacing_rule", &Sheet::spacing_rule).one_of<SpacingRule>({{"stratified", SpacingRule::stratified}, {"tied", SpacingRule::tied}, {"literal", SpacingRule::literal}})
          .means("beam positions: stratified, a jittered walk, or the paper's walk"),
      row("beams_per_km", &Sheet::beams_per_km).in("km⁻¹").within(0, 100000)
          .means("in each layer; 0: use beams"),
      row("step_rule", &Sheet::step_rule).one_of<PathStepRule>({{"given", PathStepRule::given}, {"energy", PathStepRule::energy}})
          .means("path_step as given, or from the electrons' mean energy"),
      row("path_rule", &Sheet::path_rule).one_of<PathRule>({{"even", PathRule::even}, {"random", PathRule::random}})
          .means("half of path_step from a random start, or random up to path_step (the paper's)"),
      row("points_per_px", &Sheet::points_per_px).in("px⁻¹").within(0, 1000)
          .means("least deflection points per pixel and layer, by up to 16 times the beams; 0: off"),
      row("arcs", &Sheet::arcs).within(1, 64).means("equal sheets side by side, centred on center_km"),
      of_sine(row("arc_spacing_km", &Sheet::arc_spacing_km)).called("spacing of the arcs").in("km").within(0.1, 1000).may_be_free(ParameterScale::logarithmic)
          .means("between them (10–100 in nature)")
          .inert_if([](const Sheet& s) { return s.arcs == 1; }, {"the sheet is a single arc, so the spacing of arcs has no effect", affects_light, "leave it out of fit.free, or set arcs"}),
      row("brightness_kilorayleigh", &Sheet::brightness_kilorayleigh).in("kR").within(0, 1e6)
          .means("peak brightness of 557.7 nm along the field; 0: use the energy flux"),
      row("profile", &Sheet::profile).one_of<ProfileKind>({{"maxwellian", ProfileKind::maxwellian}, {"mono", ProfileKind::mono}, {"gaussian", ProfileKind::gaussian}, {"form", ProfileKind::form}, {"file", ProfileKind::file}, {"spline", ProfileKind::spline}, {"layer", ProfileKind::layer}, {"line", ProfileKind::line}, {"proton", ProfileKind::proton}})
          .means("height profile: of electrons of Maxwellian, single or Gaussian energy; the form's measured curve; profile_file; free for each line; layers of [[line]]; line_nm alone, as high as a form; or of Maxwellian protons"),
      row("profile_file", &Sheet::profile_file).names_table()
          .means("for \"file\": CSV of altitude_km and photons cm⁻³ s⁻¹ per line"),
      of_heights(row("peak_km", &Sheet::peak_km)).called("peak altitude").as(ParameterRole::form_peak).in("km").within(85, 400).may_be_free(ParameterScale::linear)
          .means("for \"form\" and \"line\": altitude of the peak"),
      of_heights(row("lower_km", &Sheet::lower_km)).called("extent below the peak").as(ParameterRole::form_lower).in("km").within(0.5, 100).may_be_free(ParameterScale::logarithmic)
          .means("from the peak down to a tenth of the light"),
      of_heights(row("upper_km", &Sheet::upper_km)).called("extent above the peak").as(ParameterRole::form_upper).in("km").within(1, 500).may_be_free(ParameterScale::logarithmic)
          .means("from the peak up to a tenth of the light"),
      row("line_nm", &Sheet::line_nm).inert_if([](const Sheet& s) { return !is_as_given(s); }, "the sheet's profile is {profile}", "set the profile to \"line\" or \"proton\"").in("nm").within(10, 30000)
          .means("for \"line\": the one of emission.lines that shines; for \"proton\": that line_kilorayleigh is of"),
      row("line_kilorayleigh", &Sheet::line_kilorayleigh).inert_if([](const Sheet& s) { return !is_as_given(s); }, "the sheet's profile is {profile}", "set the profile to \"line\" or \"proton\"").called("brightness").as(ParameterRole::line_brightness).in("kR").within(0, 1e6).may_be_free(ParameterScale::logarithmic)
          .means("its brightness along the field, at its peak across a layer"),
      row("spline_bottom_km", &Sheet::spline_bottom_km).in("km").within(80, 630)
          .means("where a free-form profile begins, dark"),
      row("spline_top_km", &Sheet::spline_top_km).in("km").within(90, 640)
          .means("where it ends, dark"),
      row("spline_knots", &Sheet::spline_knots).within(4, 64)
          .means("knots per line, denser at low altitude"),
      of_profile(ProfileKind::spline, "set the profile to \"spline\"", row("spline_rate", &Sheet::spline_rate)).as(ParameterRole::profile_coefficient).by_line("<line>_<n>", spline_rate_component, spline_knots)
          .in("cm⁻³ s⁻¹ per mW m⁻²").within(1e-12, 1e6).may_be_free(ParameterScale::logarithmic)
          .means("coefficients by line from the bottom up (sheet.main.spline_rate.5577_3); empty: one broad layer"),
      row("fold_spacing_km", &Sheet::fold_spacing_km).in("km").within(0, 5000).rule(none_or_some_complaint)
          .means("mean (about 20 in nature); 0: none"),
      row("fold_spacing_jitter", &Sheet::fold_spacing_jitter).within(0, 1)
          .means("random shift, as a fraction of the spacing"),
      row("fold_length_km", &Sheet::fold_length_km).in("km").within(0.01, 1000)
          .means("of the sine that a fold replaces, at most the spacing"),
      of_sine(row("fold_stage", &Sheet::fold_stage)).within(0, 1).may_be_free(ParameterScale::linear)
          .means("0 a ripple, 0.5 an overhang, 1 a horseshoe")
          .inert_if([](const Sheet& s) { return s.fold_spacing_km == 0.0; }, {"the sheet has no folds, so their stage has no effect", affects_light, "leave it out of fit.free, or set fold_spacing_km"}),
      row("fold_stage_spread", &Sheet::fold_stage_spread).within(0, 1)
          .means("largest random reduction of the stage, as a fraction"),
      row("fold_speed_km_s", &Sheet::fold_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("speed from start to end (0–5 in nature)"),
      row("fold_lifetime_s", &Sheet::fold_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("above 1 in nature; 0: unlimited"),
      row("curl_spacing_km", &Sheet::curl_spacing_km).in("km").within(0, 5000).rule(none_or_some_complaint)
          .means("mean (2–10 in nature); 0: none"),
      row("curl_radius_km", &Sheet::curl_radius_km).in("km").within(0.01, 100).means("at most the spacing"),
      row("curl_turn_rad", &Sheet::curl_turn_rad).in("rad").within(-100, 100)
          .means("winding at the centre, counter-clockwise against the field"),
      row("curl_gather", &Sheet::curl_gather).within(0, 0.95)
          .means("concentration of beams at the centre"),
      row("curl_speed_km_s", &Sheet::curl_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("speed from start to end (0–8 in nature, at most 90)"),
      row("curl_lifetime_s", &Sheet::curl_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("0.25–0.75 in nature; 0: unlimited"),
      row("spiral_spacing_km", &Sheet::spiral_spacing_km).in("km").within(0, 5000).rule(none_or_some_complaint)
          .means("mean (125–175 in nature); 0: none"),
      row("spiral_radius_km", &Sheet::spiral_radius_km).in("km").within(1, 1000)
          .means("at most the spacing; diameter 25–75 in nature"),
      row("spiral_turn_rad", &Sheet::spiral_turn_rad).in("rad").within(-100, 100)
          .means("winding at the centre, counter-clockwise along the field"),
      row("spiral_speed_km_s", &Sheet::spiral_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("speed from start to end (4 on average in nature)"),
      row("spiral_lifetime_s", &Sheet::spiral_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("from winding up to unwinding; 0: unlimited"),
      row("ray_contrast", &Sheet::ray_contrast).within(0, 3)
          .means("standard deviation of ln(light); 0: none"),
      row("ray_width_km", &Sheet::ray_width_km).in("km").within(0.01, 100)
          .means("full width at half maximum of the autocorrelation (1 or less in nature)"),
      row("ray_length_contrast", &Sheet::ray_length_contrast).within(0, 2)
          .means("standard deviation of ln(height) above the peak"),
      row("ray_speed_km_s", &Sheet::ray_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("speed from start to end"),
      row("ray_lifetime_s", &Sheet::ray_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint).means("0: unlimited"),
      row("patch_size_km", &Sheet::patch_size_km).in("km").within(0, 1000).rule(none_or_some_complaint)
          .means("full width at half maximum of the autocorrelation; 0: none"),
      row("patch_contrast", &Sheet::patch_contrast).within(0, 3)
          .means("standard deviation of ln(light)"),
      row("patch_lifetime_s", &Sheet::patch_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint).means("0: unlimited"),
      row("border_amplitude_km", &Sheet::border_amplitude_km).in("km").within(0, 100)
          .means("undulation of the lower border; 0: even"),
      row("border_scale_km", &Sheet::border_scale_km).in("km").within(0.1, 1000)
          .means("its longest waves"),
      row("border_octaves", &Sheet::border_octaves).within(1, 8)
          .means("octaves, each half as long and high"),
      row("border_lifetime_s", &Sheet::border_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("0: unlimited"),
      row("border_rule", &Sheet::border_rule).one_of<BorderRule>({{"light", BorderRule::light}, {"start", BorderRule::start}})
          .means("what undulates: the light's altitude; or, literally, a beam's start, which cuts light off"),
      row("drift_km_s", &Sheet::drift_km_s).as(ParameterRole::drift).of({"east", "north"}).in("km s⁻¹").within(-100, 100)
          .means("velocity (in nature 0.1–0.2 north–south, 10 east–west)"),
      row("sine_speed_km_s", &Sheet::sine_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("speed of the wave from start to end"),
  };
  // clang-format on
}

}  // namespace vegard::sim
