#include "sim/emit/aurora/fold.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/smooth_step.h"

namespace vegard::sim {
namespace {

// At stage 0 a fold still departs from the sine, by metres. So that it does not jump there when it is born,
// it grows out of the sine while its strength is below this.
constexpr double kWholeFrom = 0.25;

}  // namespace

Folds::Folds(const Sheet& sheet, std::uint32_t arc_address, std::uint64_t seed, double instant_s,
             double drifted_km)
    : seed_(seed),
      address_(arc_address),
      spacing_km_(sheet.fold_spacing_km),
      length_km_(sheet.fold_length_km),
      jitter_(sheet.fold_spacing_jitter),
      stage_spread_(sheet.fold_stage_spread),
      lifetime_s_(sheet.fold_lifetime_s),
      instant_s_(instant_s),
      moved_km_(drifted_km + sheet.fold_speed_km_s * instant_s) {}

Fold Folds::at(double along_km) const {
  if (!any()) return {};
  const double a = along_km - moved_km_;
  const std::int64_t slot = slot_at(a, spacing_km_);
  const SlotLife life = slot_life(seed_, Stream::fold, address_, slot, instant_s_, lifetime_s_);
  const Words words = slot_words(seed_, Stream::fold, address_, slot, life.generation);
  // A fold keeps to its slot, so it never overlaps with its neighbours.
  const double room = 1.0 - length_km_ / spacing_km_;
  const double center =
      (static_cast<double>(slot) + 0.5 + jitter_ * (uniform(words[0]) - 0.5) * room) * spacing_km_;
  Fold fold;
  fold.from_center_km = a - center;
  fold.half_km = 0.5 * length_km_;
  fold.here = std::abs(fold.from_center_km) < fold.half_km && life.strength > 0.0;
  fold.stage = (1.0 - stage_spread_ * uniform(words[1])) * life.strength;
  fold.presence = smooth_step(life.strength / kWholeFrom);
  return fold;
}

}  // namespace vegard::sim
