#include "sim/base/file/number_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::number_text_test {
namespace {

TEST(NumberText, RoundsTheErrorToTwoDigitsAndTheValueToItsPlace) {
  EXPECT_EQ(number_with_error(4.32975, 0.1234), "4.33 \u00b1 0.12");
  EXPECT_EQ(number_with_error(-4.32975, 0.1234), "\u22124.33 \u00b1 0.12");
  EXPECT_EQ(number_with_error(220.1234, 3.21), "220.1 \u00b1 3.2");
  EXPECT_EQ(number_with_error(1234.5, 156.0), "1230 \u00b1 160");
  EXPECT_EQ(number_with_error(4.3, 0.0996), "4.30 \u00b1 0.10");  // not 0.100
  EXPECT_EQ(number_with_error(0.0, 0.5), "0.00 \u00b1 0.50");
  EXPECT_EQ(number_with_error(-0.001, 0.5), "0.00 \u00b1 0.50");  // no minus before nothing
}

TEST(NumberText, TakesPowersOfTenWhereNumbersAreHardToRead) {
  EXPECT_EQ(number_with_error(1.2e-7, 3.4e-8), "(1.20 \u00b1 0.34) \u00d7 10\u207b\u2077");
  EXPECT_EQ(number_with_error(5.0e9, 2.0e7), "(5.000 \u00b1 0.020) \u00d7 10\u2079");
  EXPECT_EQ(short_number(2.0e-9), "2 \u00d7 10\u207b\u2079");
}

TEST(NumberText, KeepsPlainNumbersPlain) {
  EXPECT_EQ(number_with_error(4.32975209, {}), "4.33");
  EXPECT_EQ(number_with_error(4.32975209, std::nan("")), "4.33");
  EXPECT_EQ(short_number(2147131.27, 6), "2147130");
  EXPECT_EQ(short_number(0.5), "0.5");
  EXPECT_EQ(short_number(-3000.0), "\u22123000");
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(INFINITY), "\u2013");
}

}  // namespace
}  // namespace vegard::sim::number_text_test
