#include "apps/commands/commands.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "apps/options/file_names.h"
#include "apps/options/refusals.h"
#include "apps/preview/preview.h"
#include "apps/preview/preview_window.h"
#include "fit/photo/composite_pictures.h"
#include "sim/scene/table/table_files.h"

namespace vegard::apps {
namespace {

struct CommandOptions : PreviewOptions {
  std::string size;
  std::optional<int> wanted_frames, wanted_shrink;
  bool bench = false;
};

sim::PictureSize size_of_words(const std::string& words) {
  sim::PictureSize size;
  char rest = 0;
  const bool good = std::sscanf(words.c_str(), "%5dx%5d%c", &size.width, &size.height, &rest) == 2;
  if (!good || size.width < 1 || size.height < 1 || size.width > 16384 || size.height > 16384)
    throw usage_error("--size", "'" + words + "' is no size", "WIDTHxHEIGHT, each from 1 to 16384",
                      "--size 640x360");
  return size;
}

/// Names of files in a scene go by its folder, so that it cannot be written elsewhere.
void check_save(const PreviewOptions& options, const sim::Scene& scene) {
  if (options.save.empty()) return;
  if (same_file(options.save, options.scene.file)) throw same_file_error("--save", options.save, "the scene");
  if (same_file(options.save, options.scene.camera_file))
    throw same_file_error("--save", options.save, "the camera's file");
  const bool names_files = !fit::picture_files(scene).empty() || !sim::table_files(scene).empty() ||
                           scene.emission.folder != nullptr;
  const std::string folder = std::filesystem::path(options.scene.file).parent_path().string();
  const std::string of_save = std::filesystem::path(options.save).parent_path().string();
  if (names_files && !same_file(folder.empty() ? "." : folder, of_save.empty() ? "." : of_save))
    throw usage_error("--save",
                      "the scene names files beside it, which '" + options.save + "' would not find",
                      "a file in the scene's folder");
}

int run_preview(CommandOptions& options) {
  if (!options.size.empty()) options.reduction.most = size_of_words(options.size);
  if (options.wanted_shrink) options.reduction.shrink = *options.wanted_shrink, options.keeps_pace = false;
  if (options.wanted_frames) options.frames = *options.wanted_frames;
  if (options.bench && !options.output.empty())
    throw usage_error("--bench", "it writes nothing", "--bench or -o DIR");
  const bool wants_frames = options.wanted_frames || options.bench || !options.output.empty();
  const bool frames = wants_frames || !has_display();
  if (frames && !options.bench && options.output.empty())
    throw usage_error(
        "--output",
        wants_frames ? "no folder for the frames" : "no display to open a window on, and no folder",
        "-o DIR for frames, or --bench");
  if (frames && !options.save.empty())
    throw usage_error("--save", "without a window nothing is changed", "a display");
  const sim::Scene scene = scene_of(options.scene);
  check_save(options, scene);
  return frames ? run_preview_frames(scene, options) : run_preview_window(scene, options);
}

}  // namespace

void add_preview_command(Program& program) {
  const auto options = std::make_shared<CommandOptions>();
  const Command command = program.add(
      "preview",
      "Try a scene's parameters at reduced cost: in a window, or as frames where there is no display");
  add_scene_options(command, options->scene);
  command
      .option("--size", options->size, "Largest size of a picture, which keeps its shape (default: 640x360)")
      .type_name("WIDTHxHEIGHT");
  command
      .option("--fps", options->frames_per_second,
              "Frame rate that a window keeps by adapting march.shrink and beams (default: 20)")
      .range(0.1, 1000.0);
  command
      .option("--shrink", options->wanted_shrink,
              "march.shrink, at least the scene's; a window then keeps it (default: 2)")
      .range(1, 16);
  command.option("--step-km", options->reduction.step_km, "march.step_km, at least the scene's (default: 4)")
      .range(0.01, 100.0);
  command
      .option("--points", options->reduction.points,
              "Approximate limit of all beams' deflection points in a picture (default: 2e6)")
      .range(1e3, 1e12);
  command
      .option("--frames", options->wanted_frames,
              "Number of frames, in place of a window (with -o or --bench; default: 60)")
      .range(1, 9999);
  command
      .option("--turn", options->turn_deg,
              "Angle by which the camera turns over all frames, in degrees (default: 30)")
      .range(-360.0, 360.0);
  command.flag("--run", options->run_time,
               "For frames: let the scene's time run, with --fps frames a second");
  command.option("-o,--output", options->output, "Write the frames as DIR/frame_0000.png and so on")
      .type_name("DIR");
  command.flag("--bench", options->bench, "Only measure how long a frame takes");
  command.option("--save", options->save, "File into which the key p writes the current scene")
      .type_name("SCENE.toml");
  add_threads_option(command, options->threads);
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] { return run_preview(*options); });
}

}  // namespace vegard::apps
