// A progress bar for long work.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "fit/measurement/words.h"

namespace vegard::apps {

/// The state of work at some time after its start. Work that continues where another process stopped begins
/// with a jump; its remaining time is estimated from the pace since then.
struct ProgressPoint {
  double share = 0.0;
  double elapsed_seconds = 0.0;
};

/// Remaining seconds at the pace since `from`; none while too little is done for an estimate.
std::optional<double> seconds_to_go(const ProgressPoint& from, const ProgressPoint& now);

/// One line on stderr: the label, a bar, per cent, elapsed and remaining time. It appears only if stderr is a
/// terminal and the work has taken more than a second, and is erased when the work is done. All functions may
/// be called from any thread.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Sets the finished share, 0 to 1. A smaller share than before is ignored.
  void update(double share);

  /// Sets the share and a new label: another stage of the same work.
  void update(double share, const std::string& label);

  /// Elapsed time since the start, and remaining time; the latter is none while it is not known.
  double elapsed_seconds() const;
  std::optional<double> seconds_to_go() const;

  /// Erases the line, so that other text may follow.
  void finish();

 private:
  void note(double share);
  void show();

  using Clock = std::chrono::steady_clock;
  mutable std::mutex mutex_;
  std::string label_;
  bool on_terminal_;
  bool shown_ = false;
  double share_ = 0.0;
  ProgressPoint first_;  ///< the last state of the first second, in which nothing is shown
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

/// Returns what a map tells its progress to (fit/map/map_fit.h): a bar on a terminal, elsewhere one line a
/// stage. The bar goes with the last copy.
std::function<void(const std::string& stage, double chi2_per_value, double share)> map_progress();

/// Returns said() with a bar for each long work that is followed, on a terminal; lines erase it.
fit::Tell said_with_progress();

/// "4 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

/// The line that the bar shows, at most `columns` wide; never 100 %.
std::string progress_line(const std::string& label, const ProgressPoint& now,
                          std::optional<double> seconds_to_go, int columns);

}  // namespace vegard::apps
