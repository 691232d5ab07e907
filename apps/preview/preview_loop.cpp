#include "apps/preview/preview.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/refusals.h"
#include "apps/output/terminal.h"
#include "apps/preview/preview_controls.h"
#include "apps/preview/preview_pace.h"
#include "apps/preview/preview_painter.h"
#include "apps/preview/preview_window.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::apps {
namespace {

using Clock = std::chrono::steady_clock;

double ms_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

class PreviewLoop {
 public:
  PreviewLoop(const sim::Scene& scene, const PreviewOptions& options)
      : options_(options),
        controls_(scene),
        pace_(options.reduction, options.frames_per_second),
        painter_(options.threads),
        window_(open_preview_window("vegard preview")),
        // Footprints stand still; sheets may move.
        time_runs_(!scene.sheets.empty()) {}

  int run() {
    const std::atomic<bool>& stop = watch_for_interrupt();
    while (!stop.load()) {
      if (stale_) paint(stop);
      const WindowEvents events = window_->wait(stale_ ? 1 : 15);
      if (!obey(events)) return good;
      const Clock::time_point now = Clock::now();
      if (time_runs_) {
        // A clock that was held up does not leap.
        controls_.run_time(std::min(0.2, 1e-3 * ms_between(last_time_, now)));
        stale_ = true;
      }
      last_time_ = now;
    }
    return interrupted;
  }

 private:
  void paint(const std::atomic<bool>& stop) {
    const Clock::time_point begin = Clock::now();
    ScreenPicture picture;
    try {
      picture = painter_.paint(controls_.scene(), pace_.reduction(), &stop);
    } catch (const sim::Error& error) {
      if (picture_.rgb.empty()) throw;
      // A number that the scene may have, but not with the others: the last picture stays.
      message_ = error.what();
      picture = picture_;
    }
    if (picture.rgb.empty()) return;
    picture_ = std::move(picture);
    const double ms = ms_between(begin, Clock::now());
    last_ms_.push_back(ms);
    if (last_ms_.size() > 9) last_ms_.pop_front();
    stale_ = false;
    if (options_.keeps_pace) stale_ = pace_.take(ms);
    show();
  }

  void show() {
    std::vector<double> sorted(last_ms_.begin(), last_ms_.end());
    std::sort(sorted.begin(), sorted.end());
    const double ms = sorted[sorted.size() / 2];
    const sim::Camera& camera = controls_.scene().camera;
    std::vector<std::string> lines = {
        controls_.words(),
        fmt::format("azimuth {:.1f}, elevation {:.1f} deg, time {:.2f} s{}", camera.azimuth_deg,
                    camera.elevation_deg, controls_.scene().time.start_s, time_runs_ ? "" : " (stopped)"),
        fmt::format("{} x {}, {:.0f} ms, {:.0f} fps", picture_.width, picture_.height, ms,
                    1000.0 / std::max(ms, 1.0))};
    if (!message_.empty()) lines.push_back(message_);
    window_->show(picture_, lines);
  }

  /// False at the end.
  bool obey(const WindowEvents& events) {
    if (events.dragged_x_px != 0.0 || events.dragged_y_px != 0.0) {
      // The window's pixels are those of the reduced picture.
      const double scale = static_cast<double>(controls_.scene().camera.width) / picture_.width;
      controls_.pan(events.dragged_x_px * scale, events.dragged_y_px * scale);
      stale_ = true;
    }
    if (events.wheel != 0.0) controls_.zoom(events.wheel), stale_ = true;
    if (events.key == WindowKey::none) return true;
    message_.clear();
    stale_ = true;
    switch (events.key) {
      case WindowKey::up:
        controls_.choose_next(-1);
        break;
      case WindowKey::down:
        controls_.choose_next(1);
        break;
      case WindowKey::page_up:
        controls_.choose_next(-10);
        break;
      case WindowKey::page_down:
        controls_.choose_next(10);
        break;
      case WindowKey::left:
        controls_.change_chosen(-1);
        break;
      case WindowKey::right:
        controls_.change_chosen(1);
        break;
      case WindowKey::escape:
      case WindowKey::closed:
        return false;
      case WindowKey::letter:
        return obey_letter(events.letter);
      case WindowKey::none:
        break;
    }
    return true;
  }

  bool obey_letter(char letter) {
    switch (letter) {
      case '+':
      case '=':
        controls_.zoom(1.0);
        break;
      case '-':
        controls_.zoom(-1.0);
        break;
      case '[':
        controls_.change_step(0.5);
        break;
      case ']':
        controls_.change_step(2.0);
        break;
      case 'p':
        save();
        break;
      case 'r':
        controls_.reset();
        break;
      case ' ':
        time_runs_ = !time_runs_;
        break;
      case 'q':
        return false;
      default:
        break;
    }
    return true;
  }

  void save() {
    if (options_.save.empty()) {
      message_ = "nothing is written: no --save FILE was given";
      return;
    }
    try {
      // What this preview has written before it may write again.
      sim::write_whole(options_.save, sim::write_scene(controls_.scene(), "Made with vegard preview."),
                       options_.overwrite || saved_);
      saved_ = true;
      message_ = "written: " + options_.save;
    } catch (const sim::Error& error) {
      message_ = error.what();
    }
  }

  const PreviewOptions& options_;
  PreviewControls controls_;
  PreviewPace pace_;
  PreviewPainter painter_;
  std::unique_ptr<PreviewWindow> window_;
  ScreenPicture picture_;
  std::deque<double> last_ms_;
  std::string message_;
  Clock::time_point last_time_ = Clock::now();
  bool time_runs_, stale_ = true, saved_ = false;
};

}  // namespace

int run_preview_window(const sim::Scene& scene, const PreviewOptions& options) {
  if (!options.save.empty()) sim::WholeFile(options.save, options.overwrite);
  if (!display_answers())
    throw usage_error("DISPLAY", "no window can be opened", "a display that answers",
                      "-o DIR writes frames instead");
  return PreviewLoop(scene, options).run();
}

}  // namespace vegard::apps
