#include "apps/commands/keogram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/picture_lists.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "apps/output/terminal.h"
#include "fit/measure/keogram.h"
#include "fit/photo/photo.h"
#include "fit/photo/region.h"
#include "fit/report/keogram_plot.h"
#include "fit/report/netcdf/table_dataset.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/utc_time.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/freedom/keyframes.h"

namespace vegard::apps {
namespace {

/// Of the picture's width, where nothing says how wide the strip is to be.
constexpr int kUsualStripShare = 50;

enum class OutputKind { table, netcdf, image, plot };

OutputKind output_kind(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension == ".csv") return OutputKind::table;
  if (extension == ".nc") return OutputKind::netcdf;
  if (extension == ".exr") return OutputKind::image;
  if (extension == ".png" || extension == ".svg") return OutputKind::plot;
  throw usage_error("--output", "'" + file + "' names no kind of keogram",
                    "a name that ends in .png, .svg, .exr, .csv or .nc");
}

void check_outputs(const KeogramOptions& options, const std::vector<std::string>& images) {
  std::vector<std::string> inputs = images;
  for (const std::string& input : {options.mask, options.scene, options.times, options.maps.azimuth_map,
                                   options.maps.elevation_map, options.maps.skymap})
    inputs.push_back(input);
  std::vector<std::pair<std::string, std::string>> outputs;
  for (const std::string& output : options.outputs) {
    output_kind(output);  // refuses what it does not know
    outputs.emplace_back("--output", output);
    protect_outputs(outputs, inputs);
  }
}

fit::Region region_of(const KeogramOptions& options, const sim::Scene* scene, int width, int height) {
  std::array<int, 4> roi_px = scene != nullptr ? scene->fit.roi_px : sim::Fit{}.roi_px;
  for (std::size_t i = 0; i < options.roi_px.size(); ++i) roi_px[i] = options.roi_px[i];
  try {
    return fit::checked_region(roi_px, width, height);
  } catch (const sim::Error& error) {
    if (options.roi_px.empty()) throw scene != nullptr ? with_place(error, *scene) : error;
    throw sim::Error(error).kind(sim::ErrorKind::usage).key("--roi");
  }
}

/// The line, and whose directions it goes by, for pictures like this one.
void choose_line(const KeogramOptions& options, const sim::Scene* scene, const fit::Photo& photo,
                 fit::Keogram& keogram) {
  const int width = photo.linear.width, height = photo.linear.height;
  const fit::Region region = region_of(options, scene, width, height);
  const auto known = known_directions(options.maps, scene, width, height, photo.file_name);
  if (known) {
    fit::MeridianOptions meridian;
    meridian.azimuth_deg =
        options.azimuth_deg.value_or(scene != nullptr ? scene->field.declination_deg : 0.0);
    meridian.width_deg = options.width;
    meridian.step_deg = options.step_deg;
    keogram.line = fit::meridian_line(known->map, region, meridian);
    keogram.camera = known->words;
    return;
  }
  if (options.azimuth_deg || options.step_deg)
    throw usage_error(options.azimuth_deg ? "--azimuth" : "--elevation-step",
                      "where the pixels look is not known", "--azimuth-map MAPS, or --scene with the camera");
  if (options.width && *options.width != std::floor(*options.width))
    throw usage_error("--width", "without a camera the strip is as many columns wide", "a whole number");
  const bool whole = !options.roi_px.empty() && !options.width;
  const int usual = std::max(1, region.width / kUsualStripShare);
  // What is far too wide for an int is too wide for the region.
  const double asked = std::min(options.width.value_or(whole ? region.width : usual), 1e9);
  if (!(asked >= 1.0)) throw usage_error("--width", "a strip needs a width", "1 px or more");
  keogram.line = fit::column_line(region, static_cast<int>(asked));
}

fit::Keogram measure(const KeogramOptions& options, const TimedPictures& pictures, const sim::Scene* scene) {
  const fit::Decoding decoding =
      decoding_of(options.decoding, scene != nullptr ? scene->fit.decoding : sim::Fit{}.decoding, scene);
  if (decoding == fit::Decoding::sensor && scene == nullptr)
    throw usage_error("--decoding", "no scene says what the sensor is", "--scene SCENE with it");
  fit::Keogram keogram;
  keogram.time_kind = pictures.times.kind;
  keogram.time_source = pictures.times.source;
  fit::PictureSeries series;
  for (std::size_t i = 0; i < pictures.files.size(); ++i) {
    fit::Photo photo = fit::read_photo_of(series.read(pictures.files[i]), decoding, scene);
    if (i == 0) choose_line(options, scene, photo, keogram);
    const bool like_the_first = i == 0 || (photo.linear.width == keogram.picture_width_px &&
                                           photo.linear.height == keogram.picture_height_px);
    if (!options.mask.empty() && like_the_first) fit::apply_mask(photo, options.mask);
    fit::add_picture(photo, pictures.times.seconds[i], keogram);
  }
  return keogram;
}

fit::KeogramLook look_of(const KeogramOptions& options) {
  fit::KeogramLook look;
  if (!options.channel.empty()) look.channel = options.channel == "r" ? 0 : options.channel == "g" ? 1 : 2;
  look.black = options.black;
  look.white = options.white;
  if (look.black && look.white && !(*look.white > *look.black))
    throw usage_error("--white", "white is not brighter than black", "more than --black");
  return look;
}

void fill(sim::WholeFile& to, const fit::Keogram& keogram, const fit::KeogramLook& look,
          const std::string& file) {
  switch (output_kind(file)) {
    case OutputKind::table:
      to.write(fit::keogram_csv(keogram));
      break;
    case OutputKind::netcdf:
      fit::table_dataset(fit::keogram_csv(keogram), file).write(to.temporary(), file);
      break;
    case OutputKind::image: {
      const sim::Image image = fit::keogram_image(keogram);
      to.write(sim::encode_exr({&image}, fit::keogram_attributes(keogram), file));
      break;
    }
    case OutputKind::plot:
      to.write(plot_bytes(fit::keogram_plot(keogram, look), plot_format(file, "--output")));
      break;
  }
}

std::string line_words(const fit::KeogramLine& line) {
  if (!line.of_directions)
    return "rows of a strip of " + sim::short_number(line.width) + " columns from " +
           std::to_string(line.grid->region.x);
  return "azimuth " + sim::short_number(line.azimuth_deg) + "\u00b0 over the zenith, " +
         sim::short_number(line.width) + "\u00b0 wide, in steps of " + sim::short_number(line.step) +
         "\u00b0";
}

GivenTimes given_times(const KeogramOptions& options) {
  GivenTimes given{options.times, {}, options.step_s};
  if (given.step_s && !(*given.step_s > 0.0))
    throw usage_error("--step", "pictures follow each other in time", "more than 0 s");
  if (options.start.empty()) return given;
  given.start_s = sim::utc_seconds(options.start);
  if (!given.start_s)
    throw usage_error("--start", "'" + options.start + "' is no time",
                      "ISO 8601, UTC or with a zone: 2014-02-21T19:30:40Z");
  return given;
}

}  // namespace

