// How far long work has come, for someone who watches.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace vegard::apps {

/// One line on stderr: what is going on, a bar, per cent, time to go. It appears only if stderr is a terminal
/// and the work has taken more than a second, and is wiped when the work is done. Its calls may come from any
/// thread.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Finished share, 0 to 1. A share that falls back is shown as it was.
  void update(double share);

  /// The same with another label: a new stage of the same work.
  void update(double share, const std::string& label);

  /// Wipes the line, so that other text may follow.
  void finish();

 private:
  void show();

  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  std::string label_;
  bool on_terminal_;
  bool shown_ = false;
  double share_ = 0.0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

/// "4 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

/// The line that the bar shows, `columns` wide at most.
std::string progress_line(const std::string& label, double share, double elapsed_seconds, int columns);

}  // namespace vegard::apps
