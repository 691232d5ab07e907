#include "apps/commands/commands.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands/direction_profile.h"
#include "apps/commands/keogram.h"
#include "apps/options/direction_maps.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/photographs.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "apps/output/terminal.h"
#include "fit/measure/line_brightness.h"
#include "fit/measure/profile.h"
#include "fit/measure/profile_bins.h"
#include "fit/photo/photo.h"
#include "fit/report/netcdf/table_dataset.h"
#include "fit/report/plot/plot.h"
#include "fit/report/profile_plot.h"
#include "fit/report/table/profile_csv.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/image.h"
#include "sim/scene/file/camera_file.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/freedom/keyframes.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/value_check.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::apps {
namespace {

/// As given on the command line: what is empty there follows from the scene.
struct ProfileRequest {
  std::string image, output, mask, scene, camera, plot;
  std::vector<std::string> filters;
  std::vector<std::string> images, keogram;  ///< image: the only one of a profile
  std::string times, at;
  std::vector<int> roi_px;
  std::optional<int> bands;
  std::string decoding;
  MapOptions maps;
  SectorOptions sectors;
  bool overwrite = false, lines = false, no_metadata = false;
};

/// Errors of the region and the bands name the scene's keys; on the command line they are options.
template <typename Call>
auto naming_options(const ProfileRequest& options, const std::optional<sim::Scene>& scene, const Call& call) {
  try {
    return call();
  } catch (const sim::Error& error) {
    const std::string& key = error.details().key;
    const bool is_region = key == "fit.roi_px" && !options.roi_px.empty();
    if (!is_region && !(key == "fit.bands" && options.bands)) throw scene ? with_place(error, *scene) : error;
    throw sim::Error(error).kind(sim::ErrorKind::usage).key(is_region ? "--roi" : "--bands");
  }
}

/// With --overwrite a slip of the pen would cost the photograph.
void check_outputs(const ProfileRequest& options) {
  if (same_file(options.output, options.plot))
    throw same_file_error("--plot", options.plot, "the table's name");
  std::vector<std::string> inputs = {options.image,
                                     options.mask,
                                     options.scene,
                                     options.camera,
                                     options.maps.azimuth_map,
                                     options.maps.elevation_map,
                                     options.maps.skymap};
  for (const fit::FilterFile& filter : filter_files(options.filters)) inputs.push_back(filter.file);
  for (const std::string& input : inputs) {
    if (same_file(options.output, input)) throw same_file_error("--output", options.output, "an input");
    if (same_file(options.plot, input)) throw same_file_error("--plot", options.plot, "an input");
  }
}

/// What to expect of it: lines closer than that are one to the sensor.
void print_resolution(const sim::Scene& scene) {
  const sim::SensorResponse response(scene);
  json_answer()["windows"] = Json::array();
  for (const double nm : scene.emission.lines) {
    const double width_nm = sim::resolving_kernel(response, nm).fwhm_nm;
    say("%.1f nm: the sensor's window there is %.0f nm wide\n", nm, width_nm);
    json_answer()["windows"].push_back({{"wavelength_nm", nm}, {"width_nm", json_number(width_nm)}});
  }
}

fit::Photo photo_of(const ProfileRequest& options, const fit::Decoding& decoding,
                    const std::optional<sim::Scene>& scene) {
  const sim::Scene* const known = scene ? &*scene : nullptr;
  if (options.image.empty() == options.filters.empty())
    throw usage_error("IMAGE", options.image.empty() ? "no photograph is given" : "--line is given as well",
                      "a photograph, or --line NM=FILE for each of its filters");
  if (options.filters.empty()) return fit::read_photo(options.image, decoding, known);
  if (options.lines) check_filters(*scene);
  const bool ordered = scene && sim::sees_through_filters(*scene);
  return fit::read_filters(filter_files(options.filters),
                           ordered ? scene->emission.lines : std::vector<double>{}, decoding, known);
}

/// As the scene's camera sees it.
fit::ElevationOfPixel elevation_of_pixel(const sim::Scene& scene) {
  return [camera = scene.camera](double x_px, double y_px) {
    return sim::direction_of_pixel(camera, x_px, y_px).elevation_deg;
  };
}

/// By a map of the picture's size, of the pixel that the point is in.
fit::ElevationOfPixel elevation_of_pixel(sim::DirectionMap map) {
  return [map = std::move(map)](double x_px, double y_px) {
    const int x = std::clamp(static_cast<int>(x_px), 0, map.width - 1);
    const int y = std::clamp(static_cast<int>(y_px), 0, map.height - 1);
    return static_cast<double>(map.elevation_deg[map.index(x, y)]);
  };
}

/// What there is to write and to say.
struct Measured {
  std::string csv;
  fit::Plot plot;
  std::string words;
  std::vector<std::string> details;
};

/// Of an observer above the air.
std::optional<double> limb_observer_km(const std::optional<sim::Scene>& scene) {
  if (!scene || 1e-3 * scene->site.altitude_m < sim::kLimbObserverKm) return std::nullopt;
  sim::require_earth(*scene, "the altitude of a tangent point");
  return 1e-3 * scene->site.altitude_m;
}

fit::LineBrightness lines_of(const sim::Scene& scene, const fit::Photo& photo, const fit::Profile& profile) {
  return placing_errors(scene, [&] {
    fit::LineBrightness lines = fit::line_brightness(scene, profile);
    if (!photo.floating && photo.filters.empty() && scene.sensor.matrix_rule != sim::MatrixRule::none)
      tell(
          "vegard: the picture's file has cut off what its colour matrix put out of gamut, so that lines of "
          "little light are wrong (sensor.matrix_rule = \"none\" has them right)\n");
    return lines;
  });
}

/// Across a loop, or away from the limb, with the noise that the scene says; of a grey sensor one channel.
fit::Profile sun_profile(sim::Scene scene, const fit::Photo& photo, const fit::Region& region, int bands) {
  scene.fit.bands = bands;
  return fit::measured_profile(scene, photo,
                               std::make_shared<const fit::BinGrid>(fit::profile_bins(scene, region)));
}

Measured measure_bands(const ProfileRequest& options, const std::optional<sim::Scene>& scene,
                       const fit::Photo& photo, const fit::Region& region) {
  fit::ElevationOfPixel elevation;
  if (options.maps.any()) {
    elevation = elevation_of_pixel(
        known_directions(options.maps, nullptr, photo.linear.width, photo.linear.height, photo.file_name)
            ->map);
  } else if (scene) {
    elevation = elevation_of_pixel(*scene);
  }
  const int bands =
      options.bands.value_or(scene ? scene->fit.bands : std::min(sim::Fit{}.bands, region.width));
  const bool is_solar = scene && (scene->fit.profile_along == sim::ProfileAlong::loop ||
                                  scene->fit.profile_along == sim::ProfileAlong::limb);
  const fit::Profile profile =
      is_solar ? sun_profile(*scene, photo, region, bands) : fit::extract_profile(photo, region, bands);
  std::optional<fit::LineBrightness> lines;
  if (options.lines && is_solar)
    throw usage_error(
        "--lines", "lines are measured along columns only",
        "no fit.profile_along = \"" + sim::word_of(scene->fit.profile_along) + "\" in the scene");
  if (options.lines) lines = lines_of(*scene, photo, profile);
  return {fit::profile_csv(photo, profile, elevation, lines ? &*lines : nullptr, limb_observer_km(scene)),
          fit::profile_plot(photo, profile, elevation),
          std::to_string(profile.bands) + " bands of " + std::to_string(profile.rows) +
              (is_solar ? " positions" : " rows"),
          {}};
}

Measured measure_sectors(const ProfileRequest& options, const std::optional<sim::Scene>& scene,
                         const fit::Photo& photo, const fit::Region& region) {
  const std::optional<KnownDirections> known = known_directions(
      options.maps, scene ? &*scene : nullptr, photo.linear.width, photo.linear.height, photo.file_name);
  if (!known)
    throw usage_error("--azimuths", "where the pixels look is not known",
                      "--azimuth-map MAPS, or --scene with the camera");
  const MeasuredDirections measured =
      measure_directions(options.sectors, photo, region, *known, limb_observer_km(scene));
  return {measured.csv, measured.plot, measured.words, measured.details};
}

void run_profile(const ProfileRequest& options) {
  end_at_once_when_interrupted();
  const PlotFormat format = plot_format(options.plot, "--plot");
  check_outputs(options);
  check_sector_options(options.sectors);
  if (options.lines && options.sectors.asked())
    throw usage_error("--lines", "lines are measured along columns only",
                      "no --azimuths or --directions with it");
  if (options.lines && options.scene.empty())
    throw usage_error("--lines", "no sensor is known", "--scene with the sensor, its gain and the lines");
  std::optional<sim::Scene> scene;
  if (!options.scene.empty()) {
    scene = sim::still_scene(sim::read_scene(options.scene));
    if (!options.camera.empty()) sim::take_camera(*scene, options.camera);
    const std::string image =
        options.filters.empty() ? options.image : filter_files(options.filters).front().file;
    if (!options.no_metadata && !image.empty()) take_from_photograph(*scene, image, {});
  }
  const sim::Fit defaults = scene ? scene->fit : sim::Fit{};

  const fit::Decoding decoding = decoding_of(options.decoding, defaults.decoding, scene ? &*scene : nullptr);
  if (decoding == fit::Decoding::sensor && !scene)
    throw usage_error("--decoding", "no scene says what the sensor is", "--scene SCENE with it");
  fit::Photo photo = photo_of(options, decoding, scene);
  if (scene) check_camera_size(*scene, photo.linear.width, photo.linear.height, photo.file_name);
  if (!options.mask.empty()) fit::apply_mask(photo, options.mask);

  std::array<int, 4> roi_px = defaults.roi_px;
  for (std::size_t i = 0; i < options.roi_px.size(); ++i) roi_px[i] = options.roi_px[i];
  const Measured measured = naming_options(options, scene, [&] {
    const fit::Region region = fit::checked_region(roi_px, photo.linear.width, photo.linear.height);
    return options.sectors.asked() ? measure_sectors(options, scene, photo, region)
                                   : measure_bands(options, scene, photo, region);
  });
  // The plot is made before anything is written: what fails here leaves nothing behind.
  const std::string plot = plot_bytes(measured.plot, format);
  // Both places are claimed before either is filled.
  sim::WholeFiles outputs({options.output, options.plot}, options.overwrite);
  if (std::filesystem::path(options.output).extension() == ".nc")
    fit::table_dataset(measured.csv, options.output)
        .write(outputs.file(options.output).temporary(), options.output);
  else
    outputs.write(options.output, measured.csv);
  outputs.write(options.plot, plot);
  outputs.commit();

  json_answer() = {{"outputs", json_names(outputs.written())},
                   {"photo", photo.file_name},
                   {"width_px", photo.linear.width},
                   {"height_px", photo.linear.height},
                   {"decoding", photo.decoding},
                   {"words", measured.words},
                   {"details", measured.details}};
  say("%s: %s pixels, decoding: %s\n", photo.file_name.c_str(),
      sim::size_text(photo.linear.width, photo.linear.height).c_str(), photo.decoding.c_str());
  say("%s: %s\n", options.output.c_str(), measured.words.c_str());
  for (const std::string& line : measured.details) say("  %s\n", line.c_str());
  if (!options.plot.empty()) say("%s\n", options.plot.c_str());
  if (options.lines) print_resolution(*scene);
}

ProfileRequest of_one_image(const ProfileRequest& options) {
  if (options.images.size() > 1)
    throw usage_error("IMAGE", "a profile is of one image", "one, or --keogram OUT with it");
  if (options.output.empty()) throw usage_error("--output", "no table is named", "-o OUT.csv");
  if (!options.times.empty()) throw usage_error("--times", "a profile needs none", "--keogram OUT with it");
  ProfileRequest one = options;
  PhotoWords words;
  if (!options.images.empty()) words.file = options.images.front();
  words.filters = options.filters;
  words.at = options.at;
  words = with_frames_chosen(words);
  one.image = words.file;
  one.filters = words.filters;
  return one;
}

KeogramOptions keogram_options(const ProfileRequest& options) {
  const bool wants_profiles = !options.output.empty() || !options.plot.empty() || options.bands ||
                              options.lines || options.sectors.asked() || !options.filters.empty();
  if (wants_profiles)
    throw usage_error("--keogram", "it takes the place of a profile",
                      "no --output, --plot, --bands, --line, --lines, --azimuths or --directions with it");
  if (!options.at.empty()) throw usage_error("--at", "a keogram has all frames of a file", "no --at with it");
  check_sector_options(options.sectors);
  KeogramOptions keogram;
  keogram.images = options.images;
  keogram.outputs = options.keogram;
  keogram.mask = options.mask;
  keogram.scene = options.scene;
  keogram.decoding = options.decoding;
  keogram.times = options.times;
  keogram.roi_px = options.roi_px;
  keogram.maps = options.maps;
  keogram.overwrite = options.overwrite;
  return keogram;
}

}  // namespace

