#include "sim/view/colour/sensor_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "sim/base/error.h"
#include "sim/scene/structs/sensor.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"

namespace vegard::sim::sensor_response_test {
namespace {

Scene with(const std::string& response, WhiteBalanceRule balance = WhiteBalanceRule::given,
           MatrixRule matrix = MatrixRule::none) {
  Scene scene;
  scene.sensor.response = response;
  scene.sensor.white_balance_rule = balance;
  scene.sensor.matrix_rule = matrix;
  return scene;
}

Scene with_table(const std::string& text) {
  Scene scene = with("own.csv");
  scene.tables["sensor.response"] = text;
  return scene;
}

Vector3 of_daylight(const SensorResponse& response) {
  Vector3 sum{};
  for (double nm = 380.0; nm <= 780.0; nm += 5.0) {
    const Vector3 rgb = product(response.rgb_from_channels(), response.channels_of_power(nm));
    for (int c = 0; c < 3; ++c) sum[c] += daylight_power(nm, kD65Temperature_k) * rgb[c];
  }
  return sum;
}

TEST(SensorResponse, OfTheObserverCountsPhotonsAndGreenHasLuminanceOne) {
  const SensorResponse cie{Scene()};
  const Vector3 green = cie.rgb_per_kilorayleigh(557.7);
  // BT.709 luminance, four digits.
  EXPECT_NEAR(0.2126 * green[0] + 0.7152 * green[1] + 0.0722 * green[2], 1.0, 4e-4);
  for (const double nm : {630.0, 427.8})
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(cie.rgb_per_kilorayleigh(nm)[c] / green[1],
                  rgb_of_line(nm, Primaries::srgb)[c] / rgb_of_line(557.7, Primaries::srgb)[1] * 557.7 / nm,
                  1e-12);
  EXPECT_EQ(rgb_from_raw(Scene()), kIdentity3);
}

TEST(SensorResponse, ScaleIsRawGreenOf557) {
  for (const std::string& camera : built_in_cameras()) {
    const Scene scene = with(camera);
    EXPECT_NEAR(SensorResponse(scene).rgb_per_kilorayleigh(557.7)[1], 1.0, 1e-12) << camera;
    EXPECT_EQ(rgb_from_raw(scene), kIdentity3) << camera;
    EXPECT_EQ(line_colours_at_unit_gain(scene)[1], SensorResponse(scene).rgb_per_kilorayleigh(557.7));
  }
}

TEST(SensorResponse, DaylightBalanceMakesD65Neutral) {
  for (const std::string& camera : built_in_cameras())
    for (const MatrixRule matrix : {MatrixRule::none, MatrixRule::colorimetric}) {
      const Vector3 white = of_daylight(SensorResponse(with(camera, WhiteBalanceRule::daylight, matrix)));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c] / white[1], 1.0, 1e-12) << camera << word_of(matrix);
      const Vector3 raw = of_daylight(SensorResponse(with(camera)));
      EXPECT_GT(std::abs(raw[0] / raw[1] - 1.0), 0.05) << "a camera is not neutral by itself";
    }
}

TEST(SensorResponse, BalanceAndMatrixLeadFromRawToPictures) {
  Scene scene = with("nikon_d700");
  scene.sensor.white_balance = {2.0, 1.0, 1.5};
  scene.sensor.matrix_rule = MatrixRule::given;
  scene.sensor.matrix = {1.5, -0.5, 0.0, -0.2, 1.4, -0.2, 0.1, -0.6, 1.5};
  const Vector3 raw = SensorResponse(with("nikon_d700")).rgb_per_kilorayleigh(427.8);
  const Vector3 rgb = SensorResponse(scene).rgb_per_kilorayleigh(427.8);
  const Vector3 led = product(rgb_from_raw(scene), raw);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], led[c], 1e-12);
  EXPECT_NEAR(rgb[0], 1.5 * 2.0 * raw[0] - 0.5 * raw[1], 1e-12);
}

TEST(SensorResponse, RefusesWhatHasNoWayBackToRawChannels) {
  Scene scene = with("nikon_d700");
  scene.sensor.matrix_rule = MatrixRule::given;
  scene.sensor.matrix = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  EXPECT_THROW(SensorResponse{scene}, Error);
  scene.sensor.matrix = {1e-4, 0.0, 0.0, 0.0, 1e4, 0.0, 0.0, 0.0, 1.0};  // odd, but it has one
  EXPECT_NO_THROW(SensorResponse{scene});
}

/// The observer's functions mixed, as a camera that meets Luther's condition has them.
std::string luther_camera() {
  std::string text = "wavelength_nm,red,green,blue\n";
  for (double nm = 380.0; nm <= 780.0; nm += 5.0) {
    const Vector3 xyz = colour_matching(nm);
    char row[200];
    std::snprintf(row, sizeof row, "%.0f,%.17g,%.17g,%.17g\n", nm, 0.7 * xyz[0] + 0.1 * xyz[1],
                  0.1 * xyz[0] + 0.8 * xyz[1] + 0.1 * xyz[2], 0.05 * xyz[1] + 0.6 * xyz[2]);
    text += row;
  }
  return text;
}

