#include "sim/scene/parameter_declarations.h"

#include <utility>

#include "sim/scene/emission_lines.h"
#include "sim/scene/forms.h"
#include "sim/scene/parameter_rules.h"

namespace vegard::sim {
namespace {

constexpr double pi = 3.14159265358979323846;

// The component of a member: the member itself if it is a scalar.
template <class T>
ValueRef component_of(T& scalar, int) {
  return &scalar;
}
ValueRef component_of(EastNorth& point, int c) { return c == 0 ? &point.east : &point.north; }
ValueRef component_of(std::vector<double>& list, int c) { return &list.at(c); }
template <class T, std::size_t n>
ValueRef component_of(std::array<T, n>& array, int c) {
  return &array.at(c);
}

/// Builds a Declaration step by step, so that each row below reads as one sentence.
class Row {
 public:
  template <class Value>
  Row(std::string key, Value Scene::*value) {
    d_.key = std::move(key);
    d_.at = [=](Scene& scene, int, int c) { return component_of(scene.*value, c); };
  }

  template <class Table, class Value>
  Row(std::string table, std::string key, Table Scene::*in, Value Table::*value) {
    d_.table = std::move(table);
    d_.key = std::move(key);
    d_.at = [=](Scene& scene, int, int c) { return component_of(scene.*in.*value, c); };
    if constexpr (std::is_same_v<Value, std::vector<double>>) {
      d_.list = [=](const Scene& scene) -> const std::vector<double>& { return scene.*in.*value; };
      d_.set_list = [=](Scene& scene, const std::vector<double>& list) { scene.*in.*value = list; };
    }
  }

  template <class Value>
  Row(std::string key, Value Sheet::*value) {
    d_.table = sheet_table;
    d_.key = std::move(key);
    d_.at = [=](Scene& scene, int sheet, int c) { return component_of(scene.sheets.at(sheet).*value, c); };
  }

  Row& means(std::string meaning) { return d_.meaning = std::move(meaning), *this; }
  Row& in(std::string unit) { return d_.unit = std::move(unit), *this; }
  Row& from(double min) { return d_.min = min, *this; }
  Row& within(double min, double max) { return d_.min = min, d_.max = max, *this; }
  Row& one_of(std::vector<std::string> choices) { return d_.choices = std::move(choices), *this; }
  Row& of(std::vector<std::string> components) { return d_.components = std::move(components), *this; }
  Row& may_be_free(ParameterScale scale) { return d_.scale = scale, d_.can_be_free = true, *this; }
  Row& rule(std::optional<Complaint> (*check)(double)) { return d_.number_rule = check, *this; }
  Row& rule(std::optional<Complaint> (*check)(const std::string&)) { return d_.text_rule = check, *this; }
  Row& list_rule(std::optional<Complaint> (*check)(const Scene&, const std::vector<double>&)) {
    return d_.list_rule = check, *this;
  }
  Row& set_by(void (*set)(Scene&, const std::vector<double>&)) { return d_.set_list = set, *this; }
  Row& then(void (*follow)(Scene&, int)) { return d_.then = follow, *this; }
  Row& named_by(std::string (*name)(const Scene&, int)) { return d_.list_component = name, *this; }

  operator Declaration() const { return d_; }

