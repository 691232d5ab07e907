#include "fit/report/map_run.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "fit/map/curtains/stored_map.h"
#include "fit/map/rasterised_map.h"
#include "fit/report/curtain_places.h"
#include "fit/report/netcdf/run_dataset.h"
#include "fit/report/table/mode_information_json.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

constexpr const char* kMapJson = "map.json";
constexpr const char *kCurtainGeojson = "curtains.geojson", *kCurtainKml = "curtains.kml";
constexpr std::size_t kMaxMapBytes = 64u << 20;

std::string file_of(const char* stem, const std::string& photo) {
  return std::string(stem) + (photo.empty() ? "" : "-" + photo) + ".exr";
}

/// Names of the photographs of a map.json of vegard's; none if it is not one.
std::optional<nlohmann::json> map_json_of(const std::string& bytes) {
  const nlohmann::json json = nlohmann::json::parse(bytes, nullptr, false);
  if (!json.is_object() || !json.contains("kind") || json["kind"] != "vegard map" ||
      !json.contains("photos") || !json["photos"].is_array() || !json.contains("version") ||
      !json["version"].is_string())
    return {};
  for (const nlohmann::json& photo : json["photos"])
    if (!photo.is_object() || !photo.contains("name") || !photo["name"].is_string()) return {};
  return json;
}

sim::KnownFolder look_at_map(const std::string& directory) {
  std::set<std::string> names = {kMapJson,      "precipitation.fits", kCurtainTable,   kFaintCurtainTable,
                                 "report.html", kMapNetcdf,           kCurtainGeojson, kCurtainKml};
  sim::KnownFolder known;
  const sim::InputFile file = sim::read_input(directory + "/" + kMapJson, kMaxMapBytes);
  const std::optional<nlohmann::json> json = map_json_of(file.bytes);
  if (!file.problem.empty())
    known.objection = "its map.json " + file.problem;
  else if (!json)
    known.objection = "its map.json is none that vegard wrote";
  if (json)
    for (const nlohmann::json& photo : (*json)["photos"])
      for (const char* stem : {"model", "residual"})
        names.insert(file_of(stem, photo["name"].get<std::string>()));
  known.has = [names = std::move(names)](const std::string& name) { return names.count(name) != 0; };
  return known;
}

sim::DirectoryKind map_kind() { return {"a map", look_at_map, {kMapJson}}; }

bool is_maxwellian(const MapResult& result) {
  return result.spectrum.kind == sim::ElectronSpectrum::Kind::maxwellian;
}

std::string precipitation_fits(const MapResult& result) {
  const RasterisedMap map = rasterised_map(result);
  const RasterGrid& raster = map.raster;
  std::vector<sim::FitsKeyword> keywords = {
      {"CTYPE1", "EAST", "feet in the site's tangent plane"},
      {"CUNIT1", "km", ""},
      {"CRPIX1", 1.0, ""},
      {"CRVAL1", raster.west_km, ""},
      {"CDELT1", raster.step_km, ""},
      {"CTYPE2", "NORTH", ""},
      {"CUNIT2", "km", ""},
      {"CRPIX2", 1.0, ""},
      {"CRVAL2", raster.south_km, ""},
      {"CDELT2", raster.step_km, ""},
      {"HEIGHTKM", sim::kFootAltitudeKm, "altitude of the feet"},
      {"SITELAT", result.scene.site.latitude_deg, "degrees north"},
      {"SITELONG", result.scene.site.longitude_deg, "degrees east"},
      {"PLANE1", std::string("energy flux, mW m-2") + (is_absolute(result) ? "" : ", relative"), ""},
      {"PLANE2", "characteristic energy E0, keV",
       is_maxwellian(result) ? "of Maxwellian electrons" : "of electrons of SPECTRUM"},
      {"PLANE3", "relative standard error of plane 1", ""},
      {"PLANE4", "standard error of ln(plane 2)", ""},
      {"PLANE5", "sensitivity: signal to noise of 1 mW m-2", "in a cell by itself"},
      {"FLUXCAL", is_absolute(result) ? "absolute" : "relative",
       is_absolute(result) ? "the sensor is calibrated" : "the sensor's scale is not known"},
      {"ORIGIN", "vegard " + sim::version(), ""}};
  if (!result.scene.site.time_utc.empty())
    keywords.push_back({"DATE-OBS", sim::in_utc(result.scene.site.time_utc), ""});
  if (!is_maxwellian(result))
    keywords.push_back(
        {"SPECTRUM", sim::spectrum_word(result.spectrum.kind), sim::spectrum_in_words(result.spectrum)});
  return sim::encode_fits(map.planes, keywords, "precipitation.fits");
}

