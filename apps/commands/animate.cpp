#include "apps/commands/commands.h"

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/memory_limit.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/animation/animation_frames.h"
#include "apps/output/animation/movie.h"
#include "apps/output/animation/resumption.h"
#include "apps/output/camera_json.h"
#include "apps/output/light_outside.h"
#include "apps/output/picture_file.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/photo/composite_pictures.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/text.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/render/render.h"
#include "sim/render/volumes/volumes.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/freedom/keyframes.h"
#include "sim/scene/freedom/ties.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/colour/colour_table.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::apps {
namespace {

struct AnimateRequest {
  SceneOptions scene;
  std::string output, frames;
  std::optional<double> frames_per_second;
  PictureOptions picture;
  int threads = 0;
  bool overwrite = false, list = false, camera_json = false;
  std::string memory_limit;
};

bool is_movie(const std::string& output) { return movie_kind_of(output).has_value(); }

/// How frames are written. A movie's quality is that of its encoding, and its frames are the same for any.
PictureOptions options_of_frames(const AnimateRequest& options) {
  PictureOptions of_frames = options.picture;
  if (is_movie(options.output)) of_frames.quality.reset();
  if (movie_kind_of(options.output) == MovieKind::prores) of_frames.bits = 16;
  return of_frames;
}

std::vector<int> frames_of(const AnimateRequest& options, const sim::Scene& scene) {
  if (!options.frames.empty()) return frames_from_words(options.frames);
  std::vector<int> all(scene.time.frames);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void check_movie(const AnimateRequest& options, const sim::Scene& scene) {
  const auto even = [](const char* key, int pixels) {
    if (pixels % 2 != 0)
      throw usage_error(key, fmt::format("a movie cannot be {} pixels high or wide", pixels),
                        "an even number", fmt::format("--set {}={}", key, pixels + 1));
  };
  even("camera.width", scene.camera.width);
  even("camera.height", scene.camera.height);
  if (options.picture.bits)
    throw usage_error("--bits", "a movie has as many as its format: 8 in .mp4, 10 in .mov",
                      "-o frames/####.png as well");
  if (options.picture.quality && movie_kind_of(options.output) == MovieKind::prores)
    throw usage_error("--quality", "ProRes has one quality, that of 422 HQ", "-o movie.mp4");
  // A folder that is missing is made with that of the frames.
  const std::filesystem::path folder = std::filesystem::path(options.output).parent_path();
  std::error_code ignored;
  if (folder.empty() || std::filesystem::exists(folder, ignored))
    sim::WholeFile(options.output, options.overwrite);
}

/// With --overwrite a slip of the pen would cost what cannot be had again.
void refuse_input_as_output(const AnimateRequest& options, const FrameNames& names, const std::string& input,
                            const std::string& what) {
  const std::optional<int> frame = names.frame_of(std::filesystem::path(input).filename().string());
  for (const std::string& output : {options.output, frame ? names.file(*frame) : std::string()})
    if (same_file(output, input)) throw same_file_error("--output", output, what);
}

/// Throws sim::Error(usage) for an animation that goes beyond the limits of time.start_s.
void check_last_instant(const sim::Scene& scene, int frame, double frames_per_second) {
  const double start_s = scene_of_frame(scene, frame, frames_per_second).time.start_s;
  const sim::ParameterPath path = sim::resolve(scene, "time.start_s").front();
  if (!sim::is_within_limits(path, start_s))
    throw usage_error(
        "--frames", fmt::format("frame {} would be at {} s", frame, start_s),
        "time.start_s of " + sim::limits_text(*path.row) + " s; fewer frames or a smaller time.lapse");
}

/// Throws sim::Error where keys take the scene of a frame to values that do not go together, or the camera's
/// file, which is one for all frames, would be wrong. Of an exposure it looks at the first instant.
void check_moving(const AnimateRequest& options, const sim::Scene& scene, const std::vector<int>& frames,
                  double frames_per_second) {
  if (scene.keys.empty()) return;
  if (options.camera_json)
    throw usage_error("--camera-json", "one camera for all frames, and this scene has keys", "leave it out");
  for (const int frame : frames) {
    try {
      sim::validate(sim::still_scene(scene_of_frame(scene, frame, frames_per_second)));
    } catch (const sim::Error& error) {
      throw sim::Error(error).problem(fmt::format("frame {}: {}", frame, error.details().problem));
    }
  }
}

/// The one camera of all frames.
void write_camera(const std::string& file, const sim::Scene& scene, bool overwrite) {
  const std::string text = camera_json(scene);
  if (sim::read_input(file).bytes == text) return;
  sim::write_whole(file, text, overwrite);
}

/// Renders what is missing; false if it was interrupted. `finished` grows.
bool render_frames(const AnimateRequest& options, const sim::Scene& scene,
                   const sim::CompositePictures& pictures, double frames_per_second, const FrameNames& names,
                   const std::vector<int>& frames, std::set<int>& finished) {
  const std::atomic<bool>& stop = watch_for_interrupt();
  const std::size_t before = finished.size();
  const double missing = static_cast<double>(frames.size() - before);
  ProgressBar bar("animating");
  bool warned = false;
  for (const int frame : frames) {
    if (stop.load()) return false;
    if (finished.count(frame) != 0) continue;
    const double done = static_cast<double>(finished.size() - before);
    const std::string label =
        fmt::format("frame {}, {} of {} finished", frame, finished.size(), frames.size());
    sim::WholeFile file(names.file(frame), false, sim::Leftovers::not_looked_for);  // of all frames before
    const sim::Scene now = scene_of_frame(scene, frame, frames_per_second);
    sim::RenderOptions render_options;
    render_options.threads = options.threads;
    // What is left of a frame then is to make a picture of the light, and to write it.
    render_options.progress = [&](double share) { bar.update((done + 0.9 * share) / missing, label); };
    render_options.stop = &stop;
    render_options.pictures = &pictures;
    sim::Rendering rendering = sim::render(now, render_options);
    if (stop.load()) return false;
    const std::string warning =
        warned ? "" : warning_if_out_of_view(sim::still_scene(now), rendering.rayleigh);
    if (!warning.empty()) {
      bar.finish();
      tell("vegard: frame %d: %s\n", frame, warning.c_str());
      warned = true;
    }
    const sim::Image lines = line_layer(rendering);
    PictureOptions picture = options_of_frames(options);
    picture.frame = static_cast<std::uint32_t>(frame);
    picture.threads = options.threads;
    file.write(encoded_picture(names.file(frame), picture, now, std::move(rendering), lines));
    file.commit();
    finished.insert(frame);
  }
  return true;
}

int tell_of_interruption(std::size_t finished, std::size_t frames) {
  tell("vegard: interrupted; %zu of %zu frames are finished, and the same command goes on from there\n",
       finished, frames);
  return interrupted;
}

int list_frames(const sim::Scene& scene, const std::vector<int>& frames, double frames_per_second) {
  json_answer()["frames"] = Json::array();
  for (const int frame : frames) {
    const double start_s = scene_of_frame(scene, frame, frames_per_second).time.start_s;
    say_result(fmt::format("{} time.start_s={}\n", frame, start_s));
    json_answer()["frames"].push_back({{"frame", frame}, {"start_s", start_s}});
  }
  return good;
}

/// The name of the camera's file, which is no input; the camera has matrices.
std::string checked_camera_file(const AnimateRequest& options, const FrameNames& names,
                                const sim::Scene& scene) {
  const std::string camera =
      is_movie(options.output) ? camera_json_name(options.output) : names.companion("camera.json");
  if (same_file(camera, options.scene.file)) throw same_file_error("--camera-json", camera, "the scene");
  if (same_file(camera, options.scene.camera_file))
    throw same_file_error("--camera-json", camera, "the camera's file");
  camera_json(scene);
  return camera;
}

/// Makes the movie of the frames, which are removed.
int encode_frames(const AnimateRequest& options, const sim::Scene& scene, const FrameNames& names,
                  const std::vector<int>& frames, double frames_per_second) {
  std::vector<std::string> files;
  for (const int frame : frames) files.push_back(names.file(frame));
  std::string codec;
  {
    ProgressBar bar("encoding");
    codec = write_movie(
        options.output, files, frames_per_second, options.overwrite,
        [&bar](double share) { bar.update(share); }, &watch_for_interrupt(),
        scene.camera.model == sim::LensModel::equirectangular,
        options.picture.quality.value_or(kMovieQuality));
  }
  if (codec.empty()) return tell_of_interruption(frames.size(), frames.size());
  remove_animation(names, frames);
  say("%s: %s\n", options.output.c_str(),
      fmt::format("{} frames of {} x {} pixels at {} per second, {}", frames.size(), scene.camera.width,
                  scene.camera.height, frames_per_second, codec)
          .c_str());
  return good;
}

int run_animate(const AnimateRequest& request) {
  AnimateRequest options = request;
  const sim::Scene scene = moving_scene_of(options.scene);
  note_inert_keys(scene);
  const double frames_per_second = options.frames_per_second.value_or(scene.time.frames_per_second);
  const std::vector<int> frames = frames_of(options, scene);
  check_last_instant(scene, frames.back(), frames_per_second);
  check_moving(options, scene, frames, frames_per_second);
  if (options.list) return list_frames(scene, frames, frames_per_second);
  if (options.output.empty())
    throw usage_error("--output", "nothing to write", "-o frames/####.exr, -o movie.mp4 or -o movie.mov");

  const bool movie = is_movie(options.output);
  const FrameNames names(movie ? options.output + ".frames/########.png" : options.output);
  names.check_room_for(frames.back());
  const PictureOptions of_frames = options_of_frames(options);
  check_picture_options(names.file(0), of_frames);
  refuse_input_as_output(options, names, options.scene.file, "the scene");
  refuse_input_as_output(options, names, options.scene.camera_file, "the camera's file");
  for (const std::string& file : fit::picture_files(scene))
    refuse_input_as_output(options, names, file, "a file that the scene reads");
  if (movie) check_movie(options, scene);
  const std::string camera = options.camera_json ? checked_camera_file(options, names, scene) : "";
  options.threads =
      threads_to_render(scene, options.threads, {false, bytes_to_encode_px(names.file(0), of_frames, scene)},
                        options.memory_limit);
  const sim::CompositePictures pictures = fit::read_composite_pictures(scene);
  // Every frame reads its own; here only so that what is wrong with them is reported before a folder is made.
  if (sim::has_emitters(scene)) sim::read_volume_files(scene);
  // A measured tone curve is read by whatever is encoded with it; here, before the work.
  sim::ToneCurve check_of_the_curve(scene);
  sim::ColourTable check_of_the_colours(scene);
  std::error_code ignored;
  const bool makes_folder = !std::filesystem::exists(names.folder(), ignored);
  std::set<int> finished = begin_or_resume(names, manifest_text(scene, frames_per_second, names, of_frames),
                                           frames, options.overwrite, movie);
  const std::size_t before = finished.size();
  const bool makes_camera = !camera.empty() && !std::filesystem::exists(camera, ignored);
  const auto leave_no_beginning = [&] {
    if (!finished.empty()) return;
    if (makes_camera) std::filesystem::remove(camera, ignored);
    remove_beginning(names, makes_folder);
  };
  try {
    if (!camera.empty()) write_camera(camera, scene, options.overwrite);
    if (!render_frames(options, scene, pictures, frames_per_second, names, frames, finished))
      return tell_of_interruption(finished.size(), frames.size());
  } catch (const sim::Error& error) {
    leave_no_beginning();
    if (finished.empty()) throw;
    // Of the frame that failed nothing is left behind, as its hint may say; of the others more is.
    throw sim::Error(error).hint(
        fmt::format("{} of {} frames are finished, and the same command goes on from there", finished.size(),
                    frames.size()));
  } catch (...) {
    leave_no_beginning();
    throw;
  }
  const std::string size = fmt::format("{} x {} pixels", scene.camera.width, scene.camera.height);
  json_answer() = {{"outputs", json_names({movie ? options.output : names.file(frames.front()),
                                           movie || frames.size() == 1 ? "" : names.file(frames.back())})},
                   {"frames", frames.size()},
                   {"finished_before", before},
                   {"width_px", scene.camera.width},
                   {"height_px", scene.camera.height},
                   {"frames_per_second", frames_per_second}};
  if (!movie) {
    say("%s to %s: %zu frames of %s, %zu of them finished before\n", names.file(frames.front()).c_str(),
        names.file(frames.back()).c_str(), frames.size(), size.c_str(), before);
    return good;
  }
  return encode_frames(options, scene, names, frames, frames_per_second);
}

}  // namespace

void add_animate_command(Program& program) {
  const auto options = std::make_shared<AnimateRequest>();
  const Command command = program.add(
      "animate", "Render a scene over time, as numbered frames or a movie; resumes after an interruption");
  add_scene_options(command, options->scene);
  command
      .option("-o,--output", options->output,
              "The frames to write, with # for each digit of their number, or a movie")
      .type_name("FRAMES/####.exr|tif|png|jpg or OUT.mp4|mov");
  command
      .option("--frames", options->frames, "Frames to render, LAST included (default: 0 to time.frames - 1)")
      .type_name("FIRST:LAST[:STEP]");
  command
      .option("--fps", options->frames_per_second,
              "Frames per second (default: time.frames_per_second of the scene)")
      .range(0.001, 1000.0);
  add_threads_option(command, options->threads);
  add_memory_option(command, options->memory_limit);
  add_picture_options(
      command, options->picture,
      "Quality of a JPEG (default: 92), or of a movie: H.264's rate factor is half of what is "
      "missing to 100 (default: 84)");
  command.flag("--list", options->list, "Only print each frame's time.start_s");
  command.flag("--camera-json", options->camera_json, "Write the camera's matrices next to the frames");
  command.flag("--overwrite", options->overwrite, "Replace frames of another animation, or a movie");
  command.runs([options] { return run_animate(*options); });
}

}  // namespace vegard::apps
