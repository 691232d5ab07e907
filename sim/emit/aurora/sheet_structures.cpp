#include "sim/emit/aurora/sheet_structures.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
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

std::int64_t slot_at(double along_km, double spacing_km) {
  return static_cast<std::int64_t>(std::floor(along_km / spacing_km));
}

SlotLife slot_life(std::uint64_t seed, Stream stream, std::uint32_t address, std::int64_t slot,
                   double instant_s, double lifetime_s) {
  if (lifetime_s <= 0.0) return {};
  // Slots do not begin together.
  const Words words = random_words(seed, Stream::slot_life, static_cast<std::uint32_t>(slot), address,
                                   static_cast<std::uint32_t>(stream));
  const double lives = instant_s / lifetime_s + uniform(words[0]);
  const double generation = std::floor(lives);
  const double sine = std::sin(kPi * (lives - generation));
  return {static_cast<std::uint32_t>(static_cast<std::int64_t>(generation)), sine * sine};
}

Words slot_words(std::uint64_t seed, Stream stream, std::uint32_t address, std::int64_t slot,
                 std::uint32_t generation) {
  return random_words(seed, stream, static_cast<std::uint32_t>(slot), address, generation);
}

Curls::Curls(const Sheet& sheet, std::uint32_t layer_address, std::uint64_t seed, double instant_s,
             double drifted_km)
    : seed_(seed),
      address_(layer_address),
      spacing_km_(sheet.curl_spacing_km),
      radius_km_(sheet.curl_radius_km),
      gather_(sheet.curl_gather),
      turn_rad_(sheet.curl_turn_rad),
      lifetime_s_(sheet.curl_lifetime_s),
      instant_s_(instant_s),
      moved_km_(drifted_km + sheet.curl_speed_km_s * instant_s) {}

Curls Curls::spirals(const Sheet& sheet, std::uint32_t arc_address, std::uint64_t seed, double instant_s,
                     double drifted_km) {
  Curls spirals;
  spirals.stream_ = Stream::spiral;
  spirals.seed_ = seed;
  spirals.address_ = arc_address;
  spirals.spacing_km_ = sheet.spiral_spacing_km;
  spirals.radius_km_ = sheet.spiral_radius_km;
  spirals.turn_rad_ = -sheet.spiral_turn_rad;
  spirals.lifetime_s_ = sheet.spiral_lifetime_s;
  spirals.instant_s_ = instant_s;
  spirals.moved_km_ = drifted_km + sheet.spiral_speed_km_s * instant_s;
  return spirals;
}

Curl Curls::of_slot(std::int64_t slot) const {
  const SlotLife life = slot_life(seed_, stream_, address_, slot, instant_s_, lifetime_s_);
  const Words words = slot_words(seed_, stream_, address_, slot, life.generation);
  const double place = 0.25 + 0.5 * uniform(words[0]);  // jittered by a half spacing
  return {(static_cast<double>(slot) + place) * spacing_km_ + moved_km_, radius_km_, gather_ * life.strength,
          turn_rad_ * life.strength};
}

}  // namespace vegard::sim
