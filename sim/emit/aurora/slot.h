// Slots: where a sheet's structures stand and when they live.
//
// The paper has folds at quasi-periodic places (section 3.1.1) and gives the lifetimes of folds and curls
// (section 2.2). Both are made of slots here, every one `spacing` long, counted from the zero of the
// coordinate along the sheet, each with one structure. A structure is a pure function of (seed, stream,
// address, slot, generation) and of the instant, so that a frame of an animation is the picture taken at that
// time.
#pragma once

#include <cstdint>

#include "sim/base/number/random.h"

namespace vegard::sim {

/// Which of a slot's structures, one after the other, lives at an instant, and how strong it is.
struct SlotLife {
  std::uint32_t generation = 0;
  double strength = 1.0;  ///< sin², 0 at birth and death; 1 for what lasts
};

/// The slot that a place along the sheet belongs to.
std::int64_t slot_at(double along_km, double spacing_km);

/// The life of a slot at an instant. With a lifetime of 0 there is one generation, which lasts.
SlotLife slot_life(std::uint64_t seed, Stream stream, std::uint32_t address, std::int64_t slot,
                   double instant_s, double lifetime_s);

/// The random numbers of one structure.
Words slot_words(std::uint64_t seed, Stream stream, std::uint32_t address, std::int64_t slot,
                 std::uint32_t generation);

}  // namespace vegard::sim
