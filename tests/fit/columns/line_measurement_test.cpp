#include "fit/columns/line_measurement.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"

namespace vegard::fit::line_measurement_test {
namespace {

TEST(LineMeasurement, ReadsErrorsInRayleighsAndPerCent) {
  const LineMeasurement plain = line_measurement("427.8=2300");
  EXPECT_EQ(plain.wavelength_nm, 427.8);
  EXPECT_EQ(plain.rayleigh, 2300.0);
  EXPECT_FALSE(plain.error.has_value());
  for (const char* text : {"427.8=2300±50", "427.8=2300+-50", "427.8=2300 +/- 50", "427.80=2.3e3±50"})
    EXPECT_EQ(line_measurement(text).error->of(2300.0), 50.0) << text;
  EXPECT_DOUBLE_EQ(line_measurement("557.7=2000±3%").error->of(2000.0), 60.0);
  EXPECT_DOUBLE_EQ((BrightnessError{3.0, 0.04}.of(100.0)), 5.0);
}

TEST(LineMeasurement, RefusesWhatIsNone) {
  for (const char* text : {"", "427.8", "427.8=", "=2300", "427.8=-3±1", "427.8=2300±0", "427.8=2300±-5",
                           "427.8=2300±50x", "427.8=nan±5", "427.8=2300±inf", "500.0=2300±50",
                           "500.7=2300±50", "427.8=0±5%", "427.8=2300~50", "427.8=2300±"})
    EXPECT_THROW(line_measurement(text), sim::Error) << text;
  EXPECT_THROW(require_different_lines({427.8, 557.7, 427.8}, "--line"), sim::Error);
}

}  // namespace
}  // namespace vegard::fit::line_measurement_test
