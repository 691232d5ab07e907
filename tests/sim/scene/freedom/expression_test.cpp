#include "sim/scene/freedom/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::expression_test {
namespace {

const std::vector<std::string> known = {"x", "y", "sheet.a.energy_kev", "sheet.far-off.energy_kev",
                                        "sheet.far-off.center_km.north"};

std::string error_of(const std::string& text) {
  return tests::expect_error(ErrorKind::scene, [&] { Expression(text, known); });
}

TEST(Expression, UsesNamesWithDotsAndHyphensInTheOrderOfTheirAppearance) {
  const Expression e("0.8*sheet.far-off.energy_kev-x + sheet.far-off.center_km.north-1e1", known);
  EXPECT_EQ(e.names(),
            (std::vector<std::string>{"sheet.far-off.energy_kev", "x", "sheet.far-off.center_km.north"}));
  EXPECT_DOUBLE_EQ(e.value({5.0, 1.0, 20.0}), 0.8 * 5.0 - 1.0 + 20.0 - 10.0);
  EXPECT_EQ(e.text(), "0.8*sheet.far-off.energy_kev-x + sheet.far-off.center_km.north-1e1");
  EXPECT_TRUE(Expression("3", known).names().empty());
}

TEST(Expression, KnowsTheUsualPrecedence) {
  const auto value = [](const std::string& text) { return Expression(text, {}).value({}); };
  EXPECT_EQ(value("2 + 3 * 4 ^ 2 / 8 - 1"), 7.0);
  EXPECT_EQ(value("-2 ^ 2"), -4.0);
  EXPECT_EQ(value("2 ^ 3 ^ 2"), 512.0);
  EXPECT_EQ(value("(2 + 3) * .5"), 2.5);
  EXPECT_EQ(value("max(2, min(7, 5)) + abs(-1)"), 6.0);
}

/// Every function, and a formula of several names, against derivatives by hand.
TEST(Expression, ItsSlopesAreThoseOfClosedForms) {
  constexpr double pi = 3.14159265358979323846;
  struct Case {
    std::string text;
    std::function<double(double)> slope;
  };
  const Case cases[] = {
      {"0.8 * x", [](double) { return 0.8; }},
      {"x ^ 3 / 7", [](double x) { return 3.0 * x * x / 7.0; }},
      {"pow(x, 2.5)", [](double x) { return 2.5 * std::pow(x, 1.5); }},
      {"2 ^ x", [](double x) { return std::log(2.0) * std::pow(2.0, x); }},
      {"sin(x)", [](double x) { return std::cos(x); }},
      {"cos(x)", [](double x) { return -std::sin(x); }},
      {"tan(x)", [](double x) { return 1.0 / std::pow(std::cos(x), 2); }},
      {"sin_deg(x)", [](double x) { return pi / 180.0 * std::cos(x * pi / 180.0); }},
      {"cos_deg(x)", [](double x) { return -pi / 180.0 * std::sin(x * pi / 180.0); }},
      {"tan_deg(x)", [](double x) { return pi / 180.0 / std::pow(std::cos(x * pi / 180.0), 2); }},
      {"exp(-x)", [](double x) { return -std::exp(-x); }},
      {"log(x)", [](double x) { return 1.0 / x; }},
      {"sqrt(x)", [](double x) { return 0.5 / std::sqrt(x); }},
      {"atan2(x, 2)", [](double x) { return 2.0 / (4.0 + x * x); }},
      {"abs(x)", [](double) { return 1.0; }},
      {"1000 + pi * x", [](double) { return pi; }},
  };
  for (const Case& c : cases)
    for (const double x : {1e-5, 0.02, 0.7, 1.3, 2.9}) {
      const Expression e(c.text, known);
      const double expected = c.slope(x);
      // Truncation: the fourth power of the step (of the smallest value, whose step has a floor, 2 %), times
      // a derivative's size. Rounding: that of the value over the step, some of which the extrapolation adds.
      const double step = std::max(x, 1e-3) / 4096.0;
      const double truncation = std::pow(step / x, 4) * std::abs(expected);
      const double rounding = 4.0 * 0x1p-52 * std::max(1.0, std::abs(e.value({x}))) / step;
      EXPECT_NEAR(e.slopes({x})[0], expected, truncation + rounding) << c.text << " at " << x;
    }
  const Expression e("x * cos(y) - y / x", known);
  const std::vector<double> slopes = e.slopes({3.0, 0.4});
  ASSERT_EQ(slopes.size(), 2u);
  EXPECT_NEAR(slopes[0], std::cos(0.4) + 0.4 / 9.0, 1e-11);
  EXPECT_NEAR(slopes[1], -3.0 * std::sin(0.4) - 1.0 / 3.0, 1e-11);
  EXPECT_NEAR(Expression("x * y", known).slopes({0.0, 5.0})[0], 5.0, 1e-9) << "at 0";
}

TEST(Expression, HasNoValueWhereAFormulaHasNone) {
  EXPECT_FALSE(std::isfinite(Expression("sqrt(x)", known).value({-1.0})));
  EXPECT_FALSE(std::isfinite(Expression("1 / x", known).value({0.0})));
}

TEST(Expression, SaysWhatItDoesNotUnderstandAndWhere) {
  const auto says = [](const std::string& text, const std::string& words) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find(words), std::string::npos) << text << ": " << error;
  };
  says("2 * z", "an unknown name, 'z'");
  says("sheet.far-off.enrgy_kev", "did you mean 'sheet.far-off.energy_kev'?");
  says("sheet.a.energy_key", "did you mean 'sheet.a.energy_kev'?");
  says("sine(x)", "did you mean 'sin'?");
  says("x + * y", "at character 5, '* y'");
  says("x +", "at its end");
  says("x y", "at character 3, 'y'");
  says("2 x", "at character 3, 'x'");
  says("sheet.a.energy_kev * ) x", "at character 22, ') x'");
  says("(x + 1", "a parenthesis that is not closed");
  says("x = 3", "at character 3, '= 3'");
  says("x > 3 ? 1 : 2", "at character 3");
  says("x, y", "");
  says("sin(x, y)", "too many arguments");
  says("pow(x)", "too few arguments");
  says("", "empty");
  says("  ", "");
  says("1,5", "");
  says("v0", "unknown name, 'v0'");
  says("0x1F", "unknown name, 'x1F'");
}

}  // namespace
}  // namespace vegard::sim::expression_test
