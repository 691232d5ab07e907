#include "apps/commands/commands.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands/mask_parts.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "fit/photo/photo.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"

namespace vegard::apps {
namespace {

struct MaskOptions {
  std::string image, at, output, show, horizon_csv, decoding;
  MaskRequest request;
  bool overwrite = false;
};

/// No output may take another's place, or that of the photograph or of what the user has drawn.
void check_outputs(const MaskOptions& options) {
  const std::vector<std::pair<std::string, std::string>> outputs = {
      {"--output", options.output}, {"--show", options.show}, {"--horizon-csv", options.horizon_csv}};
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t other = 0; other < i; ++other)
      if (same_file(outputs[i].second, outputs[other].second))
        refuse_same_file(outputs[i].first, outputs[i].second, "another output");
    if (same_file(outputs[i].second, options.image))
      refuse_same_file(outputs[i].first, outputs[i].second, "an input");
    for (const std::string& drawn : options.request.drawn)
      if (same_file(outputs[i].second, drawn))
        refuse_same_file(outputs[i].first, outputs[i].second, "an input");
  }
}

void check_png(const std::string& key, const std::string& file) {
  if (file.empty() || sim::image_format(file) == sim::ImageFormat::png) return;
  throw usage_error(key, "'" + file + "' is no PNG by its name", "a name that ends in .png");
}

void check_numbers(const MaskRequest& request) {
  const auto positive = [](const char* key, double value) {
    if (!(value > 0.0)) throw usage_error(key, "it is not positive", "a number above 0");
  };
  positive("--hot-sigma", request.hot_pixels.sigmas);
  positive("--star-sigma", request.star.sigmas);
  if (request.star.size_px < 0) throw usage_error("--star-size", "it is negative", "a number of pixels");
  if (request.saturation.border_px < 0 || request.saturation.border_px > 200)
    throw usage_error("--border", "it is out of range", "from 0 to 200 pixels");
}

void print_share(const char* name, std::size_t pixels, std::size_t all, const std::string& more) {
  say("%-12s %10zu px %7.3f %%%s\n", name, pixels, 100.0 * static_cast<double>(pixels) / all, more.c_str());
}

void run_mask(const MaskOptions& options) {
  end_at_once_when_interrupted();
  if (options.request.empty())
    throw usage_error("mask", "nothing is asked for",
                      "at least one of --draw, --saturated, --hot, --stars, --text, --circle, --horizon, "
                      "--polygon");
  if (!options.horizon_csv.empty() && options.request.horizon.empty())
    throw usage_error("--horizon-csv", "no horizon is asked for", "--horizon with it");
  check_png("--output", options.output);
  check_png("--show", options.show);
  check_outputs(options);
  check_numbers(options.request);
  const fit::Decoding decoding = decoding_of(options.decoding, "auto");
  const fit::Photo photo = fit::read_photo(options.image, decoding);
  const int width = photo.linear.width, height = photo.linear.height;
  const MaskParts found = mask_parts(photo, options.request);

  const fit::PixelSet out = fit::left_out(found.parts, width, height);
  const std::size_t all = out.in.size(), left = all - out.count();
  if (left == 0) {
    std::string whose;
    for (const fit::MaskPart& part : found.parts)
      if (part.out.count() == all) whose = part.name;
    throw usage_error("mask", "it leaves no pixel of " + photo.file_name, "some of the photograph to be used",
                      whose.empty() ? "leave out one of the finders" : "look at '" + whose + "'");
  }
  const std::string mask = fit::mask_png(out);
  const std::string shown = options.show.empty() ? "" : fit::shown_mask_png(photo, found.parts);
  // All places are claimed before any is filled.
  sim::WholeFile mask_file(options.output, options.overwrite);
  std::optional<sim::WholeFile> shown_file, horizon_file;
  if (!options.show.empty()) shown_file.emplace(options.show, options.overwrite);
  if (!options.horizon_csv.empty()) horizon_file.emplace(options.horizon_csv, options.overwrite);
  mask_file.write(mask);
  if (shown_file) shown_file->write(shown);
  if (horizon_file) horizon_file->write(fit::horizon_csv(*found.horizon, photo.file_name));
  mask_file.commit();
  if (shown_file) shown_file->commit();
  if (horizon_file) horizon_file->commit();

  say("%s: %d x %d pixels, decoding: %s\n", photo.file_name.c_str(), width, height, photo.decoding.c_str());
  for (const std::string& note : found.notes) say("%s\n", note.c_str());
  json_answer() = {{"outputs", json_names({options.output, options.show, options.horizon_csv})},
                   {"photo", photo.file_name},
                   {"width_px", width},
                   {"height_px", height},
                   {"decoding", photo.decoding},
                   {"parts", Json::array()},
                   {"left_out_px", all - left},
                   {"used_px", left},
                   {"notes", found.notes}};
  fit::PixelSet before(width, height);
  for (const fit::MaskPart& part : found.parts) {
    const std::size_t earlier = before.count();
    fit::add(before, part.out);
    std::string more = "; " + std::to_string(before.count() - earlier) + " px by it first";
    if (!options.show.empty()) more += ", " + part.colour_name;
    print_share(part.name.c_str(), part.out.count(), all, more);
    json_answer()["parts"].push_back({{"name", part.name},
                                      {"left_out_px", part.out.count()},
                                      {"first_by_it_px", before.count() - earlier}});
  }
  print_share("left out", all - left, all, "");
  print_share("used", left, all, "");
}

void add_finders(const Command& command, MaskRequest& request) {
  command.option("--draw", request.drawn, "Combine with a mask drawn by hand, white = use (repeatable)")
      .one_an_occurrence()
      .type_name("IMAGE");
  command.option("--polygon", request.polygons, "Leave out the inside of a polygon (repeatable)")
      .type_name("X,Y ...");
  command.option("--circle", request.circle, "Leave out what is outside a fisheye's circle, which auto finds")
      .type_name("auto|X,Y,RADIUS");
  command
      .option("--circle-margin", request.circle_margin_px,
              "Pixels by which the mask ends inside that circle (default: 2)")
      .type_name("PX");
  command
      .option("--horizon", request.horizon,
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
  add_finders(command, options->request);
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
