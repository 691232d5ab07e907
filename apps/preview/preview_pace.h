// Keeps the frame rate of a window: pictures become coarser if they take too long, and finer again if there
// is time.
#pragma once

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

}  // namespace vegard::apps
