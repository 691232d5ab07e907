#include "sim/base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>

namespace vegard::sim {
namespace {

TEST(Philox, GivesTheKnownAnswersOfRandom123) {
  // kat_vectors of Random123 (Salmon et al. 2011), philox4x32 with 10 rounds.
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
  constexpr std::uint32_t kOnes = 0xffffffffu;
  EXPECT_EQ(philox4x32({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (Words{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
  EXPECT_EQ(philox4x32({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u}),
            (Words{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}));
}

TEST(RandomWords, DifferBetweenStreamsIndicesAndSeeds) {
  std::set<Words> seen;
  int asked = 0;
  for (std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32})
    for (Stream stream : {Stream::beam_spacing, Stream::cross_section, Stream::path, Stream::search})
      for (std::uint32_t i = 0; i < 4; ++i)
        for (std::uint32_t j = 0; j < 4; ++j)
          for (std::uint32_t k = 0; k < 4; ++k, ++asked) seen.insert(random_words(seed, stream, i, j, k));
  EXPECT_EQ(static_cast<int>(seen.size()), asked);
}

TEST(RandomWords, AreAFunctionOfTheirAddressOnly) {
  const Words first = random_words(7, Stream::path, 3, 5, 9);
  random_words(7, Stream::path, 4, 5, 9);
  EXPECT_EQ(random_words(7, Stream::path, 3, 5, 9), first);
}

TEST(Uniform, LiesStrictlyInsideTheUnitInterval) {
  EXPECT_EQ(uniform(0), 0.5 / 16777216.0);
  EXPECT_EQ(uniform(0xffffffffu), 1.0 - 0.5 / 16777216.0);
}

/// Chi-square of 64 equal bins.
double chi_square(const std::array<int, 64>& bins, int count) {
  double sum = 0.0;
  const double expected = count / 64.0;
  for (int n : bins) sum += (n - expected) * (n - expected) / expected;
  return sum;
}

TEST(PathStream, AzimuthsAndLengthsAreUniformByChiSquare) {
  // Words 1 and 3 turn the azimuth, 0 and 2 the length (fall-inl.h). Seed 20, 400 beams of 300 pairs of
  // steps. The two-sided 0.2 % limits of chi-square with 63 degrees of freedom are 32.5 and 103.4.
  std::array<std::array<int, 64>, 4> bins{};
  std::array<std::array<int, 64>, 2> azimuth_pairs{};
  int count = 0;
  for (std::uint32_t beam = 0; beam < 400; ++beam) {
    for (std::uint32_t pair = 0; pair < 300; ++pair, ++count) {
      const Words words = random_words(20, Stream::path, pair, beam, 0);
      for (int w = 0; w < 4; ++w) ++bins[w][static_cast<int>(uniform(words[w]) * 64.0)];
      const int octant1 = static_cast<int>(uniform(words[1]) * 8.0);
      ++azimuth_pairs[0][octant1 * 8 + static_cast<int>(uniform(words[3]) * 8.0)];
      ++azimuth_pairs[1][octant1 * 8 + static_cast<int>(uniform(words[0]) * 8.0)];
    }
  }
  for (int w = 0; w < 4; ++w) {
    EXPECT_LT(chi_square(bins[w], count), 103.4) << "word " << w;
    EXPECT_GT(chi_square(bins[w], count), 32.5) << "word " << w << " is too even to be random";
  }
  EXPECT_LT(chi_square(azimuth_pairs[0], count), 103.4) << "azimuths of neighbouring steps";
  EXPECT_LT(chi_square(azimuth_pairs[1], count), 103.4) << "azimuth and length of a step";
}

}  // namespace
}  // namespace vegard::sim
