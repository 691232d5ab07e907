#include "sim/emit/aurora/slot.h"

#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::sim {
namespace {}  // namespace

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

}  // namespace vegard::sim
