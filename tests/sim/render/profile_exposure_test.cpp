// Light is linear in the height profile: what expose_profiles() says of a slope against differences of whole
// exposures, with the same beams and random numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/light/sheet_profile.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/film.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::profile_exposure_test {
namespace {

std::vector<std::vector<float>> lanes_of(const std::vector<float>& slope, int lines) {
  const std::size_t stride = slope.size() / HeightProfile::kAltitudes;
  std::vector<std::vector<float>> rates(lines, std::vector<float>(HeightProfile::kAltitudes));
  for (int l = 0; l < lines; ++l)
    for (std::size_t a = 0; a < rates[l].size(); ++a) rates[l][a] = slope[a * stride + l];
  return rates;
}

/// By a number of sheet 0; the reference in double has no units of film to round to.
void expect_exact(const Scene& scene, double Sheet::*number, ParameterRole role, double step,
                  double tolerance) {
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  BeamExposer exposer(scene, film, 2);
  const int lines = static_cast<int>(scene.emission.lines.size());
  Exposure slope;
  exposer.expose_profiles(
      scene, 0, lanes_of(profile_slope(scene.emission.lines, scene, 0, parameter_with(role, 0)), lines),
      slope);
  Scene more = scene, less = scene;
  more.sheets[0].*number += step;
  less.sheets[0].*number -= step;
  std::vector<double> up, down;
  exposer.expose_reference(more, up);
  exposer.expose_reference(less, down);
  double error = 0.0, size = 0.0;
  ASSERT_EQ(slope.rayleigh.size(), up.size());
  for (std::size_t i = 0; i < up.size(); ++i) {
    const double difference = (up[i] - down[i]) / (2.0 * step);
    error += std::pow(slope.rayleigh[i] - difference, 2);
    size += difference * difference;
  }
  ASSERT_GT(size, 0.0);
  EXPECT_LT(std::sqrt(error / size), tolerance);
}

TEST(ProfileExposure, OfAFormsNumbersAgreesWithDifferences) {
  Scene scene = tests::small_scene();
  scene.sheets.push_back(scene.sheets[0]);  // whose light must not be in it
  scene.sheets[1].name = "other";
  scene.sheets[0].profile = ProfileKind::form;
  scene.sheets[0].peak_km = 113.1;
  scene.sheets[0].lower_km = 11.0;
  // The places of floats on the film against those of doubles.
  expect_exact(scene, &Sheet::peak_km, ParameterRole::form_peak, 0.02, 3e-3);
  expect_exact(scene, &Sheet::lower_km, ParameterRole::form_lower, 0.02, 3e-3);
  expect_exact(scene, &Sheet::upper_km, ParameterRole::form_upper, 0.02, 3e-3);
}

TEST(ProfileExposure, OfAGivenLinesNumbersAgreesWithDifferences) {
  Scene scene = tests::small_scene();
  scene.sheets[0].profile = ProfileKind::line;  // of 557.7 nm
  scene.sheets[0].line_kilorayleigh = 4.0;
  scene.sheets[0].peak_km = 113.1;
  scene.sheets[0].lower_km = 11.0;
  expect_exact(scene, &Sheet::peak_km, ParameterRole::form_peak, 0.02, 3e-3);
  expect_exact(scene, &Sheet::lower_km, ParameterRole::form_lower, 0.02, 3e-3);
  expect_exact(scene, &Sheet::upper_km, ParameterRole::form_upper, 0.02, 3e-3);
  expect_exact(scene, &Sheet::line_kilorayleigh, ParameterRole::line_brightness, 0.1, 3e-3);
  scene.sheets[0].profile = ProfileKind::proton;
  scene.sheets[0].line_nm = 427.8;
  expect_exact(scene, &Sheet::line_kilorayleigh, ParameterRole::line_brightness, 0.1, 3e-3);
}

TEST(ProfileExposure, OfSplinesCoefficientsAddUpToTheLight) {
  Scene scene = tests::small_scene();
  scene.sheets[0].profile = ProfileKind::spline;
  scene.sheets[0].spline_knots = 11;  // eight and three lanes
  fill_spline_rates(scene);
  const Sheet& sheet = scene.sheets[0];
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  BeamExposer exposer(scene, film, 2);
  std::vector<std::vector<float>> basis;
  for (int k = 0; k < sheet.spline_knots; ++k)
    basis.push_back(
        lanes_of(profile_slope(
                     scene.emission.lines, scene, 0,
                     parameter_at(scene, "sheet.spline_rate." + spline_rate_component(scene, 0, k)).value()),
                 1)
            .front());
  Exposure whole, parts;
  exposer.expose(scene, whole);
  exposer.expose_profiles(scene, 0, basis, parts);
  ASSERT_EQ(parts.lines, 11);
  const std::size_t cells = whole.cells();
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < cells; ++i) {
    double sum = 0.0;
    for (int k = 0; k < sheet.spline_knots; ++k) sum += sheet.spline_rate[k] * parts.rayleigh[k * cells + i];
    error += std::pow(sum - whole.rayleigh[i], 2);
    size += std::pow(whole.rayleigh[i], 2);
  }
  ASSERT_GT(size, 0.0);
  EXPECT_LT(std::sqrt(error / size), 1e-5);
}

TEST(ProfileExposure, ANegativeProfileTakesLightAway) {
  Scene scene = tests::small_scene();
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  BeamExposer exposer(scene, film, 2);
  std::vector<float> rate(HeightProfile::kAltitudes, 2.0f), negative(rate.size(), -3.0f);
  Exposure out;
  exposer.expose_profiles(scene, 0, {rate, negative, std::vector<float>(rate.size(), 0.0f)}, out);
  const std::size_t cells = out.cells();
  double most = 0.0;
  for (std::size_t i = 0; i < cells; ++i) {
    most = std::max<double>(most, out.rayleigh[i]);
    EXPECT_NEAR(out.rayleigh[cells + i], -1.5 * out.rayleigh[i], 1e-5 * out.rayleigh[i] + 1e-4);
    EXPECT_EQ(out.rayleigh[2 * cells + i], 0.0f);
  }
  EXPECT_GT(most, 1.0);
}

}  // namespace
}  // namespace vegard::sim::profile_exposure_test
