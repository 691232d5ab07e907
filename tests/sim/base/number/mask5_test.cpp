// Masks: their sums, and how they are read.
#include "sim/base/number/mask5.h"

#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::mask5_test {
namespace {

std::string numbers(int count, const std::string& between = "\n") {
  std::string text;
  for (int i = 0; i < count; ++i) text += std::to_string(i) + between;
  return text;
}

ErrorDetails complaint(const std::string& text) {
  try {
    read_mask5(text, "mask.csv");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    return error.details();
  }
  ADD_FAILURE() << "it was read";
  return {};
}

TEST(Mask5, BlurAndSharpenSumToOneAndAreSymmetrical) {
  for (const Mask5& mask : {blur_mask(), sharpen_mask()}) {
    EXPECT_DOUBLE_EQ(mask.sum(), 1.0);
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        for (int k = -2; k <= 2; ++k) {
          EXPECT_EQ(mask.weights[Mask5::at(i, j, k)], mask.weights[Mask5::at(-i, j, -k)]);
          EXPECT_EQ(mask.weights[Mask5::at(i, j, k)], mask.weights[Mask5::at(k, i, j)]);
        }
  }
  EXPECT_DOUBLE_EQ(blur_mask().weights[Mask5::at(0, 0, 0)], 216.0 / 4096.0);
  EXPECT_DOUBLE_EQ(sharpen_mask().weights[Mask5::at(0, 0, 0)], 2.0 - 216.0 / 4096.0);
  EXPECT_DOUBLE_EQ(sharpen_mask().weights[Mask5::at(-2, 2, 2)], -1.0 / 4096.0);
}

TEST(Mask5, ReadsNumbersHoweverTheyAreSeparated) {
  const Mask5 lines = read_mask5(numbers(125), "m");
  EXPECT_EQ(lines.weights[Mask5::at(-2, -2, -2)], 0.0);
  EXPECT_EQ(lines.weights[Mask5::at(-2, -2, -1)], 1.0);
  EXPECT_EQ(lines.weights[Mask5::at(-1, -2, -2)], 25.0);
  EXPECT_EQ(lines.weights[Mask5::at(2, 2, 2)], 124.0);
  EXPECT_EQ(read_mask5("# mine: 1 2 3\n" + numbers(125, ", "), "m").weights, lines.weights);
  EXPECT_EQ(read_mask5(numbers(125, "\t\r\n"), "m").weights, lines.weights);
}

TEST(Mask5, RefusesWhatIsNoMaskAndSaysWhere) {
  EXPECT_EQ(complaint(numbers(124)).problem, "124 numbers");
  EXPECT_EQ(complaint(numbers(126)).line, 126);
  EXPECT_EQ(complaint("").problem, "0 numbers");
  const ErrorDetails word = complaint("1 2\n3 four\n");
  EXPECT_EQ(word.line, 2);
  EXPECT_EQ(word.file, "mask.csv");
  EXPECT_TRUE(tests::has_facts(word.problem, "'four'"));
  EXPECT_TRUE(tests::has_facts(complaint("1 inf").problem, "'inf'"));
  EXPECT_EQ(complaint("1 +").problem, "'+' is no number");
  const ErrorDetails large = complaint("1\n-1.1e6\n");
  EXPECT_EQ(large.line, 2);
  EXPECT_TRUE(tests::has_facts(large.problem, "-1.1e6"));
  EXPECT_TRUE(tests::has_facts(complaint("1 1e300").problem, "1e300"));
  EXPECT_EQ(read_mask5(numbers(124) + "-1e6", "m").weights[124], -1e6);
}

}  // namespace
}  // namespace vegard::sim::mask5_test
