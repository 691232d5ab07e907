// The air and the night sky in a fit: exact derivatives through model and linear part, and what it costs to
// leave them out.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "fit/compare/profile_cost.h"
#include "fit/fit.h"
#include "fit/measure/noise_model.h"
#include "fit/report/model_picture.h"
#include "sim/render/render.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::air_in_fit_test {
namespace {

/// A sheet low in the north, where there is much air before it.
sim::Scene low_scene() {
  sim::Scene scene = tests::small_scene();
  scene.camera.elevation_deg = 18.0;
  scene.camera.roll_deg = 2.0;
  scene.sheets[0].center_km.north = 380.0;
  scene.sheets[0].beams = 4000;
  scene.sheets[0].spacing_jitter = 0.0;
  scene.blur.width_deg = {0.43, 0.25, 0.3};
  scene.air.model = sim::AirModel::standard;
  return scene;
}

void add_night_sky(sim::Scene& scene) {
  scene.airglow = {163.0, 123.0, 37.0};
  scene.twilight.shown = true;
  scene.twilight.sun_elevation_deg = -13.0;
  scene.twilight.sun_azimuth_deg = 40.0;
  scene.light_pollution.luminance_mcd_m2 = 0.5;
  scene.light_pollution.azimuth_deg = -20.0;
}

/// What the simulator renders, the aurora clipped as a display has it.
Photo photo_of(const sim::Scene& scene) {
  const sim::Rendering rendering = sim::render(scene);
  Photo photo;
  photo.linear = sim::shown_light(scene, rendering);
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = true;  // a display's light, clipped where it is out of gamut
  return photo;
}

void set_free(sim::Scene& scene, const std::vector<std::string>& paths) {
  scene.fit.free.clear();
  for (const std::string& path : paths) {
    sim::FreeParameter free;
    free.path = path;
    scene.fit.free.push_back(free);
  }
}

const Region kRegion{20, 10, 120, 100};

/// d residual / d parameter against central differences, over steps that move the light by little. What is
/// smooth in the parameter (air, airglow) takes a wide step, beside which the film's floats are nothing.
TEST(AirInAFit, JacobianAgreesWithDifferences) {
  sim::Scene scene = low_scene();
  add_night_sky(scene);
  set_free(scene, {"air.aerosol_optical_depth", "air.angstrom_exponent", "airglow.green_rayleigh",
                   "airglow.red_rayleigh", "airglow.sodium_rayleigh", "light_pollution.luminance_mcd_m2",
                   "camera.elevation_deg", "camera.azimuth_deg", "camera.roll_deg", "camera.hfov_deg",
                   "sheet.main.energy_kev"});
  sim::Scene elsewhere = scene;
  elsewhere.sheets[0].center_km.north += 6.0;
  elsewhere.sheets[0].energy_kev *= 1.2;
  elsewhere.air.aerosol_optical_depth = 0.2;
  const Photo photo = photo_of(elsewhere);
  const Profile data = extract_profile(photo, kRegion, 4);
  const std::vector<double> sigma = profile_sigma(data, 0.05);
  const std::vector<FreeNumber> free = free_numbers(scene);
  for (double smooth_rows : {0.0, 3.0}) {
    scene.fit.bands = 4;
    scene.fit.sky_terms = 2;
    Comparison comparison(scene, photo, data, sigma, {1.0, smooth_rows, 2});
    EvaluationLog log;
    const ProfileCost cost(free, {{scene, ParameterMap(scene, free), &comparison}}, log);
    std::vector<double> u;
    for (const FreeNumber& number : free) u.push_back(number.coordinate(number.start));
    const auto residuals = [&](const std::vector<double>& at, std::vector<double>* jacobian) {
      std::vector<double> r(cost.num_residuals());
      const double* parameters[] = {at.data()};
      if (jacobian != nullptr) jacobian->resize(r.size() * at.size());
      double* rows[] = {jacobian != nullptr ? jacobian->data() : nullptr};
      EXPECT_TRUE(cost.Evaluate(parameters, r.data(), jacobian != nullptr ? rows : nullptr));
      return r;
    };
    std::vector<double> jacobian;
    EXPECT_EQ(residuals(u, &jacobian), residuals(u, nullptr));
    for (std::size_t j = 0; j < free.size(); ++j) {
      SCOPED_TRACE(free[j].label());
      const std::string& table = free[j].id.row->table;
      double step = 5e-4 * free[j].start;
      if (table == "camera") step = 1.5e-3;
      if (table == "air" || table == "airglow" || table == "light_pollution") step = 0.02 * free[j].start;
      step /= free[j].slope(u[j]);
      std::vector<double> more = u, less = u;
      more[j] += step;
      less[j] -= step;
      const std::vector<double> up = residuals(more, nullptr), down = residuals(less, nullptr);
      double error = 0.0, size = 0.0;
      for (std::size_t k = 0; k < up.size(); ++k) {
        const double difference = (up[k] - down[k]) / (2.0 * step);
        error += std::pow(jacobian[k * free.size() + j] - difference, 2);
        size += difference * difference;
      }
      EXPECT_GT(size, 0.0);
      // As in profile_cost_test.cpp for what moves the light; what only dims it agrees much better.
      EXPECT_LT(std::sqrt(error / size), table == "camera" || table == "sheet" ? 0.03 : 2e-3);
    }
  }
}

/// The offset is no part of what the gains scale.
TEST(AirInAFit, NightSkyOfThePhotographsOwnSceneLeavesNothing) {
  sim::Scene scene = low_scene();
  scene.fit.model = sim::FitModel::draws;  // the very beams of the photograph
  add_night_sky(scene);
  const Photo photo = photo_of(scene);
  const Profile data = extract_profile(photo, kRegion, 4);
  const std::vector<double> sigma = profile_sigma(data, 0.05);
  ProfileModel model(scene, photo, kRegion, 4, 1.0, 0.0, 0);
  ModelProfile aurora;
  model.evaluate(scene, aurora);
  ASSERT_EQ(aurora.offset.size(), aurora.value.size());
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < data.mean.size(); ++i) {
    error +=
        std::pow(data.mean[i] - aurora.offset[i] - scene.sensor.gain_per_kilorayleigh * aurora.value[i], 2);
    size += std::pow(data.mean[i], 2);
  }
  EXPECT_LT(std::sqrt(error / size), 0.005);
  sim::Scene bare = scene;
  bare.airglow = {};
  bare.twilight = {};
  bare.light_pollution = {};
  model.evaluate(bare, aurora);
  EXPECT_TRUE(aurora.offset.empty());
}