void write_pictures(const sim::WholeDirectory& run, const MappedPhoto& photo) {
  const sim::FilmGeometry& film = photo.film;
  sim::Image model(film.columns, film.rows, {"R", "G", "B"}), residual = model;
  for (std::size_t i = 0; i < model.data.size(); ++i) {
    model.data[i] = photo.model[i] + photo.sky[i];
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    residual.data[i] = photo.sigma[i] > 0.0f ? photo.data[i] - model.data[i] : kUnknown;
  }
  const sim::ImageAttributes where = {
      {"version", sim::version()},
      {"film", fmt::format("cells of {} x {} pixels; the first begins at pixel ({}, {})", film.cell_width_px,
                           film.cell_height_px, film.x0_px, film.y0_px)}};
  sim::write_exr(run.file(file_of("model", photo.name)), model, where);
  sim::write_exr(run.file(file_of("residual", photo.name)), residual, where);
}

nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

void put_spectrum(const sim::ElectronSpectrum& spectrum, nlohmann::ordered_json& json) {
  json["spectrum"] = sim::spectrum_word(spectrum.kind);
  if (spectrum.kind == sim::ElectronSpectrum::Kind::gaussian) json["spread"] = spectrum.spread;
  if (spectrum.kind == sim::ElectronSpectrum::Kind::kappa) json["kappa"] = spectrum.kappa;
}

}  // namespace

std::string map_json(const MapResult& result, const std::vector<Curtain>& curtains,
                     const std::vector<QuantityVerdict>& verdicts, const MapRunFacts& facts) {
  nlohmann::ordered_json json;
  json["kind"] = "vegard map";
  json["version"] = sim::version();
  json["format"] = kMapFormat;
  json["command"] = facts.command;
  json["interrupted"] = result.interrupted;
  json["verdict_line"] = verdict_line(verdicts);
  for (const QuantityVerdict& v : verdicts)
    json["verdicts"].push_back({{"quantity", v.quantity},
                                {"verdict", trust_name(v.trust)},
                                {"value", v.value},
                                {"reason", v.reason}});
  json["chi2"] = result.chi2;
  json["values"] = result.values;
  json["chi2_per_value"] = result.chi2_per_value();
  json["chi2_without_aurora"] = result.chi2_without_aurora;
  json["model_error"] = result.scene.fit.model_error;
  json["prior"] = {{"sparsity", result.sparsity}, {"tried", nlohmann::ordered_json::array()}};
  for (const MapTrial& t : result.trials)
    json["prior"]["tried"].push_back(
        {{"sparsity", t.sparsity}, {"left_out_loss", t.left_out}, {"standard_error", t.error}});
  json["altitude_scale"] = result.altitude_scale;
  put_spectrum(result.spectrum, json);
  json["other_spectra"] = nlohmann::ordered_json::array();
  for (const OtherSpectrum& other : result.spectra) {
    nlohmann::ordered_json row;
    put_spectrum(other.spectrum, row);
    row["chi2_per_value"] = other.chi2_per_value;
    row["chi2_fall"] = other.better;
    row["is_open"] = other.is_open();
    json["other_spectra"].push_back(std::move(row));
  }
  json["known_with_errors"] = nlohmann::ordered_json::array();
  for (const MapNumber& n : result.numbers)
    json["known_with_errors"].push_back(
        {{"number", n.label}, {"value", n.value}, {"standard_error", n.error}, {"unit", n.unit}});
  const bool has_learnt = std::any_of(result.numbers.begin(), result.numbers.end(),
                                      [](const MapNumber& number) { return number.mode >= 0; });
  if (has_learnt) json["modes"] = result.scene.emission.modes;
  if (const std::vector<TablesCorrection> tables = map_corrections(result, curtains); !tables.empty())
    json["tables"] = corrections_json(tables);
  json["replicates"] = result.replicates.size();
  json["cells"] = result.grid.cells();
  json["energies_kev"] = result.energies_kev;
  json["flux_is_absolute"] = is_absolute(result);
  json["seed"] = result.scene.seed;
  json["photos"] = nlohmann::ordered_json::array();
  for (const MappedPhoto& photo : result.photos)
    json["photos"].push_back({{"name", photo.name},
                              {"width_px", photo.scene.camera.width},
                              {"height_px", photo.scene.camera.height},
                              {"latitude_deg", photo.scene.site.latitude_deg},
                              {"longitude_deg", photo.scene.site.longitude_deg},
                              {"chi2", photo.chi2},
                              {"values", photo.values},
                              {"gain", photo.gain},
                              {"pixels_per_cell", photo.film.cell_width_px}});
  json["curtains"] = nlohmann::ordered_json::array();
  for (const Curtain& curtain : curtains) {
    double flux = 0.0, ln = 0.0;
    for (const CurtainPoint& p : curtain.points) {
      flux += p.flux_mw_m2.value;
      ln += p.flux_mw_m2.value * std::log(p.energy_kev.value);
    }
    json["curtains"].push_back({{"length_km", curtain.length_km},
                                {"points", curtain.points.size()},
                                {"mean_energy_flux_mw_m2", flux / curtain.points.size()},
                                {"mean_energy_kev", flux > 0.0 ? std::exp(ln / flux) : sim::kNaN},
                                {"probability", finite_or_null(curtain.probability)}});
  }
  json["faint_curtains"] = facts.faint.size();
  json["diffuse_patches"] = std::count_if(facts.faint.begin(), facts.faint.end(),
                                          [](const Curtain& c) { return c.is_diffuse_patch; });
  json["inputs"] = nlohmann::ordered_json::array();
  for (const InputFile& input : facts.inputs)
    json["inputs"].push_back({{"role", input.role}, {"name", input.name}, {"sha256", input.sha256}});
  for (const auto& [name, how] : facts.decodings)
    json["decodings"].push_back({{"photo", name}, {"decoding", how}});
  return json.dump(2) + "\n";
}

