#include "sim/view/sensor/expected_counts.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/radiometry.h"
#include "sim/view/colour/sensor_response.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::expected_counts_test {
namespace {

Scene camera_scene() {
  Scene scene;
  scene.sensor.exposure = ExposureRule::camera;
  scene.time.exposure_s = 8.0;
  return scene;
}

const LineCounts& green(const ExpectedCounts& counts) { return counts.lines.at(1); }

TEST(ExpectedCounts, FollowFromPhotonsOnAPixel) {
  Scene scene = camera_scene();
  scene.sensor.f_number = 1.4;
  scene.sensor.lens_transmission = 0.8;
  scene.sensor.pixel_um = 5.0;
  scene.sensor.quantum_efficiency = 0.5;
  // 10^10 / 4 pi photons per m^2, s, sr and rayleigh; a cone of pi / (4 N^2); 25e-12 m^2.
  const double electrons = 1e3 * (1e10 / (4.0 * M_PI)) * M_PI / (4.0 * 1.96) * 0.8 * 25e-12 * 8.0 * 0.5;
  const ExpectedCounts counts = expected_counts(scene);
  EXPECT_NEAR(green(counts).electrons_per_kilorayleigh[1], electrons, 1e-9 * electrons);
  EXPECT_NEAR(counts.white_e, 50000.0 / 16.0, 1e-9);
  EXPECT_NEAR(green(counts).saturation_kilorayleigh, (counts.white_e - 0.8) / electrons, 1e-9 / electrons);
  const double largest = 16383.0, black = 0.03 * largest;
  EXPECT_NEAR(green(counts).dn_per_kilorayleigh[1], electrons / counts.white_e * (largest - black), 1e-6);
}

// The renderer's green channel and the counts are the same light.
TEST(ExpectedCounts, AreWhatTheGainOfThePictureSays) {
  for (const char* exposure : {"gain", "camera"}) {
    Scene scene = camera_scene();
    scene.sensor.exposure = tests::kind_named<ExposureRule>(exposure);
    const ExpectedCounts counts = expected_counts(scene);
    EXPECT_NEAR(green(counts).electrons_per_kilorayleigh[1] / counts.white_e, line_colours(scene)[1][1],
                1e-12);
  }
}

// The N2 bands reach from yellow to the infrared: their counts are those of all of them, not of the one that
// they are called by.
TEST(ExpectedCounts, OfASetOfBandsAreThoseOfAllOfThem) {
  Scene scene = camera_scene();
  scene.emission.lines = {670.5};
  scene.sensor.response = "nikon_d700";
  const double of_all = expected_counts(scene).lines.at(0).electrons_per_kilorayleigh[0];
  const ExpectedCounts counts = expected_counts(scene);
  EXPECT_NEAR(of_all / counts.white_e, line_colours(scene)[0][0], 1e-12 * of_all);
  const SensorResponse response(scene);
  const double of_one =
      response.rgb_per_kilorayleigh(670.5)[0] * gain_per_kilorayleigh(scene) * counts.white_e;
  EXPECT_GT(std::abs(of_all / of_one - 1.0), 0.2);
}

TEST(ExpectedCounts, AGivenGainDoesNotKnowTheLens) {
  Scene scene;
  const double gain = gain_per_kilorayleigh(scene);
  EXPECT_EQ(gain, 0.05);
  scene.sensor.f_number = 8.0;
  EXPECT_EQ(gain_per_kilorayleigh(scene), gain);
}

// ISO 12232 defines the saturation based speed as 78 lx s over the luminous exposure that fills the sensor.
// The default camera's full well is a round number near it: the light that fills it at ISO 1600 gives the
// speed 1600 back within a tenth.
TEST(ExpectedCounts, DefaultCameraHasTheSpeedOfTheStandard) {
  const Scene scene = camera_scene();
  const Sensor& s = scene.sensor;
  const double full_kilorayleigh = green(expected_counts(scene)).saturation_kilorayleigh;
  const double luminance = 1e3 * full_kilorayleigh * luminance_cd_m2_per_rayleigh(557.7);
  const double lux_s =
      M_PI * luminance * s.lens_transmission * scene.time.exposure_s / (4.0 * s.f_number * s.f_number);
  EXPECT_NEAR(78.0 / lux_s, s.iso, 0.1 * s.iso);
}

TEST(ExpectedCounts, SensitivityGoesWithTheIso) {
  Scene scene = camera_scene();
  const ExpectedCounts slow = expected_counts(scene);
  scene.sensor.iso *= 4.0;
  const ExpectedCounts fast = expected_counts(scene);
  EXPECT_DOUBLE_EQ(fast.white_e, slow.white_e / 4.0);
  EXPECT_DOUBLE_EQ(green(fast).electrons_per_kilorayleigh[1], green(slow).electrons_per_kilorayleigh[1]);
  EXPECT_NEAR(green(fast).dn_per_kilorayleigh[1], 4.0 * green(slow).dn_per_kilorayleigh[1], 1e-9);
  // Below the base ISO the pixel is full before the number.
  scene.sensor.iso = 50.0;
  EXPECT_DOUBLE_EQ(expected_counts(scene).saturation_e, scene.sensor.full_well_e);
}

TEST(ExpectedCounts, NoiseOfPhotonsDarkReadingAndRounding) {
  Scene scene = camera_scene();
  scene.sensor.dark_e_s = 2.0, scene.sensor.read_noise_e = 5.0, scene.sensor.bits = 16;
  const ExpectedCounts counts = expected_counts(scene);
  const double rounding_e = counts.white_e / (65535.0 * 0.97) / std::sqrt(12.0);
  EXPECT_NEAR(signal_to_noise(counts, 900.0),
              900.0 / std::sqrt(900.0 + 16.0 + 25.0 + rounding_e * rounding_e), 1e-9);
}

TEST(ExpectedCounts, UncertaintyIsKnownOrSaidNotToBe) {
  Scene scene = camera_scene();
  const ExpectedCounts by_data_sheet = expected_counts(scene);
  ASSERT_TRUE(by_data_sheet.relative_uncertainty);
  double squares = 0.0;
  for (const UncertaintyPart& part : by_data_sheet.parts) {
    EXPECT_GT(part.relative, 0.0);
    EXPECT_FALSE(part.source.empty()) << part.name;
    squares += part.relative * part.relative;
  }
  EXPECT_DOUBLE_EQ(*by_data_sheet.relative_uncertainty, std::sqrt(squares));

  scene.sensor.calibration_error = 0.01;
  scene.sensor.vignetting_cos_power = 4.0;
  const ExpectedCounts calibrated = expected_counts(scene);
  EXPECT_LT(*calibrated.relative_uncertainty, *by_data_sheet.relative_uncertainty);

  scene.sensor.calibration_error = 0.0;
  scene.sensor.exposure = ExposureRule::gain;
  EXPECT_FALSE(expected_counts(scene).relative_uncertainty);
}

}  // namespace
}  // namespace vegard::sim::expected_counts_test
