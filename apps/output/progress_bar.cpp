#include "apps/output/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "apps/options/standard_streams.h"
#include "sim/base/file/number_text.h"

namespace vegard::apps {
namespace {

constexpr double kQuietSeconds = 1.0;
constexpr double kSecondsBetween = 0.1;

int terminal_columns() {
  winsize size = {};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

double seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

/// What the map reports while it works: a bar on a terminal, elsewhere one line a stage.
class MapAccount {
 public:
  void tell(const std::string& stage, double chi2_per_value, double share) {
    const std::string text = stage + ": chi2 / values " + sim::short_number(chi2_per_value, 3);
    bar_.update(share, text);
    if (isatty(STDERR_FILENO) == 1 || !stages_.insert(stage).second) return;
    const std::optional<double> to_go = bar_.seconds_to_go();
    tell_progress("%s (%s%s)\n", stage.c_str(), duration_text(bar_.elapsed_seconds()).c_str(),
                  to_go ? (", about " + duration_text(*to_go) + " to go").c_str() : "");
  }

 private:
  ProgressBar bar_{"mapping"};
  std::set<std::string> stages_;
};

}  // namespace

std::function<void(const std::string& stage, double chi2_per_value, double share)> map_progress() {
  return [account = std::make_shared<MapAccount>()](const std::string& stage, double chi2, double share) {
    account->tell(stage, chi2, share);
  };
}

std::string duration_text(double seconds) {
  const long whole = std::lround(std::clamp(seconds, 0.0, 1e8));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::optional<double> seconds_to_go(const ProgressPoint& from, const ProgressPoint& now) {
  constexpr double kMinShare = 0.02;  // before that the pace says nothing
  const double done = now.share - from.share;
  if (!(done >= kMinShare)) return {};
  return (now.elapsed_seconds - from.elapsed_seconds) * (1.0 - now.share) / done;
}

std::string progress_line(const std::string& label, const ProgressPoint& now,
                          std::optional<double> seconds_to_go, int columns) {
  const double share = std::clamp(now.share, 0.0, 1.0);
  // It goes when the work is done: as long as it shows, something is to do.
  std::string right = fmt::format(" {:3.0f} %, {}", std::min(99.0, std::round(100.0 * share)),
                                  duration_text(now.elapsed_seconds));
  if (seconds_to_go) right += ", " + duration_text(*seconds_to_go) + " to go";
  const int room = columns - 1 - static_cast<int>(label.size() + right.size()) - 4;
  std::string line = label;
  if (room >= 5) {
    const int length = std::min(room, 32);
    const int filled = static_cast<int>(share * length);
    line += " [" + std::string(filled, '#') + std::string(length - filled, '.') + "]";
  }
  line += right;
  if (static_cast<int>(line.size()) >= columns) line.resize(std::max(0, columns - 1));
  return line;
}

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), on_terminal_(isatty(STDERR_FILENO) == 1 && !voice().is_quiet) {}

ProgressBar::~ProgressBar() { finish(); }

void ProgressBar::update(double share) {
  const std::lock_guard<std::mutex> lock(mutex_);
  note(share);
  show();
}

void ProgressBar::update(double share, const std::string& label) {
  const std::lock_guard<std::mutex> lock(mutex_);
  note(share);
  label_ = label;
  show();
}

void ProgressBar::note(double share) {
  if (std::isfinite(share)) share_ = std::max(share_, std::min(share, 1.0));
  const double elapsed = seconds(Clock::now() - start_);
  if (elapsed < kQuietSeconds) first_ = {share_, elapsed};
}

double ProgressBar::elapsed_seconds() const { return seconds(Clock::now() - start_); }

std::optional<double> ProgressBar::seconds_to_go() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return apps::seconds_to_go(first_, {share_, elapsed_seconds()});
}

void ProgressBar::show() {
  const Clock::time_point now = Clock::now();
  const ProgressPoint point{share_, seconds(now - start_)};
  if (!on_terminal_ || point.elapsed_seconds < kQuietSeconds) return;
  if (shown_ && seconds(now - last_) < kSecondsBetween) return;
  last_ = now;
  shown_ = true;
  // \r and "erase to the end of the line".
  std::fprintf(stderr, "\r%s\033[K",
               progress_line(label_, point, apps::seconds_to_go(first_, point), terminal_columns()).c_str());
  std::fflush(stderr);
}

void ProgressBar::finish() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (shown_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

namespace {

/// The bar of the work that goes on; none between two.
class WorkBar {
 public:
  void update(const std::string& work, double share) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (work != work_) {
      bar_.emplace(work);
      work_ = work;
    }
    if (bar_) bar_->update(share);
    if (share < 1.0) return;
    bar_.reset();
    work_.clear();
  }
  void erase() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (bar_) bar_->finish();
  }

 private:
  std::mutex mutex_;
  std::string work_;
  std::optional<ProgressBar> bar_;
};

}  // namespace

fit::Tell said_with_progress() {
  const auto bar = std::make_shared<WorkBar>();
  const fit::Tell say_lines = said();
  return fit::Tell(
      [bar, say_lines](const std::string& line, fit::Tell::Tone tone) {
        bar->erase();
        say_lines(line, tone);
      },
      [bar](const std::string& work, double share) { bar->update(work, share); });
}

}  // namespace vegard::apps
