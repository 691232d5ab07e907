// Keeps the frame rate of a window: pictures become coarser if they take too long, and finer again if there
// is time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sim/render/reduced_scene.h"

namespace vegard::apps {

class PreviewPace {
 public:
  PreviewPace(const sim::Reduction& start, double frames_per_second)
      : reduction_(start), start_points_(start.points), wanted_ms_(1000.0 / frames_per_second) {}

  const sim::Reduction& reduction() const { return reduction_; }

  /// Takes the time for one picture. Returns true if the next ones must be coarser or finer.
  bool take(double ms);

 private:
  static constexpr int kCoarsestShrink = 6;
  static constexpr double kFewestPoints = 3e5;

  sim::Reduction reduction_;
  double start_points_, wanted_ms_;
  std::vector<double> last_ms_;  ///< since the last decision
};

inline bool PreviewPace::take(double ms) {
  // The first picture of a new kind also makes what later ones keep.
  constexpr std::size_t kJudged = 6;
  last_ms_.push_back(ms);
  if (last_ms_.size() < kJudged) return false;
  std::vector<double> sorted(last_ms_.begin() + 1, last_ms_.end());
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  last_ms_.clear();
  const sim::Reduction before = reduction_;
  if (median > 1.1 * wanted_ms_) {
    reduction_.shrink = std::min(kCoarsestShrink, reduction_.shrink + 1);
    reduction_.points = std::max(kFewestPoints, 0.6 * reduction_.points);
  } else if (median < 0.35 * wanted_ms_) {
    // A step of shrink costs at most four times as much, so that it does not have to be taken back.
    if (reduction_.shrink > 1 && (reduction_.shrink > 2 || median < 0.22 * wanted_ms_)) --reduction_.shrink;
    reduction_.points = std::min(start_points_, reduction_.points / 0.6);
  }
  return reduction_.shrink != before.shrink || reduction_.points != before.points;
}

}  // namespace vegard::apps
