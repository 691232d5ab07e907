#include "apps/commands/commands.h"

#include <cctype>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/options/direction_maps.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/refusals.h"
#include "apps/options/site_words.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/measurement/calibration_words.h"
#include "fit/measurement/camera_calibration.h"
#include "fit/measurement/same_lens_calibration.h"
#include "fit/photo/codec/picture_format.h"
#include "fit/photo/pointing/calibration_tables.h"
#include "fit/photo/pointing/direction_error.h"
#include "fit/photo/pointing/exchange/star_files.h"
#include "fit/report/calibration_plots.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

struct CalibrateOptions {
  fit::CalibrationRequest request;
  std::string at, residuals, json, plot, overlay, stars_out, axy_out;
  MapOptions maps;
  std::vector<std::string> site, inputs, times;
  bool same_lens = false, overwrite = false;
};

/// No output may take another's place, or that of an input.
void check_outputs(const CalibrateOptions& options) {
  const fit::CalibrationRequest& request = options.request;
  const std::pair<const char*, const std::string*> outputs[] = {
      {"--output", &request.output},   {"--residuals", &options.residuals},
      {"--json", &options.json},       {"--plot", &options.plot},
      {"--overlay", &options.overlay}, {"--stars-out", &options.stars_out},
      {"--axy-out", &options.axy_out}, {"--corr-out", &request.corr_out}};
  std::vector<std::string> inputs = options.inputs;
  inputs.insert(inputs.end(), {request.image, request.mask, request.camera, options.maps.azimuth_map,
                               options.maps.elevation_map, options.maps.skymap, request.wcs, request.acc});
  for (const auto& [key, file] : outputs) {
    for (const std::string& input : inputs)
      if (same_file(*file, input)) throw same_file_error(key, *file, "an input");
    for (const auto& [other_key, other] : outputs)
      if (std::string(key) > other_key && same_file(*file, *other))
        throw same_file_error(key, *file, other_key);
  }
}

/// Completes the request by the options that are words, and checks what concerns its outputs.
void read_words(CalibrateOptions& options) {
  fit::CalibrationRequest& request = options.request;
  if (options.inputs.size() > 1)
    throw usage_error("STARS", "several tables or pictures", "one, or --same-lens with several");
  if (!options.inputs.empty()) request.stars = options.inputs.front();
  if (options.times.size() > 1)
    throw usage_error("--time", "several times", "one, or --same-lens with several");
  if (!options.times.empty()) request.time = options.times.front();
  request.finds_points = !options.axy_out.empty();
  request.keeps_recognised = !options.stars_out.empty();
  if (!options.site.empty()) request.site = site_place(options.site);
  const MapOptions& maps = options.maps;
  request.flip_given = !maps.skymap_flip.empty();
  if (!request.wcs.empty() || !request.acc.empty()) {
    if (!maps.first().empty() || !maps.elevation_map.empty() ||
        (!request.wcs.empty() && !request.acc.empty()))
      throw usage_error(request.wcs.empty() ? "--acc" : "--wcs", "directions are given twice",
                        "one of --wcs, --acc, --skymap and --azimuth-map");
    request.flip = flip_of(maps);
  } else if (maps.any()) {
    KnownDirections known = maps_of(maps);
    std::string names = file_name_of(maps.first());
    if (!maps.elevation_map.empty() && maps.elevation_map != maps.azimuth_map)
      names += ", " + file_name_of(maps.elevation_map);
    request.maps = fit::KnownMaps{maps.first(), names, std::move(known.map), known.place};
  }
  fit::check_together(request);
  if (request.blind() && request.output.empty() &&
      !(options.residuals.empty() && options.json.empty() && options.plot.empty()))
    throw usage_error("--output", "residuals and plots are of a camera", "-o CAMERA.toml with them");
  if (!request.offset_px.empty() && request.stars.empty())
    throw usage_error("--offset", "no table of a crop", "STARS as well");
  if (!options.overlay.empty() && request.image.empty())
    throw usage_error("--overlay", "no picture to draw on", "--image with it");
}

/// "station.toml", "station.2.toml", "station.3.toml".
std::string output_of_picture(const std::string& output, std::size_t picture) {
  if (picture == 0) return output;
  const std::filesystem::path path(output);
  return (path.parent_path() /
          (path.stem().string() + "." + std::to_string(picture + 1) + path.extension().string()))
      .string();
}

