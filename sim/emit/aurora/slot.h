// Slots: the places and lifetimes of a sheet's structures.
//
// The paper has folds at quasi-periodic places (section 3.1.1) and gives the lifetimes of folds and curls
// (section 2.2). Here both are made from slots of the length `spacing`, which begin at the zero of the
// coordinate along the sheet and have one structure each. A structure is a pure function of (seed, stream,
// address, slot, generation) and of the instant, so that a frame of an animation is the picture taken at that
// time.
#pragma once

#include <cstdint>

#include "sim/base/number/random.h"

namespace vegard::sim {

/// Which of a slot's successive structures lives at an instant, and how strong it is.
struct SlotLife {
  std::uint32_t generation = 0;
  double strength = 1.0;  ///< sin², 0 at birth and death; 1 for what lasts
};

/// Returns the slot of a place along the sheet.
std::int64_t slot_at(double along_km, double spacing_km);

/// Returns the state of a slot at an instant. With a lifetime of 0 there is a single generation, which lasts.
SlotLife slot_life(std::uint64_t seed, Stream stream, std::uint32_t address, std::int64_t slot,
                   double instant_s, double lifetime_s);

/// Returns the random numbers of one structure.
Words slot_words(std::uint64_t seed, Stream stream, std::uint32_t address, std::int64_t slot,
                 std::uint32_t generation);

}  // namespace vegard::sim
