#include "fit/parameters/free_parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/base/error.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/free_paths.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::free_parameters_test {
namespace {

sim::FreeParameter entry(const std::string& path) {
  sim::FreeParameter free;
  free.path = path;
  return free;
}

/// Every number of the small scene that may be free, with the table's limits.
std::vector<FreeNumber> all_numbers(sim::Scene& scene) {
  for (const tests::FreePath& p : tests::free_paths(scene)) scene.fit.free.push_back(entry(p.path.text));
  return free_numbers(scene);
}

TEST(FreeNumber, CoordinatesComeBackAsValues) {
  sim::Scene scene = tests::small_scene();
  for (const FreeNumber& number : all_numbers(scene)) {
    for (double share : {0.01, 0.3, 0.5, 0.97}) {
      const double value = number.logarithmic() ? number.min * std::pow(number.max / number.min, share)
                                                : number.min + share * (number.max - number.min);
      EXPECT_NEAR(number.value(number.coordinate(value)), value, 1e-9 * (std::abs(value) + 1.0))
          << number.path;
    }
  }
}

TEST(FreeNumber, SlopeIsTheDerivativeOfTheValue) {
  sim::Scene scene = tests::small_scene();
  for (const FreeNumber& number : all_numbers(scene)) {
    for (double u : {-3.0, -0.2, 0.0, 1.7}) {
      constexpr double h = 1e-5;
      const double difference = (number.value(u + h) - number.value(u - h)) / (2 * h);
      EXPECT_NEAR(number.slope(u), difference, 1e-6 * std::abs(difference) + 1e-12) << number.path;
      EXPECT_GT(number.slope(u), 0.0);
    }
  }
}

TEST(FreeNumber, OneSidedAndUnboundedTransformsInvertToo) {
  sim::Scene scene = tests::small_scene();
  FreeNumber number = all_numbers(scene)[0];
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const char* path : {"sheet.main.energy_kev", "sheet.main.center_km.east"}) {
    number.id = sim::parameter_at(scene, path).value();
    number.min = number.id.row->scale == sim::ParameterScale::logarithmic ? 0.5 : -kInfinity;
    number.max = kInfinity;
    for (double value : {0.7, 3.0, 400.0}) {
      const double u = number.coordinate(value);
      EXPECT_NEAR(number.value(u), value, 1e-9 * value);
      EXPECT_NEAR(number.slope(u), (number.value(u + 1e-6) - number.value(u - 1e-6)) / 2e-6, 1e-6 * value);
    }
  }
}

TEST(FreeNumber, NeverLeavesItsLimitsAndSaysWhenItIsAtOne) {
  sim::Scene scene = tests::small_scene();
  scene.fit.free.push_back(entry("sheet.main.energy_kev"));
  scene.fit.free[0].min = 1.0;
  scene.fit.free[0].max = 10.0;
  const FreeNumber number = free_numbers(scene)[0];
  EXPECT_TRUE(number.logarithmic());
  for (double u : {-1e6, -40.0, 0.0, 40.0, 1e6}) {
    EXPECT_GE(number.value(u), 1.0);
    EXPECT_LE(number.value(u), 10.0) << "or a best scene would not be read again";
  }
  EXPECT_NEAR(number.value(0.0), std::sqrt(10.0), 1e-12) << "the middle of the logarithm";
  EXPECT_TRUE(std::isfinite(number.coordinate(1.0)));
  EXPECT_TRUE(std::isfinite(number.coordinate(10.0)));
  EXPECT_TRUE(std::isfinite(number.coordinate(0.0))) << "below the limit it is moved inside";
  EXPECT_TRUE(number.at_limit(1.0));
  EXPECT_TRUE(number.at_limit(number.value(number.coordinate(10.0))));
  EXPECT_TRUE(number.at_limit(1.002));
  EXPECT_FALSE(number.at_limit(1.003));
  EXPECT_FALSE(number.at_limit(9.9));
}

TEST(FreeNumbers, TakeVectorsApartAndStartWhereTheEntrySays) {
  sim::Scene scene = tests::small_scene();
  scene.fit.free = {entry("sheet.main.center_km"), entry("sheet.main.energy_kev")};
  scene.fit.free[1].start = 4.5;
  scene.fit.free[1].prior = sim::Prior{5.0, 1.0};
  const std::vector<FreeNumber> numbers = free_numbers(scene);
  ASSERT_EQ(numbers.size(), 3u);
  EXPECT_EQ(numbers[0].path, "sheet.main.center_km.east");
  EXPECT_EQ(numbers[0].start, 10.0);
  EXPECT_EQ(numbers[1].start, 190.0);
  EXPECT_EQ(numbers[2].start, 4.5);
  ASSERT_TRUE(numbers[2].prior);
  EXPECT_EQ(numbers[2].prior->mean, 5.0);
}

TEST(FreeNumbers, OfASceneWithoutAnyIsTheUsersError) {
  EXPECT_THROW(free_numbers(tests::small_scene()), sim::Error);
}

}  // namespace
}  // namespace vegard::fit::free_parameters_test
