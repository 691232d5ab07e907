#include "fit/photo/mask/text.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/support/made_sky.h"

namespace vegard::fit::text_test {
namespace {

constexpr int kRows = 7, kColumns = 5;
/// A, U, R, O, 2, 0, 1, 4.
const std::array<std::array<const char*, kRows>, 8> kLetters = {{
    {".###.", "#...#", "#...#", "#####", "#...#", "#...#", "#...#"},
    {"#...#", "#...#", "#...#", "#...#", "#...#", "#...#", ".###."},
    {"####.", "#...#", "#...#", "####.", "#.#..", "#..#.", "#...#"},
    {".###.", "#...#", "#...#", "#...#", "#...#", "#...#", ".###."},
    {".###.", "#...#", "....#", "...#.", "..#..", ".#...", "#####"},
    {".###.", "#..##", "#.#.#", "#.#.#", "##..#", "#...#", ".###."},
    {"..#..", ".##..", "..#..", "..#..", "..#..", "..#..", ".###."},
    {"...#.", "..##.", ".#.#.", "#..#.", "#####", "...#.", "...#."},
}};

/// Draws letters of one colour, each stroke `scale` pixels wide; returns the pixels that are ink.
PixelSet write(Photo& photo, const std::vector<int>& letters, int left, int top, int scale,
               const std::array<float, 3>& ink) {
  PixelSet drawn(photo.linear.width, photo.linear.height);
  for (std::size_t i = 0; i < letters.size(); ++i)
    for (int y = 0; y < kRows * scale; ++y)
      for (int x = 0; x < kColumns * scale; ++x) {
        if (kLetters[letters[i]][y / scale][x / scale] != '#') continue;
        const int u = left + static_cast<int>(i) * (kColumns + 2) * scale + x, v = top + y;
        for (int c = 0; c < 3; ++c) photo.linear.at(u, v, c) = ink[c];
        drawn.at(u, v) = 1;
      }
  return drawn;
}

Photo sky(std::uint64_t seed) {
  Photo photo = tests::even_sky(400, 260, 0.02f);
  for (int y = 0; y < 260; ++y)
    for (int x = 0; x < 400; ++x)
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) += static_cast<float>(0.2 * std::exp(-std::pow((y - 140.0) / 40.0, 2)));
  tests::add_noise(photo, 0.002, seed);
  return photo;
}

/// Seed 51. White letters in front of the dark, and yellow ones in front of the aurora.
TEST(Text, IsFoundAndCovered) {
  Photo photo = sky(51);
  const PixelSet white = write(photo, {0, 1, 2, 3, 2, 0}, 8, 6, 2, {0.9f, 0.9f, 0.9f});
  const PixelSet yellow = write(photo, {4, 5, 6, 7, 5, 4}, 250, 130, 1, {0.9f, 0.8f, 0.1f});
  const std::vector<TextLine> lines = find_text(photo);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].letters, 6);
  EXPECT_EQ(lines[1].letters, 6);
  const PixelSet out = boxes(lines, 400, 260);
  for (std::size_t i = 0; i < out.in.size(); ++i) EXPECT_LE(white.in[i] | yellow.in[i], out.in[i]);
  // No more than the letters' own boxes and the border.
  EXPECT_LE(out.count(), (82u + 4u) * (14u + 4u) + (40u + 4u) * (7u + 4u));
}

/// Seed 52. Letters of different colours, letters that do not stand on a line, too few of them.
TEST(Text, IsALineOfOneColour) {
  Photo photo = sky(52);
  for (int i = 0; i < 6; ++i)
    write(photo, {i}, 10 + 14 * i, 8, 2, {i % 2 ? 0.9f : 0.2f, 0.9f, i % 3 ? 0.9f : 0.1f});
  for (int i = 0; i < 6; ++i) write(photo, {i}, 10 + 14 * i, 200 + (7 * i) % 12, 2, {0.9f, 0.9f, 0.9f});
  write(photo, {0, 1, 2, 3}, 200, 220, 2, {0.9f, 0.9f, 0.9f});
  EXPECT_TRUE(find_text(photo).empty());
}

/// Seed 53. Two hundred stars at random, rows of equal lights, rays.
TEST(Text, IsNotSeenInStarsLightsAndRays) {
  Photo photo = sky(53);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const sim::Words words = sim::random_words(53, sim::Stream::stars, i);
    tests::add_star(photo, 400 * sim::uniform(words[0]), 260 * sim::uniform(words[1]),
                    1.5 + 2.0 * sim::uniform(words[2]), 0.9 * sim::uniform(words[3]));
  }
  for (int i = 0; i < 12; ++i) tests::add_star(photo, 20.5 + 9 * i, 240.5, 3.0 + 0.2 * (i % 3), 0.9);
  for (int i = 0; i < 8; ++i) tests::add_ray(photo, 220.0 + 12 * i, 120.0, 90.0, 0.1, 3.0, 0.5);
  EXPECT_TRUE(find_text(photo).empty());
}

}  // namespace
}  // namespace vegard::fit::text_test
