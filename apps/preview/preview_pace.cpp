#include "apps/preview/preview_pace.h"

#include <algorithm>
#include <cstddef>

namespace vegard::apps {

bool PreviewPace::take(double ms) {
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
