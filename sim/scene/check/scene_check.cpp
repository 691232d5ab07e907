#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/utc_time.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/structs/sensor.h"
#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/photo_scene.h"
#include "sim/scene/table/table_files.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kMaxCurvePoints = 1000;
constexpr double kMinBetweenPoints_km = 1e-3;

std::optional<Complaint> complaint_about(const Declaration& d, const ValueRef& value) {
  if (const auto* number = std::get_if<double*>(&value)) return number_complaint(d, **number);
  if (const auto* number = std::get_if<int*>(&value)) return number_complaint(d, **number);
  if (const auto* text = std::get_if<std::string*>(&value)) return text_complaint(d, **text);
  if (const auto* kind = std::get_if<KindRef>(&value))
    return text_complaint(d, kind_word(*d.kind_type, kind->number()));
  const auto* number = std::get_if<std::uint64_t*>(&value);
  if (number == nullptr) return std::nullopt;
  // TOML's integers end there.
  constexpr auto largest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (**number <= largest) return number_complaint(d, static_cast<double>(**number));
  return Complaint{std::to_string(**number) + " is too large", "at most " + std::to_string(largest), ""};
}

void check_names(const Scene& scene) {
  for (const RepeatedTable& repeated : repeated_tables()) {
    std::set<std::string> names;
    for (std::size_t e = 0; e < repeated.count(scene); ++e) {
      const std::string& name = repeated.name(scene, static_cast<int>(e));
      if (names.insert(name).second) continue;
      throw scene_error({"two of [[" + repeated.table + "]] are called '" + name + "'",
                         "a name of its own for each " + repeated.table, ""},
                        {scene.file, 0, repeated.table + "." + name + ".name"});
    }
  }
}

/// Structures keep to their slots, of which each has but one; and a form's light is where its beams are.
void check_structures(const Scene& scene) {
  const auto check = [&](const Sheet& sheet, const std::string& what, double size_km, double spacing_km,
                         const std::string& size, const std::string& spacing) {
    if (spacing_km <= 0.0 || size_km <= spacing_km) return;
    // The message points at a key that the file has.
    const std::string path = "sheet." + sheet.name + ".";
    const std::string key = path + (line_of(scene, path + size) > 0 ? size : spacing);
    throw scene_error({what + " would overlap: " + size + " is " + short_real_text(size_km) + ", " + spacing +
                           " " + short_real_text(spacing_km),
                       size + " at most " + spacing, "lower the one or raise the other"},
                      {scene.file, 0, key});
  };
  for (const Sheet& sheet : scene.sheets) {
    check(sheet, "folds", sheet.fold_length_km, sheet.fold_spacing_km, "fold_length_km", "fold_spacing_km");
    check(sheet, "curls", sheet.curl_radius_km, sheet.curl_spacing_km, "curl_radius_km", "curl_spacing_km");
    check(sheet, "spirals", sheet.spiral_radius_km, sheet.spiral_spacing_km, "spiral_radius_km",
          "spiral_spacing_km");
    // Else a given brightness might have no light at all to be reached with.
    if (has_heights_of_form(sheet.profile) && sheet.peak_km >= sheet.top_km) {
      const std::string path = "sheet." + sheet.name + ".";
      throw scene_error(
          {"the light peaks at " + short_real_text(sheet.peak_km) + " km, above its beams, which start at " +
               short_real_text(sheet.top_km),
           "peak_km below top_km", "lower the one or raise the other"},
          {scene.file, 0, path + (line_of(scene, path + "peak_km") > 0 ? "peak_km" : "top_km")});
    }
  }
}

