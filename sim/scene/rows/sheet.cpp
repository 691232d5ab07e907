// [[sheet]]: where electrons fall and with what light.
#include "sim/scene/rows/forms.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"
#include "sim/scene/rows/spline_rates.h"

namespace vegard::sim {
namespace {

constexpr double pi = 3.14159265358979323846;

int spline_knots(const Scene& scene, int sheet) { return scene.sheets.at(sheet).spline_knots; }

std::string name_of_point(const Scene&, int, int index) { return std::to_string(index); }

/// Who asks for a number of beams does not want a form's, which goes by the length.
void count_beams(Scene& scene, int sheet) { scene.sheets.at(sheet).beams_per_km = 0.0; }

}  // namespace

std::vector<Declaration> sheet_rows() {
  // clang-format off
  return {
      Row("name", &Sheet::name).means("name in paths"),
      Row("form", &Sheet::form).one_of(form_names()).presets(values_of_form)
          .means("preset of the sheet's other keys, which override it (docs/forms.md)"),
      Row("center_km", &Sheet::center_km).as(ParameterRole::centre).of({"east", "north"}).in("km").within(-3000, 3000).may_be_free(ParameterScale::linear)
          .means("middle between start and end, of the feet at 110 km altitude"),
      Row("bearing_deg", &Sheet::bearing_deg).as(ParameterRole::bearing).in("deg").within(-720, 720).may_be_free(ParameterScale::angle)
          .means("direction from start to end, from north to the east"),
      Row("length_km", &Sheet::length_km).as(ParameterRole::length).in("km").within(0.1, 5000).may_be_free(ParameterScale::logarithmic)
          .means("distance from start to end"),
      Row("thickness_km", &Sheet::thickness_km).called("amplitude").as(ParameterRole::amplitude).in("km").within(0.01, 100).may_be_free(ParameterScale::logarithmic)
          .means("amplitude of the sine (1 to 10 in nature)"),
      Row("wavelength_km", &Sheet::wavelength_km).as(ParameterRole::wavelength).in("km").within(1, 5000).may_be_free(ParameterScale::logarithmic)
          .means("wavelength of the sine"),
      Row("phase_rad", &Sheet::phase_rad).as(ParameterRole::phase).in("rad").within(-8 * pi, 8 * pi).may_be_free(ParameterScale::angle)
          .means("phase of the first layer's sine at the start"),
      Row("phase_shift_rad", &Sheet::phase_shift_rad).in("rad").within(-2 * pi, 2 * pi).may_be_free(ParameterScale::linear)
          .means("phase from the first layer to the last"),
      Row("course", &Sheet::course).one_of<SheetCourse>({{"sine", SheetCourse::sine}, {"curve", SheetCourse::curve}})
          .means("course of the layers: a sine about the line from start to end, or a smooth curve through east_km, north_km"),
      Row("east_km", &Sheet::east_km).called("east of point").as(ParameterRole::curve_east).of({"<n>"}).named_by(name_of_point).in("km").within(-3000, 3000).may_be_free(ParameterScale::linear)
          .means("points of the course \"curve\" in order, at 110 km altitude"),
      Row("north_km", &Sheet::north_km).called("north of point").as(ParameterRole::curve_north).of({"<n>"}).named_by(name_of_point).in("km").within(-3000, 3000).may_be_free(ParameterScale::linear)
          .means("the same to the north"),
      Row("point_brightness", &Sheet::point_brightness).called("brightness of point").of({"<n>"}).named_by(name_of_point).within(1e-6, 1e4).may_be_free(ParameterScale::logarithmic)
          .means("relative energy flux (or brightness) at the curve's points; empty: 1"),
      Row("point_energy_kev", &Sheet::point_energy_kev).called("energy of point").of({"<n>"}).named_by(name_of_point).in("keV").within(0.1, 20).may_be_free(ParameterScale::logarithmic)
          .means("energy at the curve's points; empty: energy_kev"),
      Row("point_width_km", &Sheet::point_width_km).called("layer width of point").of({"<n>"}).named_by(name_of_point).in("km").within(0.01, 100).may_be_free(ParameterScale::logarithmic)
          .means("width at the curve's points; empty: width_km"),
      Row("layers", &Sheet::layers).within(1, 100).means("number of sine curves in the sheet; with the course \"curve\" they coincide"),
      Row("width_km", &Sheet::width_km).called("layer width").in("km").within(0.01, 100).may_be_free(ParameterScale::logarithmic)
          .means("standard deviation of a layer's Gaussian cross-section"),
      Row("beams", &Sheet::beams).within(1, 10000000).then(count_beams)
          .means("electron beams in each layer; sets beams_per_km to 0"),
      Row("energy_kev", &Sheet::energy_kev).as(ParameterRole::energy).in("keV").within(0.1, 20).may_be_free(ParameterScale::logarithmic)
          .means("characteristic energy E0 of Maxwellian electrons (mean energy 2 E0); else the central energy"),
      Row("energy_spread", &Sheet::energy_spread).as(ParameterRole::energy_spread).within(0.01, 1).may_be_free(ParameterScale::logarithmic)
          .means("relative standard deviation of a Gaussian energy"),
      Row("energy_flux_mw_m2", &Sheet::energy_flux_mw_m2).as(ParameterRole::energy_flux).in("mW m⁻²").within(0, 10000).may_be_free(ParameterScale::logarithmic)
          .means("energy flux Q, at its peak across a layer"),
      Row("path_spread", &Sheet::path_spread).within(0, 1)
          .means("largest random shortening of a beam, as a fraction of its path"),
      Row("loss_cone_deg", &Sheet::loss_cone_deg).called("pitch angle").as(ParameterRole::loss_cone).in("deg").within(0, 30).may_be_free(ParameterScale::linear)
          .means("pitch angle at the lower end of the path"),
      Row("pitch_step_rad", &Sheet::pitch_step_rad).as(ParameterRole::pitch_step).in("rad").within(0, 0.5).may_be_free(ParameterScale::linear)
          .means("decrease of the pitch angle to the upper end"),
      Row("pitch_law", &Sheet::pitch_law).one_of<PitchLaw>({{"reduced", PitchLaw::reduced}, {"product", PitchLaw::product}, {"increment", PitchLaw::increment}, {"constant", PitchLaw::constant}})
          .means("pitch angle by the paper's equation (4): αD − Δα(1 − t), αD·t·Δα (literal), t·Δα or αD"),
      Row("path_step", &Sheet::path_step).within(1e-5, 0.5)
          .means("largest step between deflections, as a fraction of the path"),
      Row("top_km", &Sheet::top_km).in("km").within(150, 640).means("altitude at which a beam starts"),
      Row("spacing_jitter", &Sheet::spacing_jitter).within(0, 0.999)
          .means("random shift of the beams, as a fraction of their spacing"),
      Row("spacing_rule", &Sheet::spacing_rule).one_of<SpacingRule>({{"stratified", SpacingRule::stratified}, {"tied", SpacingRule::tied}, {"literal", SpacingRule::literal}})
          .means("beam positions: stratified, a jittered walk, or the paper's walk"),
      Row("beams_per_km", &Sheet::beams_per_km).in("km⁻¹").within(0, 100000)
          .means("beams per kilometre of each layer; 0: use beams"),
      Row("step_rule", &Sheet::step_rule).one_of<PathStepRule>({{"given", PathStepRule::given}, {"energy", PathStepRule::energy}})
          .means("path_step as given, or from the electrons' mean energy"),
      Row("path_rule", &Sheet::path_rule).one_of<PathRule>({{"even", PathRule::even}, {"random", PathRule::random}})
          .means("half of path_step with a random start; or random up to path_step, as in the paper"),
      Row("points_per_px", &Sheet::points_per_px).in("px⁻¹").within(0, 1000)
          .means("least deflection points per pixel and layer, by up to 16 times the beams; 0: off"),
      Row("arcs", &Sheet::arcs).within(1, 64).means("number of equal sheets side by side, centred on center_km"),
      Row("arc_spacing_km", &Sheet::arc_spacing_km).called("spacing of the arcs").in("km").within(0.1, 1000).may_be_free(ParameterScale::logarithmic)
          .means("distance between them (10 to 100 in nature)"),
      Row("brightness_kilorayleigh", &Sheet::brightness_kilorayleigh).in("kR").within(0, 1e6)
          .means("peak brightness of 557.7 nm along the field; 0: use the energy flux"),
      Row("profile", &Sheet::profile).one_of<ProfileKind>({{"maxwellian", ProfileKind::maxwellian}, {"mono", ProfileKind::mono}, {"gaussian", ProfileKind::gaussian}, {"form", ProfileKind::form}, {"file", ProfileKind::file}, {"spline", ProfileKind::spline}, {"layer", ProfileKind::layer}})
          .means("height profile: of electrons with a Maxwellian, single or Gaussian energy; the form's measured curve; profile_file; free for each line; or the layers of [[line]]"),
      Row("profile_file", &Sheet::profile_file).names_table()
          .means("for \"file\": CSV of altitude_km and photons cm⁻³ s⁻¹ per line, relative to the scene's file"),
      Row("peak_km", &Sheet::peak_km).called("peak altitude").as(ParameterRole::form_peak).in("km").within(85, 400).may_be_free(ParameterScale::linear)
          .means("altitude of a form's brightest light"),
      Row("lower_km", &Sheet::lower_km).called("extent below the peak").as(ParameterRole::form_lower).in("km").within(0.5, 100).may_be_free(ParameterScale::logarithmic)
          .means("for \"form\": distance below the peak where the light is a tenth"),
      Row("upper_km", &Sheet::upper_km).called("extent above the peak").as(ParameterRole::form_upper).in("km").within(1, 500).may_be_free(ParameterScale::logarithmic)
          .means("for \"form\": distance above the peak where the light is a tenth"),
      Row("spline_bottom_km", &Sheet::spline_bottom_km).in("km").within(80, 630)
          .means("lowest altitude of a free-form profile, dark"),
      Row("spline_top_km", &Sheet::spline_top_km).in("km").within(90, 640)
          .means("highest altitude of a free-form profile, dark"),
      Row("spline_knots", &Sheet::spline_knots).within(4, 64)
          .means("knots of a free-form profile per line, denser at low altitude"),
      Row("spline_rate", &Sheet::spline_rate).as(ParameterRole::profile_coefficient).by_line("<line>_<n>", spline_rate_component, spline_knots)
          .in("cm⁻³ s⁻¹ per mW m⁻²").within(1e-12, 1e6).may_be_free(ParameterScale::logarithmic)
          .means("coefficients of a free-form profile by line from the bottom up (sheet.main.spline_rate.5577_3); empty: one broad layer"),
      Row("fold_spacing_km", &Sheet::fold_spacing_km).in("km").within(0, 5000).rule(none_or_some_complaint)
          .means("mean distance between folds (about 20 in nature); 0: none"),
      Row("fold_spacing_jitter", &Sheet::fold_spacing_jitter).within(0, 1)
          .means("random shift of the folds, as a fraction of their spacing"),
      Row("fold_length_km", &Sheet::fold_length_km).in("km").within(0.01, 1000)
          .means("length of the sine that a fold replaces, at most the spacing"),
      Row("fold_stage", &Sheet::fold_stage).within(0, 1).may_be_free(ParameterScale::linear)
          .means("shape of a fold: 0 a ripple, 0.5 an overhang, 1 a horseshoe"),
      Row("fold_stage_spread", &Sheet::fold_stage_spread).within(0, 1)
          .means("largest random reduction of fold_stage, as a fraction"),
      Row("fold_speed_km_s", &Sheet::fold_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("speed of the folds from start to end (0 to 5 in nature)"),
      Row("fold_lifetime_s", &Sheet::fold_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("lifetime of a fold (above 1 in nature); 0: unlimited"),
      Row("curl_spacing_km", &Sheet::curl_spacing_km).in("km").within(0, 5000).rule(none_or_some_complaint)
          .means("mean distance between curls (2 to 10 in nature); 0: none"),
      Row("curl_radius_km", &Sheet::curl_radius_km).in("km").within(0.01, 100).means("radius of a curl, at most the spacing"),
      Row("curl_turn_rad", &Sheet::curl_turn_rad).in("rad").within(-100, 100)
          .means("winding angle at a curl's centre, counter-clockwise against the field"),
      Row("curl_gather", &Sheet::curl_gather).within(0, 0.95)
          .means("relative concentration of beams at a curl's centre"),
      Row("curl_speed_km_s", &Sheet::curl_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("speed of the curls from start to end (0 to 8 in nature, at most 90)"),
      Row("curl_lifetime_s", &Sheet::curl_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("lifetime of a curl (0.25 to 0.75 in nature); 0: unlimited"),
      Row("spiral_spacing_km", &Sheet::spiral_spacing_km).in("km").within(0, 5000).rule(none_or_some_complaint)
          .means("mean distance between spirals (125 to 175 in nature); 0: none"),
      Row("spiral_radius_km", &Sheet::spiral_radius_km).in("km").within(1, 1000)
          .means("radius of a spiral, at most the spacing; its diameter is 25 to 75 in nature"),
      Row("spiral_turn_rad", &Sheet::spiral_turn_rad).in("rad").within(-100, 100)
          .means("winding angle at a spiral's centre, counter-clockwise along the field"),
      Row("spiral_speed_km_s", &Sheet::spiral_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("speed of the spirals from start to end (4 on average in nature)"),
      Row("spiral_lifetime_s", &Sheet::spiral_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("lifetime of a spiral, which winds up and unwinds; 0: unlimited"),
      Row("ray_contrast", &Sheet::ray_contrast).within(0, 3)
          .means("standard deviation of ln(light) of rays; 0: none"),
      Row("ray_width_km", &Sheet::ray_width_km).in("km").within(0.01, 100)
          .means("full width at half maximum of the rays' autocorrelation (1 or less in nature)"),
      Row("ray_length_contrast", &Sheet::ray_length_contrast).within(0, 2)
          .means("standard deviation of ln(height) of rays above the peak"),
      Row("ray_speed_km_s", &Sheet::ray_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("speed of the rays from start to end"),
      Row("ray_lifetime_s", &Sheet::ray_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint).means("lifetime of a ray; 0: unlimited"),
      Row("patch_size_km", &Sheet::patch_size_km).in("km").within(0, 1000).rule(none_or_some_complaint)
          .means("full width at half maximum of the patches' autocorrelation; 0: none"),
      Row("patch_contrast", &Sheet::patch_contrast).within(0, 3)
          .means("standard deviation of ln(light) of patches"),
      Row("patch_lifetime_s", &Sheet::patch_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint).means("lifetime of a patch; 0: unlimited"),
      Row("border_amplitude_km", &Sheet::border_amplitude_km).in("km").within(0, 100)
          .means("amplitude of the lower border's undulation; 0: even"),
      Row("border_scale_km", &Sheet::border_scale_km).in("km").within(0.1, 1000)
          .means("length of the lower border's longest waves"),
      Row("border_octaves", &Sheet::border_octaves).within(1, 8)
          .means("octaves of the lower border's waves, each half as long and high"),
      Row("border_lifetime_s", &Sheet::border_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("lifetime of the lower border's shape; 0: unlimited"),
      Row("border_rule", &Sheet::border_rule).one_of<BorderRule>({{"light", BorderRule::light}, {"start", BorderRule::start}})
          .means("what undulates: the altitude of the light; or, literally, a beam's start, which cuts light off"),
      Row("drift_km_s", &Sheet::drift_km_s).as(ParameterRole::drift).of({"east", "north"}).in("km s⁻¹").within(-100, 100)
          .means("velocity of the sheet (in nature 0.1 to 0.2 north–south, 10 east–west)"),
      Row("sine_speed_km_s", &Sheet::sine_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("speed of the sine from start to end"),
  };
  // clang-format on
}

}  // namespace vegard::sim
