#include "apps/commands/commands.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/photo/direction_map_file.h"
#include "fit/photo/pointing/exchange/aida_camera.h"
#include "fit/photo/pointing/exchange/sip_wcs.h"
#include "sim/base/file/whole_file.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/direction_map.h"
#include "sim/view/sky/star_place.h"

namespace vegard::apps {
namespace {

struct DirectionsRequest {
  SceneOptions scene;
  std::string output;
  double reach_deg = 60.0;
  int threads = 0;
  bool overwrite = false;
};

/// What another program reads, and how far it is from the camera.
struct OtherCamera {
  std::string bytes, words;
  std::vector<std::pair<std::string, double>> numbers;  ///< how far, with units in their names
};

OtherCamera other_camera(const DirectionsRequest& options, const sim::Scene& scene,
                         const std::string& extension) {
  const std::optional<double> julian_date = sim::julian_date(scene.site.time_utc);
  const sim::Camera camera = sim::in_own_pixels(scene.camera);
  if (extension == ".acc") {
    const fit::AidaFit fit = placing_errors(scene, [&] { return fit::aida_of_camera(camera, julian_date); });
    return {
        fit::encode_aida(fit.camera),
        fmt::format(
            "AIDA's lens {}: rms {:.3f} px, the largest {:.3f} px, over {} places, {:.0f} % of the picture",
            fit.camera.model, fit.rms_px, fit.largest_px, fit.points, 100.0 * fit.share),
        {{"rms_px", fit.rms_px}, {"largest_px", fit.largest_px}, {"share_of_picture", fit.share}}};
  }
  if (!julian_date || !sim::is_latitude_given(scene) || !sim::is_longitude_given(scene))
    throw with_place(sim::Error(sim::ErrorKind::scene, "where stars are depends on place and time")
                         .file(scene.file)
                         .key("site.time_utc")
                         .expected("time_utc, latitude_deg and longitude_deg in [site]"),
                     scene);
  const sim::Observer observer{scene.site.latitude_deg, scene.site.longitude_deg, scene.site.altitude_m,
                               true};
  const fit::SipFit fit = placing_errors(
      scene, [&] { return fit::sip_of_camera(camera, observer, *julian_date, options.reach_deg); });
  const std::string words = fmt::format(
      "SIP of order {}: rms {:.3f} px, the largest {:.3f} px, over {} places within {:g} deg of the middle, "
      "{:.0f} % of the picture",
      fit.wcs.a.order, fit.rms_px, fit.largest_px, fit.points, options.reach_deg, 100.0 * fit.share);
  return {fit::encode_sip_wcs(fit.wcs, words, options.output),
          words,
          {{"rms_px", fit.rms_px}, {"largest_px", fit.largest_px}, {"share_of_picture", fit.share}}};
}

/// One EXR, or a FITS file each for azimuth and elevation.
std::vector<std::string> output_names(const std::string& output) {
  const std::filesystem::path path(output);
  const std::string extension = path.extension().string();
  if (extension == ".exr" || extension == ".wcs" || extension == ".acc") return {output};
  if (extension != ".fits" && extension != ".fit")
    throw usage_error("--output", "'" + output + "' cannot hold angles",
                      "a name that ends in .exr, .fits, .wcs or .acc");
  const std::string stem = (path.parent_path() / path.stem()).string();
  return {stem + "_az" + extension, stem + "_el" + extension};
}

void run_directions(const DirectionsRequest& options) {
  end_at_once_when_interrupted();
  const sim::Scene scene = scene_of(options.scene);
  const std::vector<std::string> names = output_names(options.output);
  for (const std::string& name : names)
    for (const std::string& input : {options.scene.file, options.scene.camera_file})
      if (same_file(name, input)) throw same_file_error("--output", name, "an input");
  sim::WholeFiles files(names, options.overwrite);
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (extension == ".wcs" || extension == ".acc") {
    const OtherCamera other = other_camera(options, scene, extension);
    files.write(names[0], other.bytes);
    files.commit();
    json_answer() = {{"outputs", json_names(names)}, {"words", other.words}};
    for (const auto& [key, value] : other.numbers) json_answer()[key] = json_number(value);
    say("%s: %s\n", names[0].c_str(), other.words.c_str());
    return;
  }
  ProgressBar bar("directions");
  constexpr double kShareOfDirections = 0.6;  // the rest is writing
  const sim::DirectionMap map = sim::direction_map(
      scene.camera, options.threads, [&](double share) { bar.update(kShareOfDirections * share); });
  bar.update(kShareOfDirections, "writing");
  if (names.size() == 1) {
    files.write(names[0], fit::encode_direction_map(map, names[0]));
  } else {
    const fit::FitsMaps maps = fit::encode_fits_maps(map);
    files.write(names[0], maps.azimuth);
    files.write(names[1], maps.elevation);
  }
  files.commit();
  bar.finish();
  std::size_t somewhere = 0;
  for (const float elevation : map.elevation_deg) somewhere += std::isfinite(elevation) ? 1 : 0;
  json_answer() = {{"outputs", json_names(names)},
                   {"width_px", map.width},
                   {"height_px", map.height},
                   {"pixels_with_a_direction", somewhere}};
  for (const std::string& name : names)
    say("%s: %d x %d pixels, %zu of which look somewhere\n", name.c_str(), map.width, map.height, somewhere);
}

}  // namespace

void add_directions_command(Program& program) {
  const auto options = std::make_shared<DirectionsRequest>();
  const Command command =
      program.add("directions", "Write azimuth and elevation of every pixel of a scene's camera");
  add_scene_options(command, options->scene);
  command
      .option("-o,--output", options->output,
              "The maps to write: MAPS.fits gives MAPS_az.fits and MAPS_el.fits; .wcs (Astrometry.net) and "
              ".acc (AIDA_tools) are approximated as closely as they can be")
      .required()
      .type_name("MAPS.exr|.fits|.wcs|.acc");
  command
      .option("--reach-deg", options->reach_deg,
              "With .wcs: angle from the picture's middle up to which it is fitted")
      .range(1.0, 80.0)
      .shows_default();
  add_threads_option(command, options->threads);
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] {
    run_directions(*options);
    return good;
  });
}

}  // namespace vegard::apps