/// Whether a file is named as a picture is; others are tables of stars.
bool is_named_as_picture(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const fit::PictureFormat& format : fit::picture_formats())
    for (const std::string& ending : format.endings)
      if (name.size() > ending.size() &&
          name.compare(name.size() - ending.size(), ending.size(), ending) == 0)
        return true;
  return false;
}

/// The requests of the pictures or tables that have one lens.
std::vector<fit::CalibrationRequest> requests_of(const CalibrateOptions& options) {
  const MapOptions& maps = options.maps;
  const fit::CalibrationRequest& common = options.request;
  if (options.inputs.size() < 2)
    throw usage_error("--same-lens", "one picture alone", "two or more pictures or tables of one camera");
  if (!common.image.empty() || !common.camera.empty() || !common.by_hand.empty() || !common.wcs.empty() ||
      !common.acc.empty() || maps.any())
    throw usage_error("--same-lens", "its pictures are given by their names alone",
                      "calibrate A B C --same-lens, without --image, --camera, --star and maps");
  if (common.output.empty())
    throw usage_error("--output", "nothing to write the cameras to", "-o CAMERA.toml");
  if (!options.json.empty() || !options.plot.empty() || !options.overlay.empty() ||
      !options.stars_out.empty() || !options.axy_out.empty() || !common.corr_out.empty() ||
      !common.date.empty() || common.level)
    throw usage_error("--same-lens", "outputs of one picture", "-o and --residuals alone");
  if (options.times.size() > 1 && options.times.size() != options.inputs.size())
    throw usage_error("--time",
                      std::to_string(options.times.size()) + " times for " +
                          std::to_string(options.inputs.size()) + " pictures",
                      "a time for each, in their order, or none where they say it themselves");
  if (options.times.size() == 1)
    throw usage_error("--time", "one time for several pictures", "a time for each, in their order");
  std::vector<fit::CalibrationRequest> requests;
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    fit::CalibrationRequest one = common;
    (is_named_as_picture(options.inputs[i]) ? one.image : one.stars) = options.inputs[i];
    if (!options.times.empty()) one.time = options.times[i];
    if (!options.site.empty()) one.site = site_place(options.site);
    requests.push_back(one);
  }
  return requests;
}

/// Several pictures with one lens.
int run_same_lens(const CalibrateOptions& options) {
  const std::vector<fit::CalibrationRequest> requests = requests_of(options);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < requests.size(); ++i)
    names.push_back(output_of_picture(options.request.output, i));
  for (const std::string& input : options.inputs)
    for (const std::string& name : names)
      if (same_file(name, input)) throw same_file_error("--output", name, "an input");
  std::vector<std::string> claimed = names;
  claimed.push_back(options.residuals);
  sim::WholeFiles outputs(claimed, options.overwrite);
  const std::vector<fit::CameraCalibration> found = fit::calibrate_same_lens(requests, said());
  std::string residuals;
  bool is_told = false, all = true;
  for (std::size_t i = 0; i < found.size(); ++i) {
    all = all && found[i].calibration;
    if (!found[i].calibration) continue;
    const fit::Calibration& calibration = *found[i].calibration;
    outputs.write(names[i], fit::camera_toml(calibration, found[i].origin));
    const std::string table = fit::residuals_csv(calibration);
    residuals += is_told ? table.substr(table.find('\n') + 1) : table;
    if (!is_told) {
      say("%s\n", "the pictures together:");
      fit::tell_calibration(found[i], said());
    } else {
      say("%s: %s\n", file_name_of(options.inputs[i]).c_str(), fit::rms_line(calibration).c_str());
    }
    is_told = true;
  }
  if (!options.residuals.empty()) outputs.write(options.residuals, residuals);
  outputs.commit();
  for (const std::string& name : outputs.written()) say("%s\n", name.c_str());
  return all ? good : doubted;
}