FitResult fit_with(const sim::Scene& scene, const Photo& photo) {
  return fit_photo(scene, photo, FitOptions());
}

/// The truth, but for an energy that is off and alone free.
sim::Scene start_of_energy_alone(const sim::Scene& truth) {
  sim::Scene start = truth;
  start.sheets[0].energy_kev = 2.5;
  start.fit.bands = 4;
  start.fit.scan_points = 0;
  set_free(start, {"sheet.main.energy_kev"});
  return start;
}

/// A photograph through the air, noise-free but for the way the fit bins it. With the air known, E0 comes
/// back; without, the blue that the air took reads as softer electrons.
TEST(AirInAFit, KnownAirGivesTheEnergyBackAndMissingAirBiasesIt) {
  sim::Scene truth = low_scene();
  truth.sheets[0].energy_kev = 4.0;
  truth.fit.model = sim::FitModel::draws;  // the very beams of the photograph
  add_night_sky(truth);
  const Photo photo = photo_of(truth);
  const sim::Scene start = start_of_energy_alone(truth);
  const FitResult with = fit_with(start, photo);
  ASSERT_EQ(with.parameters.size(), 1u);
  EXPECT_NEAR(with.parameters[0].value, 4.0, 0.04);
  // What the best scene renders is what the fit saw, the night sky at its own gain included.
  const ModelPicture picture = model_picture(with.photos[0], photo, 0);
  double residual = 0.0, light = 0.0;
  for (std::size_t i = 0; i < picture.rgb.data.size(); ++i) {
    residual += std::pow(picture.residual.data[i], 2);
    light += std::pow(photo.linear.data[i], 2);
  }
  EXPECT_LT(std::sqrt(residual / light), 0.1);
  sim::Scene airless = start;
  airless.air.model = sim::AirModel::none;
  const FitResult without = fit_with(airless, photo);
  std::cout << "E0 4 keV: with the air " << with.parameters[0].value << ", without "
            << without.parameters[0].value << " (chi2 " << with.chi2 << ", " << without.chi2 << ")\n";
  RecordProperty("energy_with_air", std::to_string(with.parameters[0].value));
  RecordProperty("energy_without_air", std::to_string(without.parameters[0].value));
  EXPECT_GT(std::abs(without.parameters[0].value - 4.0), 5.0 * std::abs(with.parameters[0].value - 4.0));
  EXPECT_GT(without.chi2, 10.0 * with.chi2);
}

// Green airglow has no red in sRGB, or less than none: a display's picture of it on a black sky has lost
// that, and the fit is not to count on it.
TEST(AirInAFit, AirglowOnABlackSkyIsClippedAsThePhotographWas) {
  sim::Scene truth = low_scene();
  truth.air.model = sim::AirModel::none;
  truth.sky = {};
  truth.sheets[0].energy_kev = 3.0;
  truth.airglow.green_rayleigh = 2000.0;
  const Photo photo = photo_of(truth);
  const sim::Scene start = start_of_energy_alone(truth);
  const FitResult result = fit_with(start, photo);
  EXPECT_NEAR(result.parameters[0].value, 3.0, 0.03);
}

TEST(AirInAFit, AerosolIsFoundBesideTheEnergy) {
  sim::Scene truth = low_scene();
  truth.sheets[0].energy_kev = 4.0;
  truth.air.aerosol_optical_depth = 0.25;
  const Photo photo = photo_of(truth);
  sim::Scene start = truth;
  start.sheets[0].energy_kev = 3.0;
  start.air.aerosol_optical_depth = 0.1;
  start.fit.bands = 4;
  start.fit.scan_points = 0;
  set_free(start, {"sheet.main.energy_kev", "air.aerosol_optical_depth"});
  const FitResult result = fit_with(start, photo);
  std::cout << "aerosol 0.25: " << result.parameters[1].value << ", E0 4: " << result.parameters[0].value
            << "\n";
  EXPECT_NEAR(result.parameters[0].value, 4.0, 0.1);
  EXPECT_NEAR(result.parameters[1].value, 0.25, 0.03);
}

}  // namespace
}  // namespace vegard::fit::air_in_fit_test