/// A curve has points enough and a number for each of them, and nothing that is made for a sine; a sine has
/// no points.
void check_courses(const Scene& scene) {
  for (const Sheet& sheet : scene.sheets) {
    const std::string path = "sheet." + sheet.name + ".";
    const auto error_at = [&](const Complaint& complaint, const std::string& key) {
      return scene_error(complaint, {scene.file, 0, path + key});
    };
    const std::pair<const std::vector<double>*, const char*> lists[] = {
        {&sheet.east_km, "east_km"},
        {&sheet.north_km, "north_km"},
        {&sheet.point_brightness, "point_brightness"},
        {&sheet.point_energy_kev, "point_energy_kev"},
        {&sheet.point_width_km, "point_width_km"}};
    if (sheet.course == SheetCourse::sine) {
      for (const auto& [list, key] : lists)
        if (!list->empty())
          throw error_at({std::string(key) + " is of a curve, but the sheet's course is a sine",
                          "course = \"curve\", or no points", ""},
                         key);
      continue;
    }
    const std::size_t points = sheet.east_km.size();
    if (points < 2 || points > kMaxCurvePoints)
      throw error_at({"a curve through " + std::to_string(points) + " point" + (points == 1 ? "" : "s"),
                      "east_km and north_km of 2 to " + std::to_string(kMaxCurvePoints) + " points",
                      "or curve_file, which has them"},
                     points > 0 ? "east_km" : "course");
    for (const auto& [list, key] : lists) {
      const bool is_needed = list == &sheet.north_km;
      if (list->size() != points && (is_needed || !list->empty()))
        throw error_at({std::to_string(list->size()) + " numbers for the " + std::to_string(points) +
                            " points of the curve",
                        is_needed ? "one for every point" : "one for every point, or none", ""},
                       key);
    }
    for (std::size_t i = 0; i + 1 < points; ++i)
      if (std::hypot(sheet.east_km[i + 1] - sheet.east_km[i], sheet.north_km[i + 1] - sheet.north_km[i]) <
          kMinBetweenPoints_km)
        throw error_at({"points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                            " of the curve are at one place",
                        "neighbours at least " + short_real_text(kMinBetweenPoints_km) + " km apart",
                        "leave one of them out"},
                       "east_km");
    const auto refuse_beside = [&](bool is_there, const char* what, const char* key, const char* expected) {
      if (is_there)
        throw error_at({std::string("a sheet whose course is a curve ") + what, expected, ""}, key);
    };
    refuse_beside(sheet.arcs > 1, "is a single arc", "arcs", "arcs = 1, and a sheet for each curve");
    refuse_beside(sheet.fold_spacing_km > 0.0, "has no folds but its own", "fold_spacing_km",
                  "fold_spacing_km = 0, and the folds among the curve's points");
    refuse_beside(sheet.curl_spacing_km > 0.0, "has no curls but its own", "curl_spacing_km",
                  "curl_spacing_km = 0");
    refuse_beside(sheet.spiral_spacing_km > 0.0, "has no spirals but its own", "spiral_spacing_km",
                  "spiral_spacing_km = 0, and the spirals among the curve's points");
    refuse_beside(sheet.spacing_rule == SpacingRule::literal, "is not laid out by the paper's walk",
                  "spacing_rule", "\"stratified\" or \"tied\"");
    if (sheet.point_energy_kev.empty()) continue;
    if (!is_of_electrons(sheet.profile))
      throw error_at({"the sheet's profile is of no electrons, so their energy along the curve has no effect",
                      "a profile of a spectrum of electrons or a form, or no point_energy_kev", ""},
                     "point_energy_kev");
    // Where every point counts alike, the two profiles that a beam is shared out among would count double.
    if (scene.film.weight == PointWeight::unit)
      throw error_at({"energies along a curve make no sense where every point counts alike",
                      "film.weight = \"rayleigh\", or no point_energy_kev", ""},
                     "point_energy_kev");
  }
}

/// Observer and filters have no raw channels to mix: what would be ignored is refused.
void check_response(const Scene& scene) {
  const Sensor& sensor = scene.sensor;
  const ResponseKind kind = response_kind(sensor.response);
  if (kind == ResponseKind::measured) return;
  const Sensor none;
  const bool balanced =
      sensor.white_balance_rule == WhiteBalanceRule::given && sensor.white_balance != none.white_balance;
  if (!balanced && sensor.matrix_rule != MatrixRule::given) return;
  const std::string key = balanced ? "white_balance" : "matrix_rule";
  throw scene_error(
      {kind == ResponseKind::filters ? "channels behind a filter each are neither balanced nor mixed"
       : kind == ResponseKind::grey  ? "channels that see all light alike are neither balanced nor mixed"
                                     : "the CIE observer has no raw channels to balance or to mix",
       "sensor.response with a camera, or sensor." + key + " as it is without being set",
       "a camera's name or a table"},
      {scene.file, 0, "sensor." + key});
}

