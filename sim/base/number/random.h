// Random numbers as a pure function of (seed, stream, indices): Philox4x32-7.
//
// Source: Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11,
// doi:10.1145/2063384.2063405, who find seven rounds to be the fewest that pass all of BigCrush. There is no
// generator object and no state: the number (i, j) of a stream can be computed in any order and in any
// thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace vegard::sim {

/// The purpose of a random number. Numbers of different streams are independent.
enum class Stream : std::uint32_t {
  beam_spacing = 1,   ///< jitter of the beams along the arc, and their random depth
  cross_section = 2,  ///< position of a beam inside its layer
  path = 3,           ///< lengths and azimuths of a beam's deflections
  search = 5,         ///< trial points of a fit
  slot_life = 6,      ///< when the folds and curls of a slot begin
  fold = 7,           ///< position and stage of a fold
  curl = 8,           ///< position of a curl
  ray_light = 9,      ///< the light of rays
  ray_length = 10,    ///< extent of rays above the peak
  patch = 11,         ///< the light of patches
  border = 12,        ///< the undulation of the lower border
  footprint = 13,     ///< a footprint of fractal noise
  ripple = 14,        ///< ripples from which a footprint's flow starts
  spiral = 15,        ///< position of a spiral
  stars = 16,         ///< positions and colours of stars
  photon_noise = 24,  ///< a pixel's electrons
  read_noise = 25,    ///< read noise of a pixel
  nebula = 28,        ///< the noise of nebulae
  chromosphere = 29,  ///< the turbulence of chromospheres
  strand = 30,        ///< strands of loops
  bundle = 31,        ///< straight strands of the corona
  ensemble = 32,      ///< the walkers of a fit's sampler
  bootstrap = 33,     ///< which bands a fit's bootstrap draws
  flare = 34,         ///< when flares heat a strand of a loop
  physics = 35,       ///< numbers of physics within their uncertainty
  circle = 40,        ///< triples of points, in the search for a fisheye's circle
};

using Words = std::array<std::uint32_t, 4>;

namespace philox {
inline constexpr std::uint32_t kMultiplier0 = 0xD2511F53u, kMultiplier1 = 0xCD9E8D57u;
inline constexpr std::uint32_t kWeyl0 = 0x9E3779B9u, kWeyl1 = 0xBB67AE85u;
inline constexpr int kRounds = 7;
}  // namespace philox

/// Returns four words of 32 random bits for one counter and one key.
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

/// Returns the four words of a stream at the indices (i, j, k).
inline Words random_words(std::uint64_t seed, Stream stream, std::uint32_t i, std::uint32_t j = 0,
                          std::uint32_t k = 0) {
  return philox4x32({i, j, k, static_cast<std::uint32_t>(stream)}, random_key(seed));
}

/// Returns a uniform number in (0, 1), never 0 or 1: one of the 2^24 centres of equal cells, exact in a
/// float.
inline double uniform(std::uint32_t word) {
  return (static_cast<double>(word >> 8) + 0.5) * (1.0 / 16777216.0);
}

/// The same with 2^52 centres, exact in a double, for distributions whose tails matter.
inline double fine_uniform(std::uint32_t upper, std::uint32_t lower) {
  const std::uint64_t word = (static_cast<std::uint64_t>(upper) << 32 | lower) >> 12;
  return (static_cast<double>(word) + 0.5) * (1.0 / 4503599627370496.0);
}

// One step of a beam's path uses one word: its upper half is the length, its lower half the azimuth. Sixteen
// bits are enough for each. A step, at most a few kilometres, has one of 65536 lengths, centimetres apart;
// azimuths are 20 seconds of arc apart, which moves the end of a step by less than a millimetre. Both are
// centres of equal cells, so that their means are exact and their variances are too small by a relative
// 2^-32.

/// Returns a uniform number in (0, 1) from the upper half of a word: one of 2^16 centres.
inline double upper_uniform(std::uint32_t word) {
  return (static_cast<double>(word >> 16) + 0.5) * (1.0 / 65536.0);
}

/// The lower half of a word as an azimuth: its two upper bits are the signs of the cosine and the sine, which
/// select a quarter turn; the others are the position in it, from its middle, in units of a quarter turn: in
/// (-1/2, 1/2).
namespace azimuth_bits {
inline constexpr std::uint32_t kCosineSign = 0x8000u, kSineSign = 0x4000u, kPlace = 0x3fffu;
inline constexpr float kCell = 1.0f / 16384.0f, kFirst = 0.5f / 16384.0f - 0.5f;
}  // namespace azimuth_bits

/// Returns the 32-bit FNV-1a hash (Fowler, Noll and Vo; IETF draft-eastlake-fnv). With a stream by name, an
/// object keeps its noise when others are added or removed before it in the scene.
inline std::uint32_t name_number(const std::string& name) {
  std::uint32_t hash = 2166136261u;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
  return hash;
}

}  // namespace vegard::sim