void add_profile_command(Program& program) {
  const auto options = std::make_shared<ProfileRequest>();
  const Command command =
      program.add("profile", "Measure a photograph: mean light per row and band, as CSV and as a plot");
  command.option("IMAGE", options->images,
                 "A photograph of any format that is read; with --keogram a list of them");
  add_at_option(command, options->at);
  add_filter_option(command, options->filters);
  command.option("-o,--output", options->output, "The table to write: netCDF if it ends in .nc, else CSV")
      .type_name("OUT.csv|.nc");
  command
      .option("--keogram", options->keogram,
              "A keogram of all images in place of a profile of one (see vegard keogram)")
      .one_an_occurrence()
      .type_name("OUT.png|.svg|.exr|.csv|.nc");
  command.option("--times", options->times, "With --keogram: a table of the times, lines of FILE,TIME")
      .type_name("TIMES.csv");
  command.option("--roi", options->roi_px, "Region of interest in pixels (default: the scene's, or all)")
      .delimiter(',')
      .expected(4)
      .type_name("X,Y,W,H");
  command.option("--bands", options->bands, "Equal column strips (default: the scene's, or 24)");
  command.option("--mask", options->mask, "An image of the same size: white = use");
  command.option(
      "--scene", options->scene,
      "A scene whose camera took the photograph: adds elevations, or its profiles across a loop or from the "
      "Sun's limb");
  command.option("--camera", options->camera, "Take [camera] and [site] from this file (needs --scene)")
      .needs("--scene")
      .type_name("CAMERA.toml");
  command.flag("--lines", options->lines,
               "Add rayleighs of the scene's lines, by its sensor, gain and sky (needs --scene)");
  add_map_options(command, options->maps);
  add_sector_options(command, options->sectors);
  add_decoding_option(command, options->decoding);
  add_no_metadata_option(command, options->no_metadata);
  command.option("--plot", options->plot, "Draw the profiles").type_name("OUT.svg|OUT.png");
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] {
    if (options->keogram.empty())
      run_profile(of_one_image(*options));
    else
      run_keogram(keogram_options(*options));
    return good;
  });
}

}  // namespace vegard::apps