/// What a blur would ignore is refused.
void check_blur(const Scene& scene) {
  const Camera& c = scene.camera;
  const bool is_around = c.model == LensModel::equirectangular || c.model == LensModel::cube;
  // A cube's faces are pinholes.
  if (scene.blur.model == BlurModel::physical && is_around &&
      (c.model == LensModel::equirectangular || !scene.footprints.empty()))
    throw scene_error(
        {c.model == LensModel::cube ? "the physical blur of footprints is drawn by single pictures only"
                                    : "the physical blur does not go round an equirectangular picture",
         "blur.model = \"angle\" with this camera", ""},
        {scene.file, 0, "blur.model"});
  if (scene.blur.order != BlurOrder::rgb) return;
  const Origin origin{scene.file, 0, "blur.order"};
  if (scene.blur.model == BlurModel::physical)
    throw scene_error({"the physical blur is of lines, and not of red, green and blue",
                       "blur.order = \"lines\", or blur.model = \"angle\"", ""},
                      origin);
  if (is_around)
    throw scene_error({"a blur after colour does not go round a panorama", "blur.order = \"lines\"", ""},
                      origin);
  if (has_drawn_emitters(scene))
    throw scene_error({"a blur after colour is drawn for sheets only, as in the paper",
                       "blur.order = \"lines\"", "or leave out what is marched along rays"},
                      origin);
}

/// Panoramas have a shape of their own, and no lens to shift, to bend or to darken: what would be ignored is
/// refused.
void check_panorama(const Scene& scene) {
  const Camera& c = scene.camera;
  const bool is_cube = c.model == LensModel::cube;
  if (!is_cube && c.model != LensModel::equirectangular) return;
  const std::string size = std::to_string(c.width) + " x " + std::to_string(c.height) + " pixels";
  if (!is_cube && c.width != 2 * c.height)
    throw scene_error({"an equirectangular picture is twice as wide as high, not " + size,
                       "camera.width = 2 camera.height", "such as 2048 x 1024"},
                      {scene.file, 0, "camera.width"});
  if (is_cube) {
    const auto [columns, rows] = c.cube_layout == CubeLayout::cross   ? std::pair(4, 3)
                                 : c.cube_layout == CubeLayout::strip ? std::pair(6, 1)
                                                                      : std::pair(3, 2);
    if (c.height % rows != 0 || c.width * rows != c.height * columns)
      throw scene_error({"this layout of a cube is " + std::to_string(columns) + " faces wide and " +
                             std::to_string(rows) + " high, not " + size,
                         "square faces of whole pixels",
                         "such as " + std::to_string(512 * columns) + " x " + std::to_string(512 * rows)},
                        {scene.file, 0, "camera.width"});
  }
  const Camera none;
  const auto refuse = [&](const std::string& key, bool is_set) {
    if (!is_set) return;
    throw scene_error({"a panorama has no " + key, "camera." + key + " as it is without being set", ""},
                      {scene.file, 0, "camera." + key});
  };
  refuse("principal_x_px", c.principal_x_px != none.principal_x_px);
  refuse("principal_y_px", c.principal_y_px != none.principal_y_px);
  refuse("aspect", c.aspect != none.aspect);
  refuse("k1", c.k1 != none.k1);
  refuse("k2", c.k2 != none.k2);
  refuse("k3", c.k3 != none.k3);
  refuse("p1", c.p1 != none.p1);
  refuse("p2", c.p2 != none.p2);
  refuse("mirrored", is_cube && c.mirrored);
  const auto refuse_elsewhere = [&](const std::string& key, bool is_set, const std::string& problem) {
    if (!is_set) return;
    throw scene_error({problem, key + " as it is without being set", ""}, {scene.file, 0, key});
  };
  const Sensor& sensor = scene.sensor;
  refuse_elsewhere("sensor.vignetting_cos_power", sensor.vignetting_cos_power != 0.0,
                   "a panorama has no corners to darken");
  refuse_elsewhere("sensor.vignetting", sensor.vignetting != Sensor().vignetting,
                   "a panorama has no corners to darken");
  refuse_elsewhere("march.depth", !scene.march.depth.empty(), "a panorama takes no picture of depths");
  refuse_elsewhere("march.glow", scene.march.glow != 0.0, "glow would end at a panorama's seams");
}

/// The real sky of a date without its time of day would be a guess, and one of
/// other centuries is not known.
void check_sky_time(const Scene& scene, const std::string& what, const Origin& origin) {
  const std::string& time = scene.site.time_utc;
  const std::string expected =
      "site.time_utc of the years 1900 to 2200, such "
      "as \"2019-09-01T05:00:00Z\"";
  if (time.empty()) throw scene_error({what + " by the time, which is not given", expected, ""}, origin);
  if (utc_seconds(time)) return;
  const bool is_date = has_form(time, "0000-00-00");
  throw scene_error({what + " by the time, but '" + time + "' " +
                         (is_date ? "has no time of day" : "is outside of the years that it is known for"),
                     expected, is_date ? "midnight is '" + time + "T00:00:00Z'" : ""},
                    {scene.file, 0, "site.time_utc"});
}

