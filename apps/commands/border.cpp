#include <memory>
#include <string>
#include <vector>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/photographs.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/progress_bar.h"
#include "fit/measurement/sky_light.h"
#include "fit/photo/photo.h"
#include "fit/report/border/border_run.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"

namespace vegard::apps {
namespace {

struct BorderRequest {
  SceneOptions scene;
  PhotoWords photo;
  std::string out, channel = "green";
  bool overwrite = false, no_metadata = false;
};

int run_border(const BorderRequest& options, const std::string& command) {
  sim::Scene scene = scene_of(options.scene);
  const std::string scene_sha256 = sim::sha256_of_file(options.scene.file);
  if (options.photo.file.empty()) throw usage_error("--photo", "is missing", "the photograph to trace");
  if (options.out.empty()) throw usage_error("--out", "is missing", "the directory to write");
  scene.fit.photos.clear();  // the photograph is the command line's, the camera and the site the scene's
  std::vector<NamedInput> inputs = inputs_of_scene(options.scene, scene);
  inputs.push_back({options.photo.file, "the photograph"});
  inputs.push_back({options.photo.mask, "the mask"});
  protect_inputs_inside("--out", options.out, inputs);
  fit::check_border_directory(options.out, options.overwrite);
  if (!options.no_metadata) take_from_photograph(scene, options.photo.file, options.scene.changes);
  const std::vector<fit::Photo> photos = photographs_asked(options.photo, scene);
  fit::BorderSettings settings;
  settings.channel = options.channel == "red" ? 0 : options.channel == "green" ? 1 : 2;
  fit::BorderRunFacts facts;
  facts.command = command;
  facts.inputs = fit::inputs_of(options.scene.file, scene_sha256, photos);
  facts.decoding = photos.front().decoding;
  const fit::Border border = fit::traced_border(scene, photos.front(), settings, options.out,
                                                options.overwrite, facts, said_with_progress());
  answer_with(sim::input_bytes(options.out + "/border.json", "a border"));
  json_answer()["report"] = options.out + "/report.html";
  return border.measured > 0 ? good : doubted;
}

}  // namespace

void add_border_command(Program& program) {
  const auto options = std::make_shared<BorderRequest>();
  const Command command = program.add(
      "border", "Trace the lower border of the light, and compute its distance for an assumed height");
  add_scene_options(command, options->scene);
  command.option("--photo", options->photo.file, "A photograph of any format that is read")
      .type_name("IMAGE");
  add_at_option(command, options->photo.at);
  command.option("--out", options->out, "The directory to write").type_name("RUN");
  command.option("--mask", options->photo.mask, "An image of the same size: white = use").type_name("IMAGE");
  add_decoding_option(command, options->photo.decoding);
  add_no_metadata_option(command, options->no_metadata);
  command.option("--channel", options->channel, "Colour channel that is traced")
      .one_of({"red", "green", "blue"})
      .shows_default();
  command.flag("--overwrite", options->overwrite, "Replace the output of an earlier call");
  command.runs([options, words = program.command_line()] {
    options->photo = with_frames_chosen(options->photo);
    return run_border(*options, words);
  });
}

}  // namespace vegard::apps