int run_calibrate(CalibrateOptions options) {
  end_at_once_when_interrupted();
  if (options.same_lens) return run_same_lens(options);
  const PlotFormat format = plot_format(options.plot, "--plot");
  check_outputs(options);
  read_words(options);
  const fit::CalibrationRequest& request = options.request;
  sim::WholeFiles outputs({request.output, options.residuals, options.json, options.plot, options.overlay,
                           options.stars_out, options.axy_out, request.corr_out},
                          options.overwrite);
  const fit::CameraCalibration found = fit::calibrate_camera(request, said_with_progress());
  // All is made before anything gets its name.
  if (!options.axy_out.empty())
    outputs.write(options.axy_out, fit::encode_star_list(found.points, found.frame, options.axy_out));
  if (const std::string table = fit::recognised_table(found); !table.empty())
    outputs.write(options.stars_out, table);
  if (found.calibration) {
    const fit::Calibration& calibration = *found.calibration;
    outputs.write(request.output, fit::camera_toml(calibration, found.origin));
    if (!options.residuals.empty()) outputs.write(options.residuals, fit::residuals_csv(calibration));
    if (!request.corr_out.empty())
      outputs.write(request.corr_out, fit::encode_star_pairs(calibration, found.sky, request.corr_out));
    if (!options.json.empty()) outputs.write(options.json, fit::calibration_json(calibration, found.origin));
    if (format != PlotFormat::none)
      outputs.write(options.plot, plot_bytes(fit::residual_plot(calibration), format));
    if (!options.overlay.empty())
      outputs.write(options.overlay, fit::star_overlay(calibration, *found.photo));
  }
  if (!found.calibration && !options.overlay.empty() && found.blind && found.blind->place)
    outputs.write(options.overlay, fit::star_overlay(found.blind->picture.recognition, *found.photo));
  outputs.commit();
  if (voice().is_json) json_answer() = fit::answer_json(found);
  json_answer()["outputs"] = json_names(outputs.written());
  if (found.calibration) {
    fit::tell_calibration(found, said());
    const fit::DirectionErrors errors = fit::direction_errors(*found.calibration);
    say("%s\n", fit::words_of(errors).c_str());
    if (voice().is_json)
      json_answer()["direction_error_deg"] = {{"typical", json_number(errors.typical_deg)},
                                              {"worst", json_number(errors.worst_deg)}};
  }
  for (const std::string& name : outputs.written()) say("%s\n", name.c_str());
  return found.has_answer ? good : doubted;
}