/// What goes by the real sky or the real field needs a time and a place.
/// (igrf_year() asks for the time.)
void check_time_and_place(const Scene& scene) {
  const auto needs_place = [&](const std::string& key, bool is_set, const std::string& what) {
    if (!is_set) return;
    for (const bool is_latitude : {true, false})
      if (!(is_latitude ? is_latitude_given(scene) : is_longitude_given(scene))) {
        const std::string of_place = is_latitude ? "latitude" : "longitude";
        throw scene_error({what + " by the site's " + of_place + ", which is not given",
                           "site.latitude_deg and site.longitude_deg, east positive", ""},
                          {scene.file, 0, key});
      }
  };
  const auto needs = [&](const std::string& key, bool is_set, const std::string& what) {
    if (is_set) check_sky_time(scene, what, {scene.file, 0, key});
    needs_place(key, is_set, what);
  };
  needs_place("field.model", scene.field.model == FieldModel::igrf, "the reference field (\"igrf\") goes");
  needs("stars.source", scene.stars.shown && scene.stars.source == StarSource::catalogue,
        "the catalogue's stars are placed in the sky");
  needs("stars.planets", scene.stars.planets, "planets are placed in the sky");
  needs("stars.milky_way", scene.stars.milky_way, "the Milky Way is placed in the sky");
  needs("moon.shown", scene.moon.shown, "the Moon is placed in the sky");
  needs("moon.skylight", scene.moon.skylight, "the Moon is placed in the sky");
  needs("twilight.sun", scene.twilight.shown && scene.twilight.sun == TwilightSun::of_time,
        "the sun is placed below the horizon");
}

/// What such a file has to hold is checked where it is used.
void check_profile_files(const Scene& scene) {
  for (const Sheet& sheet : scene.sheets) {
    if (sheet.profile != ProfileKind::file || is_table_file(sheet.profile_file)) continue;
    const std::string path = "sheet." + sheet.name + ".";
    const bool is_named = !sheet.profile_file.empty();
    throw scene_error({is_named ? "'" + sheet.profile_file + "' is no CSV file by its name"
                                : "the profile is to come from a file, but profile_file names none",
                       "profile_file = \"a name that ends in .csv\"", "the file is in the scene's folder"},
                      {scene.file, 0, path + (is_named ? "profile_file" : "profile")});
  }
}

/// At the key that the file has, of two that do not go together.
Origin origin_of(const Scene& scene, const std::string& key, const std::string& other) {
  return {scene.file, 0, line_of(scene, key) > 0 || line_of(scene, other) == 0 ? key : other};
}

/// Whatever a curve or an exposure needs must be there, and a lens gives some light everywhere.
void check_sensor(const Scene& scene) {
  const Sensor& sensor = scene.sensor;
  if (sensor.exposure == ExposureRule::camera && scene.time.exposure_s <= 0.0)
    throw scene_error({"a camera that is exposed for no time sees nothing", "time.exposure_s above 0",
                       "set time.exposure_s, or sensor.exposure = \"gain\""},
                      origin_of(scene, "sensor.exposure", "time.exposure_s"));
  if (sensor.tone == ToneKind::file && !is_table_file(sensor.tone_file))
    throw scene_error({"the tone \"file\" has no file", "sensor.tone_file, the name of a .csv", ""},
                      origin_of(scene, "sensor.tone_file", "sensor.tone"));
  if (sensor.tone == ToneKind::filmic && scene.fit.photo_noise == PhotoNoise::sensor)
    throw scene_error({"the tone \"filmic\" mixes the channels, whose noise is not known then",
                       "another sensor.tone, or fit.photo_noise = \"estimated\"", ""},
                      origin_of(scene, "fit.photo_noise", "sensor.tone"));
  const auto& [r2, r4, r6] = sensor.vignetting;
  constexpr int kSteps = 100;
  constexpr double kMin = 0.01;
  for (int i = 0; i <= kSteps; ++i) {
    const double square = static_cast<double>(i) * i / (kSteps * kSteps);
    const double light = 1.0 + square * (r2 + square * (r4 + square * r6));
    if (light < kMin)
      throw scene_error({"the lens would give " + short_real_text(light) + " of its light at " +
                             short_real_text(std::sqrt(square)) + " of the way to the corner",
                         "at least " + short_real_text(kMin) + " everywhere", ""},
                        {scene.file, 0, "sensor.vignetting"});
  }
}

