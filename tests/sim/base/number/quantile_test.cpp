#include "sim/base/number/quantile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::quantile_test {
namespace {

TEST(Quantile, IsAValueAsIfTheyWereSorted) {
  std::vector<double> values = {5.0, 1.0, 4.0, 2.0, 3.0, 6.0};
  EXPECT_EQ(nth_value(values, 0), 1.0);
  EXPECT_EQ(nth_value(values, 5), 6.0);
  EXPECT_EQ(median(values), 4.0);  // the upper one of 3 and 4
  EXPECT_EQ(quantile(values, 0.5), 3.0);
  EXPECT_EQ(quantile(values, 0.99), 5.0);
  EXPECT_EQ(quantile(values, 1.0), 6.0);
}

TEST(Quantile, OfNoValuesIsNone) {
  std::vector<float> none;
  EXPECT_TRUE(std::isnan(quantile(none, 0.5)));
  EXPECT_EQ(median(none), 0.0f);
}

}  // namespace
}  // namespace vegard::sim::quantile_test
