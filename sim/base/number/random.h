// Random numbers as a pure function of (seed, stream, indices): Philox4x32-7.
//
// Source: Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11,
// doi:10.1145/2063384.2063405, who find seven rounds to be the fewest that pass all of BigCrush. There is no
// generator object and no state: whoever needs number (i, j) of a stream asks for it, in any order and on any
// thread.
#pragma once

#include <array>
#include <cstdint>

namespace vegard::sim {

/// What a random number is for. Numbers of different streams are independent.
enum class Stream : std::uint32_t {
  beam_spacing = 1,   ///< jitter of the beams along the arc, and their random depth
  cross_section = 2,  ///< place of a beam inside its layer
  path = 3,           ///< lengths and azimuths of a beam's deflections
  search = 5,         ///< trial points of a fit
  slot_life = 6,      ///< when the folds and curls of a slot begin
  fold = 7,           ///< where a fold stands and how far it has turned
  curl = 8,           ///< where a curl stands
  ray_light = 9,      ///< the light of rays
  ray_length = 10,    ///< their extent above the peak
  patch = 11,         ///< the light of patches
  border = 12,        ///< the undulation of the lower border
  footprint = 13,     ///< a footprint of fractal noise
  ripple = 14,        ///< what a footprint's flow starts from
  spiral = 15,        ///< where a spiral stands
  stars = 16,         ///< where stars stand, and their colours
  photon_noise = 24,  ///< a pixel's electrons
  read_noise = 25,    ///< and what reading them adds
  nebula = 28,        ///< the noise of nebulae
  chromosphere = 29,  ///< the turbulence of chromospheres
  strand = 30,        ///< strands of loops
  bundle = 31,        ///< lines of the corona
  ensemble = 32,      ///< the walkers of a fit's sampler
  bootstrap = 33,     ///< which bands a fit's bootstrap draws
  flare = 34,         ///< when flares heat a strand of a loop
  circle = 40,        ///< triples of points, in the search for a fisheye's circle
};

using Words = std::array<std::uint32_t, 4>;

namespace philox {
inline constexpr std::uint32_t kMultiplier0 = 0xD2511F53u, kMultiplier1 = 0xCD9E8D57u;
inline constexpr std::uint32_t kWeyl0 = 0x9E3779B9u, kWeyl1 = 0xBB67AE85u;
inline constexpr int kRounds = 7;
}  // namespace philox

/// Four words of 32 random bits for one counter and one key.
template <int kRounds = philox::kRounds>
Words philox4x32(Words counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t p0 = static_cast<std::uint64_t>(philox::kMultiplier0) * counter[0];
    const std::uint64_t p1 = static_cast<std::uint64_t>(philox::kMultiplier1) * counter[2];
    counter = {static_cast<std::uint32_t>(p1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(p1),
               static_cast<std::uint32_t>(p0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(p0)};
    key[0] += philox::kWeyl0;
    key[1] += philox::kWeyl1;
  }
  return counter;
}

inline std::array<std::uint32_t, 2> random_key(std::uint64_t seed) {
  return {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
}

/// Four words of a stream at the indices (i, j, k).
inline Words random_words(std::uint64_t seed, Stream stream, std::uint32_t i, std::uint32_t j = 0,
                          std::uint32_t k = 0) {
  return philox4x32({i, j, k, static_cast<std::uint32_t>(stream)}, random_key(seed));
}

/// Uniform in (0, 1), never 0 or 1, on the 2^24 centres that a float holds exactly.
inline double uniform(std::uint32_t word) {
  return (static_cast<double>(word >> 8) + 0.5) * (1.0 / 16777216.0);
}

/// Uniform in (0, 1), never 0 or 1, on 2^52 centres that a double holds: for tails that matter.
inline double fine_uniform(std::uint32_t upper, std::uint32_t lower) {
  const std::uint64_t word = (static_cast<std::uint64_t>(upper) << 32 | lower) >> 12;
  return (static_cast<double>(word) + 0.5) * (1.0 / 4503599627370496.0);
}

// One step of a beam's path takes one word, so that four words serve four steps: its upper half is the
// length, its lower half the azimuth. Sixteen bits are enough for either. A step, some kilometres at most,
// comes in 65536 lengths, centimetres apart; azimuths stand 20 seconds of arc apart, which moves the end of a
// step by less than a millimetre. Both are the centres of equal cells, so that their means are those of the
// continuous numbers, and their variances fall short by 2^-32 of themselves.

/// Uniform in (0, 1) from the upper half of a word, on 2^16 centres.
inline double upper_uniform(std::uint32_t word) {
  return (static_cast<double>(word >> 16) + 0.5) * (1.0 / 65536.0);
}

/// The lower half of a word as an azimuth: its two upper bits are the signs of the cosine and the sine, which
/// choose a quarter; the others are the place in that quarter, from its middle, in quarters: in (-1/2, 1/2).
namespace azimuth_bits {
inline constexpr std::uint32_t kCosineSign = 0x8000u, kSineSign = 0x4000u, kPlace = 0x3fffu;
inline constexpr float kCell = 1.0f / 16384.0f, kFirst = 0.5f / 16384.0f - 0.5f;
}  // namespace azimuth_bits

}  // namespace vegard::sim