/// As many coefficients as the lines ask for, between two altitudes where the beams are, and of a brightness
/// of their own.
void check_splines(const Scene& scene) {
  for (const Sheet& sheet : scene.sheets) {
    if (!has_spline_profile(sheet)) continue;
    const std::string path = "sheet." + sheet.name + ".";
    const auto origin = [&](const std::string& key) { return Origin{scene.file, 0, path + key}; };
    if (sheet.spline_bottom_km + 10.0 > sheet.spline_top_km)
      throw scene_error({"the profile has no room between " + short_real_text(sheet.spline_bottom_km) +
                             " and " + short_real_text(sheet.spline_top_km) + " km",
                         "spline_bottom_km at least 10 km below spline_top_km", ""},
                        origin("spline_top_km"));
    // Above its beams a profile has no light, and coefficients there would be constrained by nothing.
    if (sheet.spline_top_km > sheet.top_km)
      throw scene_error({"the profile reaches up to " + short_real_text(sheet.spline_top_km) +
                             " km, above its beams, which start at " + short_real_text(sheet.top_km),
                         "spline_top_km at most top_km", "lower the one or raise the other"},
                        origin_of(scene, path + "spline_top_km", path + "top_km"));
    const std::size_t lines = scene.emission.lines.size(),
                      wanted = lines * static_cast<std::size_t>(sheet.spline_knots);
    if (sheet.spline_rate.size() != wanted)
      throw scene_error(
          {std::to_string(sheet.spline_rate.size()) + " coefficients for " + std::to_string(lines) +
               " emission lines with " + std::to_string(sheet.spline_knots) + " knots each",
           std::to_string(wanted) + " coefficients", "leave spline_rate out, and it is filled in"},
          origin("spline_rate"));
    if (sheet.brightness_kilorayleigh > 0.0)
      throw scene_error(
          {"a free-form profile has its own brightness", "brightness_kilorayleigh (and ibc) left out",
           "the coefficients times energy_flux_mw_m2 are the light"},
          origin("brightness_kilorayleigh"));
  }
}

void check_region(const Scene& scene) {
  const auto& [x, y, width, height] = scene.fit.roi_px;
  const bool is_whole_image = x == 0 && y == 0 && width == 0 && height == 0;
  if (is_whole_image) return;
  const Origin origin{scene.file, 0, "fit.roi_px"};
  if (width == 0 || height == 0) {
    throw scene_error(
        {"the region of interest is empty", "x, y, width and height, with width and height above 0",
         "all four zero means the whole image"},
        origin);
  }
  if (scene.fit.bands > width) {
    throw scene_error({std::to_string(scene.fit.bands) + " bands do not fit into a region " +
                           std::to_string(width) + " pixels wide",
                       "at most one band per pixel column", "lower fit.bands or widen fit.roi_px"},
                      origin);
  }
}

}  // namespace

void validate(const Scene& scene) {
  for (const Declaration& d : declarations()) {
    if (!d.list_rule) continue;  // none of a sheet has one
    if (const auto complaint = d.list_rule(scene, d.list(scene, -1))) {
      throw scene_error(*complaint, {scene.file, 0, key_path(d, scene, -1)});
    }
  }
  for (const ParameterPath& path : all_paths(scene)) {
    const Declaration& d = declaration_of(*path.row);
    // Only read through: the accessors take a Scene they could change.
    const ValueRef value = d.at(const_cast<Scene&>(scene), path.element, path.component);
    if (const auto complaint = complaint_about(d, value))
      throw scene_error(*complaint, {scene.file, 0, path.text});
  }
  check_body(scene);
  if (scene.field.model == FieldModel::igrf) igrf_year(scene);
  check_names(scene);
  check_own_lines(scene);
  check_structures(scene);
  check_courses(scene);
  check_response(scene);
  check_blur(scene);
  check_panorama(scene);
  check_time_and_place(scene);
  check_profile_files(scene);
  check_sensor(scene);
  check_splines(scene);
  for (const EmitterKind& kind : emitter_kinds())
    if (kind.check != nullptr) kind.check(scene);
  check_region(scene);
  check_free_parameters(scene);
  check_tied_parameters(scene);
  check_photos(scene);
  check_radars(scene);
  check_keyframes(scene);
}

}  // namespace vegard::sim
