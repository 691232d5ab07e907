#include "apps/commands/commands.h"

#include <charconv>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/measurement/mask.h"
#include "fit/photo/photo.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"

namespace vegard::apps {
namespace {

struct MaskOptions {
  std::string image, at, output, show, horizon_csv, decoding, circle;
  std::vector<std::vector<std::string>> polygons;
  std::vector<std::string> horizon;
  fit::MaskRequest request;
  bool overwrite = false;
};

/// No output may take another's place, or that of the photograph or of what the user has drawn.
void check_outputs(const MaskOptions& options) {
  std::vector<std::string> inputs = options.request.drawn;
  inputs.push_back(options.image);
  protect_outputs(
      {{"--output", options.output}, {"--show", options.show}, {"--horizon-csv", options.horizon_csv}},
      inputs);
}

void check_png(const std::string& key, const std::string& file) {
  if (file.empty() || sim::image_format(file) == sim::ImageFormat::png) return;
  throw usage_error(key, "'" + file + "' is no PNG by its name", "a name that ends in .png");
}

void check_numbers(const fit::MaskRequest& request) {
  const auto positive = [](const char* key, double value) {
    if (!(value > 0.0)) throw usage_error(key, "it is not positive", "a number above 0");
  };
  positive("--hot-sigma", request.hot_pixels.sigmas);
  positive("--star-sigma", request.star.sigmas);
  if (request.star.size_px < 0) throw usage_error("--star-size", "it is negative", "a number of pixels");
  if (request.saturation.border_px < 0 || request.saturation.border_px > 200)
    throw usage_error("--border", "it is out of range", "from 0 to 200 pixels");
}

/// The numbers of "360,237,226", `count` of them. Throws Error(usage) about the option `key`.
std::vector<double> pixel_numbers(const std::string& word, std::size_t count, const std::string& key) {
  std::vector<double> numbers;
  const char* at = word.data();
  const char* const end = word.data() + word.size();
  bool readable = true, more = true;
  while (readable && more) {
    double number = 0.0;
    const auto [stop, error] = std::from_chars(at, end, number);
    readable = error == std::errc{} && std::isfinite(number);
    more = readable && stop != end && *stop == ',';
    at = more ? stop + 1 : stop;
    numbers.push_back(number);
  }
  if (!readable || at != end || numbers.size() != count)
    throw usage_error(key, "'" + word + "' cannot be read",
                      std::to_string(count) + " numbers in pixels with commas between them");
  return numbers;
}

/// Words "x,y". Throws as above.
std::vector<fit::PicturePoint> picture_points(const std::vector<std::string>& words, const std::string& key) {
  std::vector<fit::PicturePoint> points;
  for (const std::string& word : words) {
    const std::vector<double> numbers = pixel_numbers(word, 2, key);
    points.push_back({numbers[0], numbers[1]});
  }
  return points;
}

/// Completes the request by the options that are words.
void read_places(MaskOptions& options) {
  fit::MaskRequest& request = options.request;
  for (const std::vector<std::string>& corners : options.polygons) {
    if (corners.size() < 3)
      throw usage_error("--polygon", "it has " + std::to_string(corners.size()) + " corners",
                        "at least three, x,y each");
    request.polygons.push_back(picture_points(corners, "--polygon"));
  }
  request.finds_circle = options.circle == "auto";
  if (!request.finds_circle && !options.circle.empty()) {
    const std::vector<double> numbers = pixel_numbers(options.circle, 3, "--circle");
    request.circle = fit::Circle{numbers[0], numbers[1], numbers[2]};
    if (!(numbers[2] > 0.0)) throw usage_error("--circle", "a circle without a radius", "above 0");
  }
  request.finds_skyline = options.horizon.size() == 1 && options.horizon[0] == "auto";
  if (!request.finds_skyline) request.horizon = picture_points(options.horizon, "--horizon");
}

void run_mask(MaskOptions options) {
  end_at_once_when_interrupted();
  read_places(options);
  if (options.request.empty())
    throw usage_error("mask", "nothing is asked for",
                      "at least one of --draw, --saturated, --hot, --stars, --text, --circle, --horizon, "
                      "--polygon");
  if (!options.horizon_csv.empty() && options.horizon.empty())
    throw usage_error("--horizon-csv", "no horizon is asked for", "--horizon with it");
  check_png("--output", options.output);
  check_png("--show", options.show);
  check_outputs(options);
  check_numbers(options.request);
  const fit::Photo photo = fit::read_photo(options.image, decoding_of(options.decoding, "auto"));
  const fit::Mask mask = fit::make_mask(photo, options.request, said_with_progress());
  const std::string picture = fit::mask_png(mask.left_out);
  const std::string shown = options.show.empty() ? "" : fit::shown_mask_png(photo, mask.parts);
  // All places are claimed before any is filled.
  sim::WholeFiles outputs({options.output, options.show, options.horizon_csv}, options.overwrite);
  outputs.write(options.output, picture);
  outputs.write(options.show, shown);
  if (!options.horizon_csv.empty())
    outputs.write(options.horizon_csv, fit::horizon_csv(*mask.horizon, photo.file_name));
  outputs.commit();

  fit::tell_mask(mask, !options.show.empty(), said());
  json_answer() = {{"outputs", json_names(outputs.written())}};
  json_answer().update(fit::mask_json(mask));
}

void add_finders(const Command& command, MaskOptions& options) {
  fit::MaskRequest& request = options.request;
  command.option("--draw", request.drawn, "Combine with a mask drawn by hand, white = use (repeatable)")
      .one_an_occurrence()
      .type_name("IMAGE");
  command.option("--polygon", options.polygons, "Leave out the inside of a polygon (repeatable)")
      .type_name("X,Y ...");
  command.option("--circle", options.circle, "Leave out what is outside a fisheye's circle, which auto finds")
      .type_name("auto|X,Y,RADIUS");
  command
      .option("--circle-margin", request.circle_margin_px,
              "Pixels by which the mask ends inside that circle (default: 2)")
      .type_name("PX");
  command
      .option("--horizon", options.horizon,
              "Leave out what is below a line through points, or below the skyline")
      .expected(1, 1 << 20)
      .type_name("auto|X,Y ...");
  command
      .option("--horizon-margin", request.horizon_margin_px,
              "Pixels by which the mask ends above that line (default: 2)")
      .type_name("PX");
  command.flag("--text", request.text, "Leave out lines of bright letters");
  command.flag("--saturated", request.saturated, "Leave out pixels that are clipped in any channel");
  command
      .option("--border", request.saturation.border_px,
              "Leave out this many pixels around them too (default: 2)")
      .type_name("PX");
  command.flag("--hot", request.hot,
               "Leave out single pixels that are much brighter or darker than their neighbours");
  command.option("--hot-sigma", request.hot_pixels.sigmas,
                 "Threshold of --hot in standard deviations of the noise (default: 8)");
  command.flag("--stars", request.stars, "Leave out small round spots of light");
  command.option("--star-sigma", request.star.sigmas,
                 "Threshold of --stars in standard deviations of the noise (default: 5)");
  command
      .option("--star-size", request.star.size_px,
              "Largest diameter of a star (default: 1/200 of the longer side, at least 9)")
      .type_name("PX");
}

}  // namespace

void add_mask_command(Program& program) {
  const auto options = std::make_shared<MaskOptions>();
  const Command command = program.add(
      "mask", "Make a mask (white = use) that leaves out stars, hot pixels, captions or the ground");
  command.option("IMAGE", options->image, "A photograph").required();
  add_at_option(command, options->at);
  command.option("-o,--output", options->output, "The mask to write").required().type_name("MASK.png");
  command.option("--show", options->show, "Write the photograph with what is left out in colours")
      .type_name("PICTURE.png");
  add_finders(command, *options);
  command.option("--horizon-csv", options->horizon_csv, "Write the horizon, a row per column of pixels")
      .type_name("OUT.csv");
  add_decoding_option(command, options->decoding, SceneOfDecoding::none);
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] {
    options->image = picture_at(options->image, options->at);
    run_mask(*options);
    return good;
  });
}

}  // namespace vegard::apps
