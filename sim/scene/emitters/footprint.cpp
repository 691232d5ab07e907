// [[footprint]]: aurora by its footprint.
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/footprint.h"
#include "sim/scene/structs/footprint_spline.h"

namespace vegard::sim {
namespace {

template <class Value>
Row<Footprint> row(const char* key, Value Footprint::*value) {
  return Row("footprint", key, &Scene::footprints, value)
      .none_free_if([](const Footprint& f) { return f.shape == FootprintShape::shell; },
                    {"the footprint is a shell, whose map has no derivative by {key}",
                     "a number of a footprint of shape \"box\", or energy_kev", "leave it out of fit.free"});
}

/// A row whose number has an effect on a spline alone.
Row<Footprint> of_spline(Row<Footprint> row) {
  return row.inert_if([](const Footprint& f) { return f.source != FootprintSource::spline; },
                      "the footprint comes from {source}", "set source to \"spline\"");
}
Row<Footprint> of_still_spline(const Row<Footprint>& row) {
  return of_spline(row).not_free_if(
      [](const Footprint& f) { return f.model != FootprintModel::curtain && flows(f); },
      {"the flow that winds the footprint up depends on {key}, and its derivative is not known",
       "a footprint that does not flow, or a number that its flow does not depend on",
       "set flow_turns = 0, or leave it out of fit.free"});
}

/// A row whose number has no effect where the source has place, energy and flux of its own.
Row<Footprint> not_of_source(Row<Footprint> row) {
  return row
      .inert_if([](const Footprint& f) { return f.source == FootprintSource::precipitation; },
                "place, energy and flux are those of the map of precipitation",
                "free a sheet that follows the map's curtains")
      .inert_if([](const Footprint& f) { return f.source == FootprintSource::sheets; },
                "feet, energy and flux are those of the sheets", "free the sheets' own numbers");
}

std::vector<Declaration> footprint_rows() {
  using F = Footprint;
  // clang-format off
  return {
      row("name", &F::name).means("name in paths"),
      row("shape", &F::shape).one_of<FootprintShape>({{"box", FootprintShape::box}, {"shell", FootprintShape::shell}})
          .means("a box in the observer's tangent plane, or a shell around the Earth"),
      row("model", &F::model).one_of<FootprintModel>({{"volume", FootprintModel::volume}, {"curtain", FootprintModel::curtain}})
          .means("light with a thickness, or thin upright walls (a cheap preview)"),
      row("source", &F::source).one_of<FootprintSource>({{"spline", FootprintSource::spline}, {"image", FootprintSource::image}, {"cube", FootprintSource::cube}, {"sheets", FootprintSource::sheets}, {"noise", FootprintSource::noise}, {"precipitation", FootprintSource::precipitation}})
          .means("a curve, a picture, faces of a cube, the scene's sheets (then not drawn as beams), fractal noise, or a map by vegard map"),
      row("fall", &F::fall).one_of<FootprintFall>({{"field", FootprintFall::field}, {"vertical", FootprintFall::vertical}})
          .means("along the field or straight down (as always of a shell in a uniform field)"),
      not_of_source(row("center_km", &F::center_km)).as(ParameterRole::footprint_centre).of({"east", "north"}).in("km").within(-3000, 3000).may_be_free(ParameterScale::linear)
          .means("middle of a box, of the feet at 110 km altitude"),
      row("size_km", &F::size_km).of({"east", "north"}).in("km").within(1, 6000)
          .means("extent of a box"),
      row("cell_km", &F::cell_km).in("km").within(0.01, 100).means("edge of a cell of a box's footprint"),
      row("face_cells", &F::face_cells).within(16, 8192)
          .means("cells along an edge of each cube face of a shell"),
      of_still_spline(row("east_km", &F::east_km)).called("east of point").as(ParameterRole::footprint_east).numbered().in("km").within(-6000, 6000).may_be_free(ParameterScale::linear)
          .means("points of a box's spline, from its middle"),
      of_still_spline(row("north_km", &F::north_km)).called("north of point").as(ParameterRole::footprint_north).numbered().in("km").within(-6000, 6000).may_be_free(ParameterScale::linear)
          .means("the same to the north"),
      row("latitude_deg", &F::latitude_deg).numbered().in("deg").within(-90, 90)
          .means("points of a shell's spline"),
      row("longitude_deg", &F::longitude_deg).numbered().in("deg").within(-360, 720)
          .means("their longitudes, to the east"),
      row("closed", &F::closed).means("the last point is followed by the first"),
      of_still_spline(row("width_km", &F::width_km)).in("km").within(0.01, 1000).may_be_free(ParameterScale::logarithmic)
          .means("Gaussian across the spline: standard deviation"),
      row("image", &F::image).names_file()
          .means("picture: north up for a box, equirectangular for a shell, \"NAME_{face}.png\" for a cube (docs/volumes.md)"),
      row("image_gamma", &F::image_gamma).within(0.1, 10).means("exponent from the picture's value to the energy flux"),
      row("energy_image", &F::energy_image).names_file().means("picture of the energy, of the same extent; empty: uniform"),
      row("energy_ratio", &F::energy_ratio).within(0.01, 100)
          .means("energy at white over energy_kev at black of energy_image, logarithmic between"),
      of_spline(row("point_energy", &F::point_energy)).called("energy of point").numbered().within(0.05, 20).may_be_free(ParameterScale::logarithmic)
          .means("at the spline's points, relative to energy_kev; empty: 1"),
      of_still_spline(row("point_flux", &F::point_flux)).called("energy flux of point").numbered().within(0, 1000).may_be_free(ParameterScale::linear)
          .means("at the spline's points, relative to energy_flux_mw_m2; empty: 1"),
      row("file", &F::file).names_file()
          .means("for \"precipitation\": FITS map by vegard map (docs/volumes.md)"),
      row("noise_scale_km", &F::noise_scale_km).in("km").within(1, 5000).means("largest waves of a noise footprint"),
      row("noise_octaves", &F::noise_octaves).within(1, 10).means("its octaves"),
      row("noise_coverage", &F::noise_coverage).within(0, 1).means("share of the box that shines, roughly"),
      row("noise_lifetime_s", &F::noise_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint)
          .means("0: unlimited"),
      row("flow_turns", &F::flow_turns).within(0, 10)
          .means("winding by a plane flow, in turns of its fastest part; 0: none"),
      row("flow_turns_per_s", &F::flow_turns_per_s).in("s⁻¹").within(0, 10)
          .means("change of flow_turns per second, within 0–10 turns"),
      row("flow_sense", &F::flow_sense).one_of<FlowSense>({{"spiral", FlowSense::spiral}, {"charge", FlowSense::charge}})
          .means("counter-clockwise seen along the field (as spirals), or against it (as a charged sheet)"),
      row("flow_scale_km", &F::flow_scale_km).in("km").within(1, 2000).means("ripples that the flow starts from"),
      row("flow_ripple", &F::flow_ripple).within(0, 10).means("their strength relative to the footprint's own shear"),
      row("ray_contrast", &F::ray_contrast).within(0, 3)
          .inert_if([](const F& f) { return f.model != FootprintModel::curtain; }, "only a curtain has rays", "set model to \"curtain\"")
          .means("of a curtain's rays, as a sheet's"),
      row("ray_width_km", &F::ray_width_km).in("km").within(0.05, 1000).means("full width of a ray at half its maximum"),
      row("ray_lifetime_s", &F::ray_lifetime_s).in("s").within(0, 1e6).rule(none_or_some_complaint).means("0: unlimited"),
      row("bulge_km", &F::bulge_km).in("km").within(0, 3000)
          .means("height, towards the pole, of a substorm's bulge (docs/volumes.md)"),
      row("bulge_longitude_deg", &F::bulge_longitude_deg).in("deg").within(-360, 720).means("where it begins"),
      row("bulge_length_km", &F::bulge_length_km).in("km").within(10, 5000).means("length of its front, and of its tail"),
      row("bulge_speed_km_s", &F::bulge_speed_km_s).in("km s⁻¹").within(0, 100).means("of its front, to the west along the spline"),
      row("bulge_gain", &F::bulge_gain).within(0, 1000).means("factor on the flux in it"),
      row("drift_km_s", &F::drift_km_s).of({"east", "north"}).in("km s⁻¹").within(-100, 100)
          .means("velocity; of a shell its speed to the east at the equator"),
      row("light", &F::light).one_of<FootprintLight>({{"lines", FootprintLight::lines}, {"colours", FootprintLight::colours}})
          .means("emission lines, or two colours between two altitudes"),
      row("low_colour", &F::low_colour).of({"r", "g", "b"}).within(0, 1).means("colour at low_km, linear, of the sensor's primaries"),
      row("high_colour", &F::high_colour).of({"r", "g", "b"}).within(0, 1).means("colour at high_km"),
      row("low_km", &F::low_km).in("km").within(80, 640).means("altitude of low_colour and below"),
      row("high_km", &F::high_km).in("km").within(80, 640).means("altitude of high_colour and above"),
      not_of_source(Row("footprint", "energy_kev", &Scene::footprints, &F::energy_kev)).as(ParameterRole::footprint_energy).in("keV").within(0.1, 20).may_be_free(ParameterScale::logarithmic)
          .means("characteristic energy, as a sheet's"),
      not_of_source(row("energy_flux_mw_m2", &F::energy_flux_mw_m2)).as(ParameterRole::footprint_energy_flux).in("mW m⁻²").within(0, 10000).may_be_free(ParameterScale::logarithmic)
          .means("energy flux at the spline, or where the picture is white"),
      row("profile", &F::profile).one_of<ProfileKind>({{"maxwellian", ProfileKind::maxwellian}, {"mono", ProfileKind::mono}, {"gaussian", ProfileKind::gaussian}, {"form", ProfileKind::form}, {"layer", ProfileKind::layer}})
          .means("height profile: of electrons, a form, or the layers of [[line]]"),
      row("energy_spread", &F::energy_spread).within(0.01, 1).means("for \"gaussian\", as a sheet's"),
      row("peak_km", &F::peak_km).called("peak altitude").in("km").within(81, 600).means("for \"form\": altitude of the peak"),
      row("lower_km", &F::lower_km).called("extent below the peak").in("km").within(0.5, 100).means("from the peak down to a tenth of the light"),
      row("upper_km", &F::upper_km).called("extent above the peak").in("km").within(0.5, 500).means("from the peak up to a tenth of the light"),
      row("top_km", &F::top_km).in("km").within(100, 640).means("top of the light"),
  };
  // clang-format on
}

/// That no map, and no curve, takes more memory than a machine has.
void check_size(const Footprint& f, double sphere_km, const ElementCheck& check) {
  const bool is_shell = f.shape == FootprintShape::shell;
  if (has_spline(f) && spline_pieces(f, sphere_km) > kMaxSplinePieces)
    throw check.error_at(
        {"the spline would be drawn in " + short_real_text(spline_pieces(f, sphere_km)) + " pieces of " +
             short_real_text(longest_piece_km(f, sphere_km)) + " km",
         "at most 1048576", "a larger width_km, larger cells, or points nearer to each other"},
        is_shell ? "longitude_deg" : "east_km");
  if (f.model == FootprintModel::curtain) return;
  if (!is_shell && longest_side_cells(f) > kMaxSideCells)
    throw check.error_at({"the box has " + short_real_text(longest_side_cells(f)) + " cells along a side",
                          "at most 262000", "a larger cell_km, or a smaller size_km"},
                         "cell_km");
  if (!is_shell && map_cells(f) > kMaxBoxCells)
    throw check.error_at({"the box has more than 67108864 cells: " + short_real_text(map_cells(f)),
                          "a larger cell_km, or a smaller size_km", ""},
                         "cell_km");
  const double bytes = map_cells(f) * bytes_per_cell(f, sizeof(double));
  if (bytes > kMaxMapBytes)
    throw check.error_at(
        {"the footprint's map would take " + short_real_text(std::round(bytes * 1e-8) * 0.1) + " GB, " +
             short_real_text(bytes_per_cell(f, sizeof(double))) + " bytes a cell",
         "at most 4 GB", is_shell ? "fewer face_cells" : "a larger cell_km, or a smaller size_km"},
        is_shell ? "face_cells" : "cell_km");
}

/// Between neighbours a quarter of the way round or more apart, a spline would leave the sphere too far to be
/// drawn back to it.
void check_points_of_shell(const Footprint& f, const ElementCheck& check) {
  const auto unit = [&](std::size_t i) {
    const double latitude = f.latitude_deg[i] * kRadiansPerDegree,
                 longitude = f.longitude_deg[i] * kRadiansPerDegree;
    return std::array<double, 3>{std::cos(latitude) * std::cos(longitude),
                                 std::cos(latitude) * std::sin(longitude), std::sin(latitude)};
  };
  const std::size_t n = f.latitude_deg.size();
  for (std::size_t i = 0; i < (f.closed ? n : n - 1); ++i) {
    const std::size_t next = (i + 1) % n;
    const std::array<double, 3> a = unit(i), b = unit(next);
    const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    if (cosine > 1e-9) continue;
    const double degrees = std::acos(std::clamp(cosine, -1.0, 1.0)) / kRadiansPerDegree;
    throw check.error_at(
        {"points " + std::to_string(i) + " and " + std::to_string(next) + " are " +
             short_real_text(std::round(degrees * 10.0) * 0.1) + " degrees apart on the globe",
         "neighbours less than 90 degrees apart" +
             std::string(f.closed ? ", the last and the first of a closed curve too" : ""),
         "more points between them"},
        "longitude_deg");
  }
}

void check_the_footprint(const Scene& scene, const Footprint& f) {
  const ElementCheck check(scene, "footprint." + f.name);
  const bool is_shell = f.shape == FootprintShape::shell;
  const auto &x = is_shell ? f.longitude_deg : f.east_km, &y = is_shell ? f.latitude_deg : f.north_km;
  const char *x_key = is_shell ? "longitude_deg" : "east_km", *y_key = is_shell ? "latitude_deg" : "north_km";
  const bool on_spline = has_spline(f);
  if (on_spline) {
    if (x.size() != y.size())
      throw check.error_at(
          {std::to_string(x.size()) + " of " + x_key + " for " + std::to_string(y.size()) + " of " + y_key,
           "as many of one as of the other", ""},
          y_key);
    if (x.size() < 2 || x.size() > 1000)
      throw check.error_at({"a spline through " + std::to_string(x.size()) + " points",
                            std::string(x_key) + " and " + y_key + " of 2 to 1000 points", ""},
                           x_key);
    if (is_shell) check_points_of_shell(f, check);
  }
  for (const auto& [list, key] : {std::pair{&f.point_energy, "point_energy"}, {&f.point_flux, "point_flux"}})
    if (!list->empty() && (!on_spline || list->size() != x.size()))
      throw check.error_at({std::to_string(list->size()) + " numbers for " +
                                std::to_string(on_spline ? x.size() : 0) + " points of a spline",
                            "one for every point, or none", ""},
                           key);
  if (f.model == FootprintModel::curtain && f.source != FootprintSource::spline)
    throw check.error_at({"a curtain stands on a spline, not on a footprint of " +
                              quoted_text(word_in(footprint_rows(), f.source)),
                          "source = \"spline\"", "or model = \"volume\""},
                         "model");
  const bool of_file = f.source == FootprintSource::image || f.source == FootprintSource::cube;
  if (of_file && f.image.empty())
    throw check.error_at(
        {"the footprint is to come from a picture, but image names none", "image = \"a picture's name\"", ""},
        "source");
  if (f.source == FootprintSource::cube && (!is_shell || f.image.find("{face}") == std::string::npos))
    throw check.error_at(
        {is_shell ? "'" + f.image + "' does not say where the face's name stands" : "a box has no cube faces",
         is_shell ? "a name such as \"foot_{face}.png\"" : "shape = \"shell\"", ""},
        is_shell ? "image" : "source");
  const bool of_map = f.source == FootprintSource::precipitation;
  if (of_map && f.file.empty())
    throw check.error_at({"the footprint is to come from a map of precipitation, but file names none",
                          "file = \"precipitation.fits\"", ""},
                         "source");
  if (of_map && flows(f))
    throw check.error_at({"a map of precipitation is not wound up", "flow_turns = 0", ""}, "flow_turns");
  if (is_shell && (f.source == FootprintSource::sheets || of_map))
    throw check.error_at(
        {"a footprint of " + quoted_text(word_in(footprint_rows(), f.source)) + " is a box's",
         "shape = \"box\"", ""},
        "source");
  if (f.source == FootprintSource::sheets && scene.sheets.empty())
    throw check.error_at({"the footprint is to be that of the sheets, but there are none",
                          "a [[sheet]], or another source", ""},
                         "source");
  if (f.bulge_km > 0.0 && !(is_shell && on_spline))
    throw check.error_at({"a substorm's bulge is in a spline around the Earth",
                          "shape = \"shell\" and a spline, or bulge_km = 0", ""},
                         "bulge_km");
  if (f.bulge_km > 0.0 && !(f.bulge_speed_km_s > 0.0))
    throw check.error_at(
        {"a bulge whose front stands still would hardly rise", "bulge_speed_km_s above 0", ""},
        "bulge_speed_km_s");
  const bool drifts = f.drift_km_s.east != 0.0 || f.drift_km_s.north != 0.0;
  if (drifts && f.source == FootprintSource::sheets)
    throw check.error_at(
        {"a footprint of the sheets goes where they go", "drift_km_s = [0, 0]", "the sheets' own drift_km_s"},
        "drift_km_s");
  if (is_shell && f.drift_km_s.north != 0.0)
    throw check.error_at(
        {"a shell turns about the Earth's axis and cannot drift to the north", "drift_km_s = [east, 0]", ""},
        "drift_km_s");
  check_size(f, scene.body.radius_km, check);
  check.check_below(f.low_km, "low_km", f.high_km, "high_km");
}

bool footprints_may_emit(const Scene& scene) {
  return std::any_of(scene.footprints.begin(), scene.footprints.end(), [](const Footprint& f) {
    return f.source == FootprintSource::precipitation || f.energy_flux_mw_m2 > 0.0;
  });
}

bool footprints_move(const Scene& scene) {
  return std::any_of(scene.footprints.begin(), scene.footprints.end(), [&](const Footprint& f) {
    return f.source == FootprintSource::sheets || moves_by_itself(f) || scene.substorm.quiet < 1.0;
  });
}

bool footprints_of_sheets(const Scene& scene) {
  return std::any_of(scene.footprints.begin(), scene.footprints.end(),
                     [](const Footprint& f) { return f.source == FootprintSource::sheets; });
}

std::vector<LightLocation> where_footprints_are(const Scene& scene) {
  std::vector<LightLocation> all;
  for (const Footprint& f : scene.footprints) {
    all.push_back({LightLocation::Known::place, "footprint '" + f.name + "'", f.center_km});
    if (f.source == FootprintSource::precipitation) {
      all.back().known = LightLocation::Known::file;
      all.back().words = "stands where " + f.file + " has it";
      continue;
    }
    if (f.shape == FootprintShape::box) continue;
    all.back().known = LightLocation::Known::words;
    all.back().words = "stands around the Earth";
  }
  return all;
}

std::optional<Complaint> footprints_stay_at(Scene& scene, const Site& home) {
  for (Footprint& f : scene.footprints) {
    if (f.source == FootprintSource::sheets)
      return Complaint{"a footprint of sheets is not carried over to another site",
                       "beams, or another source of the footprint", ""};
    // A shell is the same from everywhere.
    if (f.shape == FootprintShape::box && !f.home) f.home = home;
  }
  return std::nullopt;
}

std::vector<PictureOfScene> pictures_of_footprints(const Scene& scene) {
  std::vector<PictureOfScene> all;
  for (const Footprint& f : scene.footprints) {
    if (f.source != FootprintSource::image && f.source != FootprintSource::cube) continue;
    const std::string path = "footprint." + f.name + ".";
    for (const auto& [key, name] : {std::pair{"image", f.image}, {"energy_image", f.energy_image}})
      if (!name.empty()) all.push_back({path + key, name, f.source == FootprintSource::cube});
  }
  return all;
}

}  // namespace

EmitterKind footprint_kind() {
  EmitterKind kind;
  kind.table = "footprint";
  kind.repeated = {repeated_table_of(kind.table, &Scene::footprints)};
  kind.rows = footprint_rows;
  kind.light = LightKind::aurora;
  kind.check = check_each<&Scene::footprints, check_the_footprint>;
  kind.may_emit = footprints_may_emit;
  kind.moves = footprints_move;
  kind.made_of_sheets = footprints_of_sheets;
  kind.light_locations = where_footprints_are;
  kind.pictures = pictures_of_footprints;
  kind.stay_at = footprints_stay_at;
  kind.place_in_preview = 0;
  return kind;
}

}  // namespace vegard::sim
