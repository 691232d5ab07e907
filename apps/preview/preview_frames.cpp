#include "apps/preview/preview.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/standard_streams.h"
#include "apps/output/animation/animation_frames.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "apps/preview/preview_painter.h"
#include "fit/photo/composite_pictures.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/version.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {
namespace {

namespace fs = std::filesystem;

const char* const kPattern = "frame_####.png";

/// What tells a preview's frame from a picture of another program: a text beside its pixels.
const char* const kMark = "preview";

/// A folder that an input lies in would be lost with it.
void refuse_inputs_in_folder(const sim::Scene& scene, const PreviewOptions& options) {
  for (const std::string& input : fit::picture_files(scene))
    if (is_inside(input, options.output))
      throw same_file_error("--output", options.output, "a folder of its input");
  for (const std::string& input : {options.scene.file, options.scene.camera_file})
    if (is_inside(input, options.output))
      throw same_file_error("--output", options.output, "a folder of its input");
}

/// True for a PNG with the mark of a preview among the texts before its pixels.
bool is_frame_of_preview(const std::string& file) {
  constexpr std::size_t kHead = 4096;
  const std::string bytes = sim::read_beginning(file, kHead).bytes;
  return bytes.rfind("\x89PNG\r\n\x1a\n", 0) == 0 &&
         bytes.substr(0, bytes.find("IDAT")).find(std::string("vegard:") + kMark) != std::string::npos;
}

sim::DirectoryKind preview_kind() {
  return {"a folder of a preview's frames",
          [](const std::string& directory) {
            sim::KnownFolder known;
            known.has = [directory](const std::string& name) {
              return FrameNames(kPattern).frame_of(name) && is_frame_of_preview(directory + "/" + name);
            };
            return known;
          },
          {}};
}

std::string png_of(const ScreenPicture& picture, const std::string& name) {
  sim::Image shown(picture.width, picture.height, {"R", "G", "B"});
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    shown.data[i] = static_cast<float>(picture.rgb[i]) / 255.0f;
  return sim::encode_display(sim::ImageFormat::png, shown, 8, 95, {{kMark, sim::version()}}, name);
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
  if (options.run_time) at.time.start_s += frame / options.frames_per_second * at.time.lapse;
  return at;
}

int run_preview_frames(const sim::Scene& scene, const PreviewOptions& options) {
  sim::validate(scene_of_preview_frame(scene, options, options.frames - 1));  // angles and time have limits
  const FrameNames names(kPattern);
  names.check_room_for(options.frames - 1);
  std::optional<sim::WholeDirectory> folder;
  if (!options.output.empty()) {
    refuse_inputs_in_folder(scene, options);
    folder.emplace(options.output, options.overwrite, preview_kind());
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
    tell("vegard: interrupted, nothing is written\n");
    return interrupted;
  }
  if (folder) folder->commit();
  const double first_ms = times_ms.front();
  // What is made once is made with the first.
  if (times_ms.size() > 1) times_ms.erase(times_ms.begin());
  const double middle_ms = median(times_ms);
  json_answer() = {{"outputs", json_names({options.output})},
                   {"frames", options.frames},
                   {"width_px", width},
                   {"height_px", height},
                   {"median_ms_per_frame", middle_ms},
                   {"first_frame_ms", first_ms}};
  say("%s\n",
      fmt::format("{}{} frames of {} x {} pixels: median {:.1f} ms a frame, {:.1f} frames per second; "
                  "the first, with what is made once, {:.1f} ms",
                  folder ? options.output + ": " : std::string(), options.frames, width, height, middle_ms,
                  1000.0 / middle_ms, first_ms)
          .c_str());
  return good;
}

}  // namespace vegard::apps
