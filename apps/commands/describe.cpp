#include "apps/commands/commands.h"

#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/photo_options.h"
#include "apps/options/photographs.h"
#include "apps/options/standard_streams.h"
#include "apps/output/photo_description.h"
#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/photo/photo_facts.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

struct DescribeRequest {
  std::string photo, at, output;
  bool overwrite = false;
};

int run_describe(const DescribeRequest& options) {
  if (same_file(options.photo, options.output)) refuse_same_file("--output", options.output, "the picture");
  const std::string name = file_name_of(options.photo);
  if (!fit::frame_name(options.photo).is_chosen() && fit::is_frame_file(options.photo)) {
    const fit::FrameIndex index = fit::frame_index(options.photo);
    if (index.frames.size() > 1) {
      // A scene is of one moment.
      if (!options.output.empty()) fit::refuse_without_frame(index.frames, options.photo);
      say_text(frames_description_text(name, index));
      return good;
    }
  }
  const sim::PictureMetadata metadata = metadata_of(options.photo);
  if (!options.output.empty()) {
    sim::WholeFile file(options.output, options.overwrite);
    file.write(start_scene(name, fit::photo_facts(metadata)));
    file.commit();
  }
  say_text(description_text(name, metadata));
  if (!options.output.empty()) say("%s\n", options.output.c_str());
  return good;
}

}  // namespace

void add_describe_command(Program& program) {
  const auto options = std::make_shared<DescribeRequest>();
  const Command command = program.add(
      "describe",
      "Tell what a picture says of itself (place, time, lens, exposure), and write a scene of it");
  command.option("PHOTO", options->photo, "The picture, or a file of frames").required();
  add_at_option(command, options->at);
  command.option("-o,--output", options->output, "A scene to begin with").type_name("SCENE.toml");
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] {
    options->photo = picture_at(options->photo, options->at);
    return run_describe(*options);
  });
}

}  // namespace vegard::apps