void check_map_directory(const std::string& directory, bool overwrite) {
  sim::WholeDirectory(directory, overwrite, map_kind());
}

bool is_interrupted_map(const std::string& directory) {
  const sim::InputFile file = sim::read_input(directory + "/" + kMapJson, kMaxMapBytes);
  const std::optional<nlohmann::json> json = map_json_of(file.bytes);
  return json && json->contains("interrupted") && (*json)["interrupted"] == true;
}

std::string curtains_csv(const std::vector<Curtain>& curtains) {
  std::string csv =
      "curtain,point,east_km,north_km,distance_km,azimuth_deg,lower_border_km,energy_flux_mw_m2,energy_kev,"
      "width_km,lateral_error_km,distance_error_km,lower_border_error_km,energy_flux_error_mw_m2,"
      "energy_error_kev,width_error_km,border_in_view,at_edge,energy_limit,found_in,probability,diffuse\n";
  for (std::size_t c = 0; c < curtains.size(); ++c)
    for (std::size_t i = 0; i < curtains[c].points.size(); ++i) {
      const CurtainPoint& p = curtains[c].points[i];
      csv += std::to_string(c + 1) + "," + std::to_string(i + 1);
      for (const double value :
           {p.foot_km.east, p.foot_km.north, p.distance_km, p.azimuth_deg, p.lower_border_km.value,
            p.flux_mw_m2.value, p.energy_kev.value, p.width_km.value, p.lateral_error_km, p.distance_error_km,
            p.lower_border_km.error, p.flux_mw_m2.error, p.energy_kev.error, p.width_km.error})
        csv += "," + sim::csv_number(value);
      csv += fmt::format(",{:d},{:d},{}", p.border_in_view, p.at_edge, p.energy_limit);
      csv += "," + sim::csv_number(p.found_in) + "," + sim::csv_number(curtains[c].probability);
      csv += curtains[c].is_diffuse_patch ? ",1\n" : ",0\n";
    }
  return csv;
}

void write_map_run(const std::string& directory, bool overwrite, const MapResult& result,
                   const std::vector<Curtain>& curtains, const MapRunFacts& facts) {
  sim::WholeDirectory run(directory, overwrite, map_kind());
  const std::vector<QuantityVerdict> verdicts = map_verdicts(result, curtains);
  run.fill([&] {
    sim::write_whole(run.file(kMapJson), map_json(result, curtains, verdicts, facts));
    sim::write_whole(run.file("precipitation.fits"), precipitation_fits(result));
    sim::write_whole(run.file(kCurtainTable), curtains_csv(curtains));
    sim::write_whole(run.file(kFaintCurtainTable), curtains_csv(facts.faint));
    for (const MappedPhoto& photo : result.photos) write_pictures(run, photo);
    sim::write_whole(run.file("report.html"), map_page(result, curtains, verdicts, facts));
    if (facts.geojson)
      sim::write_whole(run.file(kCurtainGeojson),
                       curtains_geojson(result.scene, is_absolute(result), curtains));
    if (facts.kml) sim::write_whole(run.file(kCurtainKml), curtains_kml(result.scene, curtains));
    // Whatever is in it stands in the other files.
    if (facts.netcdf) sim::write_netcdf(map_dataset(run.temporary()), run.file(kMapNetcdf), false);
  });
}

}  // namespace vegard::fit