void add_options(const Command& command, CalibrateOptions& options) {
  fit::CalibrationRequest& request = options.request;
  command.option(
      "STARS", options.inputs,
      "A table of recognised stars (x_px, y_px, and azimuth_deg with elevation_deg or zenith_deg, ra_deg "
      "with dec_deg, or star), a .corr file of solve-field, or its .axy list of points of light (with "
      "--camera). Without it stars are found in --image, blindly if there is no --camera. With --same-lens: "
      "several pictures or tables");
  command.option("-o,--output", request.output, "The camera to write: a scene file with [camera] and [site]")
      .type_name("CAMERA.toml");
  command.option("--image", request.image,
                 "The picture of the stars: gives its size, and time, site and focal length from its "
                 "metadata if no option does");
  add_at_option(command, options.at);
  command
      .option(
          "--time", options.times,
          "Beginning of the exposure, ISO 8601 in UTC or with a zone (2014-02-21T20:30:40+01:00); the stars "
          "are those of its middle, by --exposure or else the picture's metadata. With --same-lens one for "
          "each picture, with commas between them")
      .delimiter(',')
      .one_an_occurrence()
      .type_name("TIME");
  command
      .option("--exposure", request.exposure_s,
              "Exposure time in seconds (default: as the picture says; 0: --time is the middle itself)")
      .finite_range(0.0, 1e5)
      .type_name("S");
  command.flag(
      "--same-lens", options.same_lens,
      "Fit one lens to several pictures of a camera: calibrate A B C --same-lens -o CAMERA.toml writes "
      "CAMERA.toml, CAMERA.2.toml, CAMERA.3.toml");
  add_site_option(command, options.site);
  command
      .option(
          "--star", request.by_hand,
          "A star in --image and its place in pixels, where stars are not recognised blindly: Vega=812,344. "
          "Two or more, with --time and --site; with --camera, whose lens is taken")
      .one_an_occurrence()
      .type_name("NAME=X,Y");
  command.option("--camera", request.camera, "A rough camera, or an earlier one, to start from")
      .type_name("CAMERA.toml");
  command
      .option("--free", request.free,
              "Fit only these of --camera, and hold the rest: rotation, centre, focal, aspect, radial, "
              "decentring")
      .delimiter(',')
      .one_an_occurrence();
  command.option("--lens", request.lens,
                 "Fit only this lens: pinhole, equidistant, equisolid, stereographic, orthographic or "
                 "polynomial (default: the simplest that the stars support)");
  command.option("--terms", request.terms, "With --lens: fit only these of k1, k2, k3, p, aspect; or none");
  command.flag("--hold-centre", request.centre_held, "Hold the lens's centre in the middle of the picture");
  command.flag("--keep-all", request.keeps_all, "Leave out no star, however far off it is");
  command.option("--size", request.size_px, "The picture's size in pixels, where --image is not given")
      .delimiter(',')
      .expected(2)
      .type_name("W,H");
  command.option("--first-pixel", request.first_pixel,
                 "Coordinate of the first pixel's centre in the table (default: 0.5, and 1 for .corr files)");
  command
      .option("--offset", request.offset_px,
              "Place of the table's upper left corner in the picture, if the table is of a crop")
      .delimiter(',')
      .expected(2)
      .type_name("X,Y");
  command.flag("--no-refraction", request.vacuum,
               "Compute places of stars, given by name or right ascension, without refraction by the air");
  command.option("--centre", request.centre_px, "The lens's centre in the picture, in place of --camera's")
      .delimiter(',')
      .expected(2)
      .type_name("X,Y");
  command
      .option("--twist", request.twist_deg,
              "Finding stars: how far --camera may be rotated about its axis, in degrees (default: 5; 180: "
              "any angle)")
      .range(0.0, 180.0);
  command
      .option("--shift", request.shift_px,
              "Finding stars: largest error of the centre, in pixels (default: 12)")
      .range(0.0, 200.0);
  command
      .option("--scale", request.scale_percent,
              "Finding stars: largest error of focal_px, in per cent (default: 0)")
      .range(0.0, 50.0);
  command
      .option("--radius", request.radius_px,
              "Finding stars: largest distance of a point of light from its star at first, in pixels "
              "(default: 12)")
      .range(2.5, 500.0);
  command
      .option(
          "--catalogue-magnitude", request.faintest,
          "Finding stars: magnitude of the faintest (default: 4, and deeper where fainter stars are seen)")
      .range(-2.0, 6.0);
  command
      .option("--min-elevation", request.min_elevation_deg,
              "Finding stars: elevation of the lowest, in degrees (default: 5)")
      .range(-1.0, 90.0);
  command
      .option("--signal", request.min_signal,
              "Finding stars: signal-to-noise ratio of the faintest point of light (default: 4)")
      .range(1.0, 1e6);
  command.option("--mask", request.mask, "An image of the picture's size: white = look for stars there");
  add_decoding_option(command, request.decoding, SceneOfDecoding::none);
  add_map_options(command, options.maps);
  command
      .option("--wcs", request.wcs,
              "Use Astrometry.net's solution of the picture in place of stars (needs --time and --site)")
      .type_name("FIELD.wcs");
  command
      .option("--acc", request.acc, "Use a camera of AIDA_tools in place of stars (needs --size or --image)")
      .type_name("FILE.acc");
  command.option("--acc-line", request.acc_line, "Line of that file, from 1, if it has several cameras");
  command
      .option("--axy-out", options.axy_out,
              "Write the points of light of --image for solve-field (X, Y, FLUX)")
      .type_name("OUT.axy");
  command
      .option("--corr-out", request.corr_out,
              "Write the stars used as solve-field does: observed and catalogue positions")
      .type_name("OUT.corr");
  command.flag("--no-metadata", request.no_metadata,
               "Do not take time, site and focal length from the picture's metadata");
  command
      .option("--stars-out", options.stars_out,
              "Write the stars recognised in --image, with right ascension and declination, as a table that "
              "this command reads")
      .type_name("STARS.csv");
  command
      .option(
          "--date", request.date,
          "With --image and --site, the time unknown: date of the evening; lists the night's possible times")
      .type_name("YYYY-MM-DD");
  command.flag("--level", request.level, "With --date: assume that the camera was level");
  command.option("--residuals", options.residuals, "Write the stars' residuals").type_name("OUT.csv");
  command
      .option(
          "--json", options.json,
          "Write lenses, numbers, correlations and stars; without a file name, print them in place of words")
      .expected(0, 1)
      .type_name("OUT.json");
  command.option("--plot", options.plot, "Draw the residuals").type_name("OUT.svg|OUT.png");
  command.option("--overlay", options.overlay, "Draw the stars on the picture").type_name("OUT.png");
  command.flag("--overwrite", options.overwrite, "Replace outputs that exist");
}

}  // namespace

void add_calibrate_command(Program& program) {
  const auto options = std::make_shared<CalibrateOptions>();
  const Command command = program.add(
      "calibrate",
      "Find a camera's pointing, lens and distortion from the stars in its picture, or from maps of "
      "its directions");
  add_options(command, *options);
  command.runs([options, json = command.option_of_name("--json")] {
    if (json.given() && options->json.empty()) voice().is_json = true;
    options->request.image = picture_at(options->request.image, options->at);
    return run_calibrate(*options);
  });
}

}  // namespace vegard::apps
