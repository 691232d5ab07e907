// How far long work has come, for someone who watches.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

namespace vegard::apps {

/// Where work stood some time after its beginning. Work that goes on where another process has stopped jumps
/// ahead at once, and what it has left goes by the pace since then.
struct ProgressPoint {
  double share = 0.0;
  double elapsed_seconds = 0.0;
};

/// Seconds to go at the pace since `from`; none before that says anything.
std::optional<double> seconds_to_go(const ProgressPoint& from, const ProgressPoint& now);

/// One line on stderr: what is going on, a bar, per cent, time gone and time to go. It appears only if stderr
/// is a terminal and the work has taken more than a second, and is wiped when the work is done. Its calls may
/// come from any thread.
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

  /// Since the beginning, and to go; the latter none while it is not known.
  double elapsed_seconds() const;
  std::optional<double> seconds_to_go() const;

  /// Wipes the line, so that other text may follow.
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
  ProgressPoint first_;  ///< the last of the quiet second
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

/// "4 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

/// The line that the bar shows, `columns` wide at most; never 100 %.
std::string progress_line(const std::string& label, const ProgressPoint& now,
                          std::optional<double> seconds_to_go, int columns);

}  // namespace vegard::apps
