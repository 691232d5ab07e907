#include "apps/commands/commands.h"

#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/photographs.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/file_description.h"
#include "apps/output/photo_description.h"
#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/photo/photo_facts.h"
#include "fit/photo/sky_map_file.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

struct DescribeRequest {
  std::string photo, at, output;
  bool overwrite = false;
};

/// Nothing for a file without frames. One that has maps of directions and no images that can be distinguished
/// has none either.
std::optional<fit::FrameIndex> frames_of_photo(const std::string& photo) {
  if (fit::frame_name(photo).is_chosen() || !fit::is_frame_file(photo)) return std::nullopt;
  try {
    return fit::frame_index(photo);
  } catch (const sim::Error&) {
    if (fit::has_sky_map(photo)) return std::nullopt;
    throw;
  }
}

int run_describe(const DescribeRequest& options) {
  if (same_file(options.photo, options.output)) refuse_same_file("--output", options.output, "the picture");
  const std::string name = file_name_of(options.photo);
  if (options.output.empty() && !fit::frame_name(options.photo).is_chosen())
    if (const std::optional<std::string> other = other_file_text(options.photo)) {
      json_answer() = {{"file", name}, {"words", *other}};
      say_result(*other);
      return good;
    }
  const std::optional<fit::FrameIndex> frames = frames_of_photo(options.photo);
  if (!frames && fit::has_sky_map(options.photo)) {
    if (!options.output.empty())
      throw usage_error("--output", "a skymap is no picture to make a scene of", "no -o with a skymap",
                        "vegard calibrate --skymap makes a camera of it");
    const fit::SkyMapFile map = fit::read_sky_map(options.photo);
    answer_with(sky_map_description_json(name, map));
    say_result(sky_map_description_text(name, map));
    return good;
  }
  if (frames) {
    const fit::FrameIndex& index = *frames;
    if (index.frames.size() > 1) {
      // A scene is of one moment.
      if (!options.output.empty()) fit::refuse_without_frame(index.frames, options.photo);
      answer_with(frames_description_json(name, index));
      say_result(frames_description_text(name, index));
      return good;
    }
  }
  const sim::PictureMetadata metadata = fit::metadata_with_size(options.photo);
  if (!options.output.empty()) {
    sim::WholeFile file(options.output, options.overwrite);
    file.write(start_scene(name, fit::photo_facts(metadata)));
    file.commit();
  }
  answer_with(description_json(name, metadata));
  say_result(description_text(name, metadata));
  if (!options.output.empty()) json_answer()["outputs"] = json_names({options.output});
  if (!options.output.empty()) say("%s\n", options.output.c_str());
  return good;
}

}  // namespace

void add_describe_command(Program& program) {
  const auto options = std::make_shared<DescribeRequest>();
  const Command command = program.add(
      "describe", "Print a picture's metadata (place, time, lens, exposure), and write a scene of it");
  command
      .option("PHOTO", options->photo,
              "A picture, a file of frames, a skymap, netCDF, a solution or star list of Astrometry.net, or "
              "a camera of AIDA_tools")
      .required();
  add_at_option(command, options->at);
  command.option("-o,--output", options->output, "Write a scene to begin with").type_name("SCENE.toml");
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] {
    options->photo = picture_at(options->photo, options->at);
    return run_describe(*options);
  });
}

}  // namespace vegard::apps