void run_keogram(const KeogramOptions& options) {
  end_at_once_when_interrupted();
  const fit::KeogramLook look = look_of(options);
  const TimedPictures pictures = timed_pictures(options.images, given_times(options));
  check_outputs(options, pictures.files);
  // All places are claimed before the work, and filled after all of it.
  sim::WholeFiles files(options.outputs, options.overwrite);
  std::optional<sim::Scene> scene;
  if (!options.scene.empty()) scene = sim::still_scene(sim::read_scene(options.scene));
  const fit::Keogram keogram = measure(options, pictures, scene ? &*scene : nullptr);
  for (const std::string& output : options.outputs) fill(files.file(output), keogram, look, output);
  files.commit();

  json_answer() = {{"outputs", json_names(options.outputs)},
                   {"pictures", keogram.columns.size()},
                   {"width_px", keogram.picture_width_px},
                   {"height_px", keogram.picture_height_px},
                   {"decoding", keogram.decoding},
                   {"time_source", keogram.time_source},
                   {"first_time", fit::time_text(keogram, keogram.columns.front().time)},
                   {"last_time", fit::time_text(keogram, keogram.columns.back().time)},
                   {"line", line_words(keogram.line)},
                   {"places", keogram.positions()}};
  say("%zu pictures of %d x %d pixels, decoding: %s\n", keogram.columns.size(), keogram.picture_width_px,
      keogram.picture_height_px, keogram.decoding.c_str());
  say("times: %s; %s to %s\n", keogram.time_source.c_str(),
      fit::time_text(keogram, keogram.columns.front().time).c_str(),
      fit::time_text(keogram, keogram.columns.back().time).c_str());
  say("line: %s; %d places\n", line_words(keogram.line).c_str(), keogram.positions());
  if (!keogram.camera.empty()) say("directions: %s\n", keogram.camera.c_str());
  for (const std::string& output : options.outputs) say("%s\n", output.c_str());
}

void add_keogram_command(Program& program) {
  const auto options = std::make_shared<KeogramOptions>();
  const Command command =
      program.add("keogram", "Make a keogram: one line of each picture of a night, side by side in time");
  command
      .option("IMAGES", options->images, "Photographs of any format that is read, or one list of them (.txt)")
      .required();
  command
      .option("-o,--output", options->outputs,
              "The keogram to write: a picture, linear light, or a table (repeatable)")
      .required()
      .one_an_occurrence()
      .type_name("OUT.png|.svg|.exr|.csv|.nc");
  command.option("--scene", options->scene,
                 "A scene with the camera: the line is then the magnetic meridian");
  add_map_options(command, options->maps);
  command.option("--azimuth", options->azimuth_deg,
                 "Azimuth of the line in degrees (default: the field's declination in the scene, or north)");
  command.option(
      "--width", options->width,
      "Width of the line: degrees with a camera (default: two steps), else columns (default: 1/50)");
  command.option("--elevation-step", options->step_deg,
                 "Degrees between points of the line (default: by the pixels)");
  command
      .option("--roi", options->roi_px, "Region of interest in pixels, which without a camera is the line's")
      .delimiter(',')
      .expected(4)
      .type_name("X,Y,W,H");
  command.option("--mask", options->mask, "An image of the same size: white = use");
  command.option("--times", options->times, "Table of the times: lines of FILE,TIME").type_name("TIMES.csv");
  command
      .option("--start", options->start,
              "Time of the first picture (ISO 8601, UTC or with a zone), with --step; without it for a film")
      .type_name("TIME");
  command.option("--step", options->step_s, "Seconds from one picture to the next").type_name("S");
  add_decoding_option(command, options->decoding);
  command.option("--channel", options->channel, "Show one channel, as a colour map").one_of({"r", "g", "b"});
  command.option("--black", options->black, "Linear light shown as black");
  command.option("--white", options->white, "Linear light shown as white");
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] {
    run_keogram(*options);
    return good;
  });
}

}  // namespace vegard::apps
