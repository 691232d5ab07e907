#include "sim/base/number/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>

namespace vegard::sim::random_test {
namespace {

TEST(Philox, GivesTheKnownAnswersOfRandom123) {
  // kat_vectors of Random123 (Salmon et al. 2011), philox4x32 with 7 rounds, which are ours, and with 10.
  constexpr std::uint32_t kOnes = 0xffffffffu;
  const Words zeros{0, 0, 0, 0}, ones{kOnes, kOnes, kOnes, kOnes},
      pi{0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u};
  EXPECT_EQ(philox4x32(zeros, {0, 0}), (Words{0x5f6fb709u, 0x0d893f64u, 0x4f121f81u, 0x4f730a48u}));
  EXPECT_EQ(philox4x32(ones, {kOnes, kOnes}), (Words{0x5207ddc2u, 0x45165e59u, 0x4d8ee751u, 0x8c52f662u}));
  EXPECT_EQ(philox4x32(pi, {0xa4093822u, 0x299f31d0u}),
            (Words{0x4dfccabau, 0x190a87f0u, 0xc47362bau, 0xb6b5242au}));
  EXPECT_EQ(philox4x32<10>(zeros, {0, 0}), (Words{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
  EXPECT_EQ(philox4x32<10>(ones, {kOnes, kOnes}),
            (Words{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
  EXPECT_EQ(philox4x32<10>(pi, {0xa4093822u, 0x299f31d0u}),
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

TEST(UpperUniform, LiesStrictlyInsideTheUnitIntervalWithTheMeanOfOne) {
  EXPECT_EQ(upper_uniform(0x0000ffffu), 0.5 / 65536.0);
  EXPECT_EQ(upper_uniform(0xffff0000u), 1.0 - 0.5 / 65536.0);
  double sum = 0.0;
  for (std::uint32_t upper = 0; upper < 65536; ++upper) sum += upper_uniform(upper << 16);
  EXPECT_EQ(sum / 65536.0, 0.5);
}

TEST(PathStream, AzimuthsAndLengthsAreUniformByChiSquare) {
  // Of each word the upper half is a length, the lower an azimuth (random.h), one word to a step
  // (fall-inl.h). Seed 20, 400 beams of 150 quads of steps. The two-sided 0.2 % limits of chi-square with 63
  // degrees of freedom are 32.5 and 103.4.
  std::array<std::array<int, 64>, 8> bins{};
  std::array<std::array<int, 64>, 4> pairs{};
  const auto count_pair = [](std::array<int, 64>& table, std::uint32_t a, std::uint32_t b) {
    ++table[(a >> 13) * 8 + (b >> 13)];
  };
  int count = 0;
  for (std::uint32_t beam = 0; beam < 400; ++beam) {
    for (std::uint32_t quad = 0; quad < 150; ++quad, ++count) {
      const Words words = random_words(20, Stream::path, quad, beam, 0);
      std::uint32_t length[4], azimuth[4];
      for (int w = 0; w < 4; ++w) {
        length[w] = words[w] >> 16;
        azimuth[w] = words[w] & 0xffffu;
        ++bins[2 * w][length[w] >> 10];
        ++bins[2 * w + 1][azimuth[w] >> 10];
      }
      count_pair(pairs[0], azimuth[0], azimuth[1]);
      count_pair(pairs[1], azimuth[2], azimuth[3]);
      count_pair(pairs[2], azimuth[0], length[0]);
      count_pair(pairs[3], length[0], length[1]);
    }
  }
  for (int w = 0; w < 8; ++w) {
    EXPECT_LT(chi_square(bins[w], count), 103.4) << "half " << w;
    EXPECT_GT(chi_square(bins[w], count), 32.5) << "half " << w << " is too even to be random";
  }
  EXPECT_LT(chi_square(pairs[0], count), 103.4) << "azimuths of neighbouring steps";
  EXPECT_LT(chi_square(pairs[1], count), 103.4) << "azimuths of neighbouring steps";
  EXPECT_LT(chi_square(pairs[2], count), 103.4) << "azimuth and length of a step";
  EXPECT_LT(chi_square(pairs[3], count), 103.4) << "lengths of neighbouring steps";
}

}  // namespace
}  // namespace vegard::sim::random_test