TEST(SensorResponse, ColorimetricMatrixIsExactForACameraThatSeesAsTheObserver) {
  for (const Primaries primaries : {Primaries::srgb, Primaries::acescg}) {
    Scene scene = with_table(luther_camera());
    scene.sensor.white_balance_rule = WhiteBalanceRule::daylight;
    scene.sensor.matrix_rule = MatrixRule::colorimetric;
    scene.sensor.primaries = primaries;
    Scene observer;
    observer.sensor.primaries = primaries;
    const SensorResponse camera(scene), cie(observer);
    const double scale = camera.rgb_per_kilorayleigh(550.0)[1] / cie.rgb_per_kilorayleigh(550.0)[1];
    for (const double nm : {430.0, 520.0, 630.0}) {
      const Vector3 a = camera.rgb_per_kilorayleigh(nm), b = cie.rgb_per_kilorayleigh(nm);
      // The integrated white of D65 and its nominal chromaticity differ in the fifth digit.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / scale, b[c], 3e-4) << word_of(primaries) << nm;
    }
  }
}

/// Linear RGB of D65 light off a reflectance that is a band, in units of the light itself.
Vector3 of_band(const SensorResponse& response, double centre_nm, double sigma_nm) {
  Vector3 sum{};
  for (double nm = 380.0; nm <= 780.0; nm += 5.0) {
    const double away = (nm - centre_nm) / sigma_nm;
    const Vector3 rgb = product(response.rgb_from_channels(), response.channels_of_power(nm));
    for (int c = 0; c < 3; ++c)
      sum[c] += daylight_power(nm, kD65Temperature_k) * std::exp(-0.5 * away * away) * rgb[c];
  }
  const double white = of_daylight(response)[1];
  for (double& channel : sum) channel /= white;
  return sum;
}

TEST(SensorResponse, ColorimetricMatrixBringsSmoothColoursNearerToTheObserver) {
  // Bands between those that the matrix was made of.
  const auto error = [](const SensorResponse& camera) {
    const SensorResponse cie{Scene()};
    double sum = 0.0;
    int count = 0;
    for (double centre = 430.0; centre <= 670.0; centre += 20.0) {
      const Vector3 a = of_band(camera, centre, 40.0), b = of_band(cie, centre, 40.0);
      for (int c = 0; c < 3; ++c, ++count) sum += (a[c] - b[c]) * (a[c] - b[c]);
    }
    return std::sqrt(sum / count);
  };
  for (const std::string& camera : built_in_cameras()) {
    const double balanced = error(SensorResponse(with(camera, WhiteBalanceRule::daylight)));
    const double matched =
        error(SensorResponse(with(camera, WhiteBalanceRule::daylight, MatrixRule::colorimetric)));
    std::printf("%s: rms error of linear RGB of smooth colours %.3f balanced, %.3f with the matrix\n",
                camera.c_str(), balanced, matched);
    EXPECT_LT(matched, 0.5 * balanced) << camera;
  }
}

TEST(SensorResponse, TableMayCountPhotons) {
  Scene photons = with_table("wavelength_nm,red,green,blue\n400,0.1,0.2,0.9\n600,0.8,0.6,0.1\n");
  photons.sensor.response_per = ResponsePer::photon;
  const Scene energy = with_table("wavelength_nm,red,green,blue\n400,40,80,360\n600,480,360,60\n");
  for (const double nm : {400.0, 600.0}) {
    const Vector3 a = SensorResponse(photons).rgb_per_kilorayleigh(nm),
                  b = SensorResponse(energy).rgb_per_kilorayleigh(nm);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-12) << nm;
  }
  // Rayleighs are photons: what a table per photon has is what counts.
  const SensorResponse response(photons);
  EXPECT_NEAR(response.rgb_per_kilorayleigh(600.0)[0] / response.rgb_per_kilorayleigh(400.0)[0], 8.0, 1e-9);
}

TEST(SensorResponse, IsZeroOutsideItsTable) {
  const SensorResponse response(with_table("wavelength_nm,red,green,blue\n500,1,1,1\n600,1,1,1\n"));
  EXPECT_EQ(response.rgb_per_kilorayleigh(499.9), (Vector3{}));
  EXPECT_EQ(response.rgb_per_kilorayleigh(630.0), (Vector3{}));
  EXPECT_GT(response.rgb_per_kilorayleigh(600.0)[0], 0.0);
}

TEST(SensorResponse, BadTablesAreRefused) {
  const auto refused = [](const std::string& text) {
    EXPECT_THROW(SensorResponse{with_table(text)}, Error) << text;
  };
  refused("wavelength_nm,red,green\n500,1,1\n600,1,1\n");
  refused("wavelength_nm,red,green,blue\n600,1,1,1\n500,1,1,1\n");
  refused("wavelength_nm,red,green,blue\n500,1,-1,1\n600,1,1,1\n");
  refused("wavelength_nm,red,green,blue\n600,1,1,1\n700,1,1,1\n");
}

}  // namespace
}  // namespace vegard::sim::sensor_response_test