 private:
  Declaration d_;
};

/// Who asks for a number of beams does not want a form's, which goes by the length.
void count_beams(Scene& scene, int sheet) { scene.sheets.at(sheet).beams_per_km = 0.0; }

std::string index_name(const Scene&, int index) { return std::to_string(index); }

std::string name_by_line(const Scene& scene, int index) {
  const auto& lines = scene.emission.lines;
  return index < static_cast<int>(lines.size()) ? line_name(lines[index]) : std::to_string(index);
}

std::vector<Declaration> declare() {
  constexpr auto linear = ParameterScale::linear;
  constexpr auto logarithmic = ParameterScale::logarithmic;
  constexpr auto angle = ParameterScale::angle;
  // clang-format off
  return {
      Row("seed", &Scene::seed).from(0).means("seed of all random numbers"),

      Row("site", "latitude_deg", &Scene::site, &Site::latitude_deg).in("deg").within(-90, 90)
          .means("geographic latitude of the observer, north positive"),
      Row("site", "longitude_deg", &Scene::site, &Site::longitude_deg).in("deg").within(-180, 360)
          .means("geographic longitude of the observer, east positive"),
      Row("site", "altitude_m", &Scene::site, &Site::altitude_m).in("m").within(-500, 50000)
          .means("altitude of the observer above the sphere of the Earth"),
      Row("site", "time_utc", &Scene::site, &Site::time_utc).rule(time_complaint)
          .means("when, in ISO 8601 such as \"2019-09-01T05:00:00Z\"; empty if unknown; goes into file headers"),

      Row("field", "model", &Scene::field, &Field::model).one_of({"uniform", "dipole"})
          .means("the same field everywhere, or a tilted dipole's at each foot"),
      Row("field", "inclination_deg", &Scene::field, &Field::inclination_deg).in("deg").within(-90, 90)
          .rule(inclination_complaint).may_be_free(linear)
          .means("inclination of the magnetic field, below the horizon in the north; at least 20 from the horizontal"),
      Row("field", "declination_deg", &Scene::field, &Field::declination_deg).in("deg").within(-180, 180).may_be_free(linear)
          .means("declination of the magnetic field, from north to the east"),
      Row("field", "pole_latitude_deg", &Scene::field, &Field::pole_latitude_deg).in("deg").within(45, 90)
          .means("latitude of the dipole's northern pole; the default is that of 2020"),
      Row("field", "pole_longitude_deg", &Scene::field, &Field::pole_longitude_deg).in("deg").within(-180, 360)
          .means("longitude of the dipole's northern pole, east positive"),

      Row("camera", "model", &Scene::camera, &Camera::model).one_of({"pinhole"}).means("projection"),
      Row("camera", "width", &Scene::camera, &Camera::width).in("px").within(1, 65535).means("width of the image"),
      Row("camera", "height", &Scene::camera, &Camera::height).in("px").within(1, 65535).means("height of the image"),
      Row("camera", "hfov_deg", &Scene::camera, &Camera::hfov_deg).in("deg").within(0.1, 170).may_be_free(linear)
          .means("horizontal field of view"),
      Row("camera", "azimuth_deg", &Scene::camera, &Camera::azimuth_deg).in("deg").within(-720, 720).may_be_free(angle)
          .means("azimuth of the line of sight, from north to the east"),
      Row("camera", "elevation_deg", &Scene::camera, &Camera::elevation_deg).in("deg").within(-90, 90).may_be_free(linear)
          .means("elevation of the line of sight above the horizon"),
      Row("camera", "roll_deg", &Scene::camera, &Camera::roll_deg).in("deg").within(-180, 180).may_be_free(linear)
          .means("how far the scene appears turned clockwise in the picture"),

      Row("name", &Sheet::name).rule(sheet_name_complaint).means("by which paths call the sheet"),
      Row("form", &Sheet::form).one_of(form_names()).then(apply_form)
          .means("preset of other keys of the sheet, which those keys override: docs/forms.md, vegard params --forms"),
      Row("center_km", &Sheet::center_km).of({"east", "north"}).in("km").within(-3000, 3000).may_be_free(linear)
          .means("middle between start and end, of the feet at 110 km altitude"),
      Row("bearing_deg", &Sheet::bearing_deg).in("deg").within(-720, 720).may_be_free(angle)
          .means("direction from start to end, from north to the east"),
      Row("length_km", &Sheet::length_km).in("km").within(0.1, 5000).may_be_free(logarithmic)
          .means("distance from start to end"),
      Row("thickness_km", &Sheet::thickness_km).in("km").within(0.01, 100).may_be_free(logarithmic)
          .means("amplitude of the sine (1 to 10 in nature)"),
      Row("wavelength_km", &Sheet::wavelength_km).in("km").within(1, 5000).may_be_free(logarithmic)
          .means("wavelength of the sine"),
      Row("phase_rad", &Sheet::phase_rad).in("rad").within(-8 * pi, 8 * pi).may_be_free(angle)
          .means("phase of the first layer's sine, counted from the start"),
      Row("phase_shift_rad", &Sheet::phase_shift_rad).in("rad").within(-2 * pi, 2 * pi).may_be_free(linear)
          .means("phase from the first layer to the last"),
      Row("layers", &Sheet::layers).within(1, 100).means("number of sine curves in the sheet"),
      Row("width_km", &Sheet::width_km).in("km").within(0.01, 100).may_be_free(logarithmic)
          .means("standard deviation of a layer's Gaussian cross-section"),
      Row("beams", &Sheet::beams).within(1, 10000000).then(count_beams)
          .means("number of electron beams in each layer; setting it sets beams_per_km to 0"),
      Row("energy_kev", &Sheet::energy_kev).in("keV").within(0.1, 20).may_be_free(logarithmic)
          .means("characteristic energy E0 of the Maxwellian electrons; their mean energy is twice that"),
      Row("energy_flux_mw_m2", &Sheet::energy_flux_mw_m2).in("mW m⁻²").within(0, 10000).may_be_free(logarithmic)
          .means("energy flux Q, at its peak across a layer"),
      Row("path_spread", &Sheet::path_spread).within(0, 1)
          .means("largest random shortening of a beam, as a fraction of its path"),
      Row("loss_cone_deg", &Sheet::loss_cone_deg).in("deg").within(0, 30).may_be_free(linear)
          .means("pitch angle at the lower end of the path"),
      Row("pitch_step_rad", &Sheet::pitch_step_rad).in("rad").within(0, 0.5).may_be_free(linear)
          .means("how much smaller the pitch angle is at the upper end"),
      Row("pitch_law", &Sheet::pitch_law).one_of({"reduced", "product", "increment", "constant"})
          .means("reading of the paper's equation (4): αD − Δα(1 − t); literally αD·t·Δα; t·Δα; or αD throughout"),
      Row("path_step", &Sheet::path_step).within(1e-5, 0.5)
          .means("largest step between two deflections, as a fraction of the path"),
      Row("top_km", &Sheet::top_km).in("km").within(150, 640).means("altitude at which a beam starts"),
      Row("spacing_jitter", &Sheet::spacing_jitter).within(0, 0.999)
          .means("random shift of the beams along the sheet, as a fraction of their spacing"),
      Row("spacing_rule", &Sheet::spacing_rule).one_of({"stratified", "tied", "literal"})
          .means("places of the beams: each in a stretch of its own; a jittered walk; or the paper's walk, whose phase does not follow it"),
      Row("beams_per_km", &Sheet::beams_per_km).in("km⁻¹").within(0, 100000)
          .means("electron beams per kilometre of each layer, in place of their number; 0: beams says"),
      Row("step_rule", &Sheet::step_rule).one_of({"given", "energy"})
          .means("whether path_step is taken as it is, or follows from the electrons' mean energy"),
      Row("arcs", &Sheet::arcs).within(1, 64).means("how many like sheets stand side by side, center_km in their middle"),
      Row("arc_spacing_km", &Sheet::arc_spacing_km).in("km").within(0.1, 1000).may_be_free(logarithmic)
          .means("distance between them (10 to 100 in nature)"),
      Row("brightness_kilorayleigh", &Sheet::brightness_kilorayleigh).in("kR").within(0, 1e6)
          .means("of 557.7 nm seen along the field, at its peak across a layer, in place of the energy flux; 0: that says"),
      Row("profile", &Sheet::profile).one_of({"maxwellian", "form"})
          .means("light against altitude: of Maxwellian electrons, or the form's measured curve with their ratios of lines"),
      Row("peak_km", &Sheet::peak_km).in("km").within(85, 400).means("altitude of a form's brightest light"),
      Row("lower_km", &Sheet::lower_km).in("km").within(0.5, 100)
          .means("how far below the peak a form's light has fallen to a tenth"),
      Row("upper_km", &Sheet::upper_km).in("km").within(1, 500)
          .means("how far above the peak a form's light has fallen to a tenth"),
      Row("fold_spacing_km", &Sheet::fold_spacing_km).in("km").within(0, 5000).rule(none_or_some_complaint)
          .means("mean distance between folds (about 20 in nature); 0: no folds"),
      Row("fold_spacing_jitter", &Sheet::fold_spacing_jitter).within(0, 1)
          .means("random shift of the folds, as a fraction of their spacing"),
      Row("fold_length_km", &Sheet::fold_length_km).in("km").within(0.01, 1000)
          .means("stretch of the sine that a fold replaces, at most the spacing"),
      Row("fold_stage", &Sheet::fold_stage).within(0, 1).may_be_free(linear)
          .means("how far a fold has turned: 0 a ripple, about a half an overhang, 1 a horseshoe bend"),
      Row("fold_stage_spread", &Sheet::fold_stage_spread).within(0, 1)
          .means("how much less than that folds may have turned, as a fraction of it"),
      Row("fold_speed_km_s", &Sheet::fold_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("of the folds, from start to end (0 to 5 in nature)"),
      Row("fold_lifetime_s", &Sheet::fold_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("of a fold (more than 1 in nature); 0: folds last"),
      Row("curl_spacing_km", &Sheet::curl_spacing_km).in("km").within(0, 5000).rule(none_or_some_complaint)
          .means("mean distance between curls (2 to 10 in nature); 0: no curls"),
      Row("curl_radius_km", &Sheet::curl_radius_km).in("km").within(0.01, 100).means("of a curl, at most the spacing"),
      Row("curl_turn_rad", &Sheet::curl_turn_rad).in("rad").within(-100, 100)
          .means("angle by which a curl has wound up its centre, counter-clockwise seen against the field"),
      Row("curl_gather", &Sheet::curl_gather).within(0, 0.95)
          .means("how much closer beams stand in the centre of a curl, as a fraction of their spacing"),
      Row("curl_speed_km_s", &Sheet::curl_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("of the curls, from start to end (0 to 8 in nature, at most 90)"),
      Row("curl_lifetime_s", &Sheet::curl_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("of a curl (0.25 to 0.75 in nature); 0: curls last"),
      Row("ray_contrast", &Sheet::ray_contrast).within(0, 3)
          .means("standard deviation of the logarithm of the light from ray to ray; 0: no rays"),
      Row("ray_width_km", &Sheet::ray_width_km).in("km").within(0.01, 100)
          .means("full width of the rays' autocorrelation at half its height (1 or less in nature)"),
      Row("ray_length_contrast", &Sheet::ray_length_contrast).within(0, 2)
          .means("standard deviation of the logarithm of the rays' extent above the peak"),
      Row("ray_speed_km_s", &Sheet::ray_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("of the rays, from start to end"),
      Row("ray_lifetime_s", &Sheet::ray_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint).means("of a ray; 0: rays last"),
      Row("patch_size_km", &Sheet::patch_size_km).in("km").within(0, 1000).rule(none_or_some_complaint)
          .means("of patches of light along and across the sheet, full width of their autocorrelation; 0: no patches"),
      Row("patch_contrast", &Sheet::patch_contrast).within(0, 3)
          .means("standard deviation of the logarithm of the light from patch to patch"),
      Row("patch_lifetime_s", &Sheet::patch_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint).means("of a patch; 0: patches last"),
      Row("border_amplitude_km", &Sheet::border_amplitude_km).in("km").within(0, 100)
          .means("by which the lower border goes up and down; 0: it is even"),
      Row("border_scale_km", &Sheet::border_scale_km).in("km").within(0.1, 1000)
          .means("length of the lower border's longest waves"),
      Row("border_octaves", &Sheet::border_octaves).within(1, 8)
          .means("of the lower border's waves, each half as long and half as high as the one before"),
      Row("border_lifetime_s", &Sheet::border_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("of the lower border's course; 0: it lasts"),
      Row("drift_km_s", &Sheet::drift_km_s).of({"east", "north"}).in("km s⁻¹").within(-100, 100)
          .means("velocity of the whole sheet (0.1 to 0.2 north to south in nature, 10 east to west)"),
      Row("sine_speed_km_s", &Sheet::sine_speed_km_s).in("km s⁻¹").within(-100, 100)
          .means("of the sine, from start to end"),

      Row("emission", "lines", &Scene::emission, &Emission::lines).of({"<n>"}).named_by(index_name).in("nm")
          .rule(line_complaint).list_rule(lines_complaint).set_by(change_lines)
          .means("wavelengths of the emission lines"),

      Row("blur", "width_deg", &Scene::blur, &Blur::width_deg).of({"<line>"}).named_by(name_by_line).in("deg")
          .within(0, 10).list_rule(blur_complaint).may_be_free(logarithmic)
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

      Row("sensor", "primaries", &Scene::sensor, &Sensor::primaries).one_of({"srgb", "smpte-c"})
          .means("colour primaries of the image"),
      Row("sensor", "gain_per_kilorayleigh", &Scene::sensor, &Sensor::gain_per_kilorayleigh).within(1e-12, 1e12)
          .means("linear sensor value (white = 1) of the luminance of 1 kR of 557.7 nm"),

      Row("sky", "level", &Scene::sky, &Sky::level).of({"red", "green", "blue"}).within(-1e6, 1e6)
          .means("light behind the aurora, mean over the image's height, linear sensor value"),
      Row("sky", "gradient", &Scene::sky, &Sky::gradient).of({"red", "green", "blue"}).within(-1e6, 1e6)
          .means("how much brighter the sky is at the image's bottom than at its top, linear sensor value"),
      Row("sky", "curvature", &Scene::sky, &Sky::curvature).of({"red", "green", "blue"}).within(-1e6, 1e6)
          .means("bend of the sky's brightness: four times what top and bottom exceed the middle by"),

      Row("stars", "shown", &Scene::stars, &Stars::shown).means("whether there are stars behind the aurora"),
      Row("stars", "faintest_magnitude", &Scene::stars, &Stars::faintest_magnitude).in("mag").within(-2, 12)
          .means("of the stars that are shown"),
      Row("stars", "width_deg", &Scene::stars, &Stars::width_deg).in("deg").within(0.0001, 5)
          .means("standard deviation of a star's image"),
      Row("stars", "gain", &Scene::stars, &Stars::gain).within(0, 1e6).means("times the stars' photometric brightness"),

      Row("composite", "background", &Scene::composite, &Composite::background)
          .means("picture behind the aurora, beside the scene's file; empty: none"),
      Row("composite", "background_gain", &Scene::composite, &Composite::background_gain).within(0, 1e6)
          .means("of the background, in linear light"),
      Row("composite", "foreground", &Scene::composite, &Composite::foreground)
          .means("picture before the aurora, beside the scene's file; empty: none"),
      Row("composite", "foreground_gain", &Scene::composite, &Composite::foreground_gain).within(0, 1e6)
          .means("of the foreground, in linear light"),
      Row("composite", "mask", &Scene::composite, &Composite::mask)
          .means("picture that is white where the foreground hides the sky; empty: the foreground's alpha"),

      Row("time", "start_s", &Scene::time, &Time::start_s).in("s").within(-1e7, 1e7)
          .means("of the picture, or of an animation's first frame, on the scene's clock"),
      Row("time", "exposure_s", &Scene::time, &Time::exposure_s).in("s").within(0, 1e5)
          .means("how long the picture is exposed"),
      Row("time", "instants", &Scene::time, &Time::instants).within(1, 1024)
          .means("evenly spaced instants whose mean the picture is, the first at its start"),
      Row("time", "frames_per_second", &Scene::time, &Time::frames_per_second).in("s⁻¹").within(0.001, 1000)
          .means("of an animation"),
      Row("time", "frames", &Scene::time, &Time::frames).within(1, 1000000).means("of an animation"),

      Row("substorm", "quiet", &Scene::substorm, &Substorm::quiet).within(0, 1)
          .means("brightness of all sheets before and after a substorm, of what they say; 1: no substorm"),
      Row("substorm", "grown", &Scene::substorm, &Substorm::grown).within(0, 1)
          .means("brightness at the end of the growth phase"),
      Row("substorm", "onset_s", &Scene::substorm, &Substorm::onset_s).in("s").within(-1e7, 1e7)
          .means("when growth ends and expansion begins"),
      Row("substorm", "growth_s", &Scene::substorm, &Substorm::growth_s).in("s").within(1, 1e6)
          .means("length of the growth phase (up to 2 hours)"),
      Row("substorm", "expansion_s", &Scene::substorm, &Substorm::expansion_s).in("s").within(1, 1e6)
          .means("length of the expansion phase (about 20 minutes)"),
      Row("substorm", "recovery_s", &Scene::substorm, &Substorm::recovery_s).in("s").within(1, 1e6)
          .means("length of the recovery phase (half an hour to 2 hours)"),

      Row("fit", "roi_px", &Scene::fit, &Fit::roi_px).of({"x", "y", "width", "height"}).in("px").within(0, 65535)
          .means("region of interest; all zero: the whole image"),
      Row("fit", "bands", &Scene::fit, &Fit::bands).within(1, 65535)
          .means("number of equal column strips of the region of interest"),
      Row("fit", "band_brightness", &Scene::fit, &Fit::band_brightness)
          .means("whether each band has a brightness of its own (rays are uneven)"),
      Row("fit", "white_balance_known", &Scene::fit, &Fit::white_balance_known)
          .means("if false, each channel has a gain of its own and colour says nothing about the energy"),
      Row("fit", "sky_terms", &Scene::fit, &Fit::sky_terms).within(1, 3)
          .means("what is solved of the sky, per channel: 1 its level, 2 its gradient too, 3 its curvature too"),
      Row("fit", "decoding", &Scene::fit, &Fit::decoding).one_of({"auto", "srgb", "linear"})
          .means("how the photograph's numbers become linear light"),
      Row("fit", "model_error", &Scene::fit, &Fit::model_error).within(0, 1)
          .means("unmodelled structure, as a fraction of the local brightness"),
      Row("fit", "scan_points", &Scene::fit, &Fit::scan_points).within(0, 1000000)
          .means("wavelengths tried before the descents; 0: no search, one descent from the start"),
      Row("fit", "scan_descents", &Scene::fit, &Fit::scan_descents).within(0, 10000)
          .means("how many of the trials are followed downhill"),
  };
  // clang-format on
}

}  // namespace

const std::vector<Declaration>& declarations() {
  static const std::vector<Declaration> all = declare();
  return all;
}

const Declaration* find_declaration(const std::string& table, const std::string& key) {
  for (const Declaration& d : declarations()) {
    if (d.table == table && d.key == key) return &d;
  }
  return nullptr;
}

}  // namespace vegard::sim
