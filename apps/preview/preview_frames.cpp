#include "apps/preview/preview.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "apps/options/composite_pictures.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/refusals.h"
#include "apps/output/animation_frames.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "apps/preview/preview_painter.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {
namespace {

namespace fs = std::filesystem;

const char* const kPattern = "frame_####.png";

/// A folder that holds anything else than a preview's frames would be lost with them.
void check_folder(const sim::Scene& scene, const PreviewOptions& options) {
  const FrameNames names(kPattern);
  for (const std::string& input : picture_files(scene))
    if (is_inside(input, options.output))
      refuse_same_file("--output", options.output, "a folder of its input");
  for (const std::string& input : {options.scene.file, options.scene.camera_file})
    if (is_inside(input, options.output))
      refuse_same_file("--output", options.output, "a folder of its input");
  std::error_code ignored;
  if (!options.overwrite || !fs::is_directory(options.output, ignored)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(options.output, ignored))
    if (!names.frame_of(entry.path().filename().string())) {
      sim::ErrorDetails details;
      details.file = options.output;
      details.problem =
          "is not replaced: " + entry.path().filename().string() + " in it is no frame of a preview";
      details.hint = "choose another name";
      throw sim::Error(sim::ErrorKind::existing_output, details);
    }
}

std::string png_of(const ScreenPicture& picture, const std::string& name) {
  sim::Image shown(picture.width, picture.height, {"R", "G", "B"});
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    shown.data[i] = static_cast<float>(picture.rgb[i]) / 255.0f;
  return sim::encode_display(sim::ImageFormat::png, shown, 8, 95, {}, name);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 != 0 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace

sim::Scene scene_of_preview_frame(const sim::Scene& scene, const PreviewOptions& options, int frame) {
  sim::Scene at = scene;
  const double share = options.frames > 1 ? static_cast<double>(frame) / (options.frames - 1) : 0.0;
  at.camera.azimuth_deg += options.turn_deg * share;
  if (options.run_time) at.time.start_s += frame / options.frames_per_second;
  return at;
}

int run_preview_frames(const sim::Scene& scene, const PreviewOptions& options) {
  sim::validate(scene_of_preview_frame(scene, options, options.frames - 1));  // angles and time have limits
  const FrameNames names(kPattern);
  names.check_room_for(options.frames - 1);
  std::optional<sim::WholeDirectory> folder;
  if (!options.output.empty()) {
    check_folder(scene, options);
    folder.emplace(options.output, options.overwrite, "frame_0000.png", "a folder of frames");
  }
  const std::atomic<bool>& stop = watch_for_interrupt();
  PreviewPainter painter(options.threads);
  std::vector<double> times_ms;
  int width = 0, height = 0;
  {
    ProgressBar bar("previewing");
    for (int frame = 0; frame < options.frames && !stop.load(); ++frame) {
      const sim::Scene now = scene_of_preview_frame(scene, options, frame);
      const auto begin = std::chrono::steady_clock::now();
      const ScreenPicture picture = painter.paint(now, options.reduction, &stop);
      const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
      if (stop.load()) break;
      times_ms.push_back(taken.count());
      width = picture.width, height = picture.height;
      const std::string name = fs::path(names.file(frame)).filename().string();
      if (folder) sim::write_whole(folder->file(name), png_of(picture, name));
      bar.update((frame + 1.0) / options.frames);
    }
  }
  if (stop.load()) {
    std::fputs("vegard: interrupted, nothing is written\n", stderr);
    return interrupted;
  }
  if (folder) folder->commit();
  const double first_ms = times_ms.front();
  // What is made once is made with the first.
  if (times_ms.size() > 1) times_ms.erase(times_ms.begin());
  const double middle_ms = median(times_ms);
  std::printf(
      "%s\n",
      fmt::format("{}{} frames of {} x {} pixels: median {:.1f} ms a frame, {:.1f} frames per second; "
                  "the first, with what is made once, {:.1f} ms",
                  folder ? options.output + ": " : std::string(), options.frames, width, height, middle_ms,
                  1000.0 / middle_ms, first_ms)
          .c_str());
  return good;
}

}  // namespace vegard::apps
