// The whole cost's Jacobian against central differences, for every number that can be free.
//
// The differences are those of a film in floats, with the kinks of the bilinear splat: measured, a column of
// the Jacobian differs by up to 1.6 % of its norm, by 5 % for the two pitch angles, to which the profile is
// ten thousand times less sensitive than to the place of the sheet.
#include "fit/compare/profile_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/measure/noise_model.h"
#include "sim/render/render.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/free_paths.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::profile_cost_test {
namespace {

sim::Scene fit_scene() {
  sim::Scene scene = tests::small_scene();
  scene.camera.roll_deg = 2.0;
  scene.sheets[0].center_km.east = 90.0;
  scene.sheets[0].length_km = 280.0;
  scene.sheets[0].arcs = 2;
  scene.sheets[0].arc_spacing_km = 14.0;
  scene.sheets[0].fold_spacing_km = 25.0;
  scene.sheets[0].fold_length_km = 15.0;
  scene.sheets[0].beams = 4000;
  scene.blur.width_deg = {0.43, 0.25, 0.3};
  scene.sky.level = {0.02, 0.03, 0.05};
  scene.sky.gradient = {0.01, 0.0, -0.01};
  for (const tests::FreePath& p : tests::free_paths(scene)) {
    sim::FreeParameter free;
    free.path = p.path.text;
    scene.fit.free.push_back(free);
  }
  return scene;
}

/// A photograph of the scene: what the simulator renders, clipped as a display has it, or signed.
Photo photo_of(const sim::Scene& scene, bool is_signed = false) {
  const sim::Rendering rendering = sim::render(scene);
  Photo photo;
  photo.linear = rendering.rgb;
  if (!is_signed)
    for (std::size_t i = 0; i < photo.linear.data.size(); ++i)
      photo.linear.data[i] += std::max(rendering.aurora.data[i], 0.0f) - rendering.aurora.data[i];
  photo.usable.assign(photo.linear.data.size(), 1);
  for (std::size_t i = 0; i < photo.usable.size(); i += 97) photo.usable[i] = 0;
  photo.floating = true;
  photo.srgb = !is_signed;
  return photo;
}

struct Fitting {
  sim::Scene scene;
  std::vector<FreeNumber> free;
  std::unique_ptr<Comparison> comparison;
  EvaluationLog log;
  std::unique_ptr<ProfileCost> cost;

  Fitting(sim::Scene with, const Region& region, int bands, const GainLayout& gains, bool is_signed = false)
      : scene(std::move(with)) {
    sim::Scene elsewhere = scene;
    elsewhere.sheets[0].center_km.north += 6.0;
    elsewhere.sheets[0].energy_kev *= 1.2;
    const Photo photo = photo_of(elsewhere, is_signed);
    free = free_numbers(scene);
    const Profile data = extract_profile(photo, region, bands);
    scene.fit.bands = gains.bands;
    scene.fit.band_brightness = gains.per_band;
    scene.fit.white_balance_known = !gains.per_channel;
    comparison = std::make_unique<Comparison>(scene, photo, data, profile_sigma(data, 0.05),
                                              Comparison::Resolution{1.0, 0.0, 2});
    cost = std::make_unique<ProfileCost>(
        free, std::vector<CostTerm>{{scene, ParameterMap(scene, free), comparison.get()}}, log);
  }

  std::vector<double> start() const {
    std::vector<double> u;
    for (const FreeNumber& number : free) u.push_back(number.coordinate(number.start));
    return u;
  }
  std::vector<double> residuals(const std::vector<double>& u, std::vector<double>* jacobian = nullptr) const {
    std::vector<double> r(cost->num_residuals());
    const double* parameters[] = {u.data()};
    if (jacobian != nullptr) jacobian->resize(r.size() * u.size());
    double* rows[] = {jacobian != nullptr ? jacobian->data() : nullptr};
    EXPECT_TRUE(cost->Evaluate(parameters, r.data(), jacobian != nullptr ? rows : nullptr));
    return r;
  }
};

/// In the scene's unit: moves the light by about a hundredth of a pixel. Shorter, and the rounding of floats
/// shows; longer, and samples cross from cell to cell.
double step_of(const FreeNumber& number) {
  if (!number.has_path()) return 0.004;  // a distance
  switch (number.id.role()) {
    case sim::ParameterRole::centre:
      return 0.004;
    case sim::ParameterRole::inclination:
    case sim::ParameterRole::declination:
    case sim::ParameterRole::length:
      return 0.01;
    case sim::ParameterRole::loss_cone:
      return 0.008;
    case sim::ParameterRole::pitch_step:
      return 1.5e-4;
    default:
      break;
  }
  if (number.id.row->table == "camera") return 1.5e-3;
  return number.logarithmic() ? 5e-4 * number.start : 5e-4;
}

void expect_jacobian(const Fitting& fit) {
  const std::vector<double> u = fit.start();
  std::vector<double> jacobian;
  const std::vector<double> with = fit.residuals(u, &jacobian), without = fit.residuals(u);
  EXPECT_EQ(with, without) << "residuals do not depend on whether derivatives are wanted";
  const std::size_t p = u.size();
  for (std::size_t j = 0; j < p; ++j) {
    SCOPED_TRACE(fit.free[j].label());
    double step = step_of(fit.free[j]);
    step /= fit.free[j].slope(u[j]);
    std::vector<double> more = u, less = u;
    more[j] += step;
    less[j] -= step;
    const std::vector<double> up = fit.residuals(more), down = fit.residuals(less);
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < up.size(); ++k) {
      const double difference = (up[k] - down[k]) / (2 * step);
      error += std::pow(jacobian[k * p + j] - difference, 2);
      size += difference * difference;
    }
    EXPECT_GT(size, 0.0);
    const sim::ParameterRole role = fit.free[j].id.role();
    const bool weak = role == sim::ParameterRole::loss_cone || role == sim::ParameterRole::pitch_step;
    EXPECT_LT(std::sqrt(error / size), weak ? 0.1 : 0.03);
  }
}

TEST(ProfileCost, JacobianAgreesWithDifferencesForEveryFreeNumber) {
  sim::Scene scene = fit_scene();
  int priors = 0;
  for (sim::FreeParameter& free : scene.fit.free) {
    if (free.path == "camera.hfov_deg") free.prior = sim::Prior{58.0, 0.5}, ++priors;
    if (free.path == "sheet.main.energy_kev") free.prior = sim::Prior{4.0, 0.7}, ++priors;
  }
  ASSERT_EQ(priors, 2);
  // The gains take up the one sheet's flux entirely: a test of its own, below.
  for (auto it = scene.fit.free.begin(); it != scene.fit.free.end(); ++it)
    if (it->path == "sheet.main.energy_flux_mw_m2") {
      scene.fit.free.erase(it);
      break;
    }
  const Region region{20, 10, 120, 100};
  const Fitting fit(scene, region, 4, {4, true, false});
  EXPECT_EQ(fit.cost->num_residuals(), 4 * 100 * 3 + 2);
  expect_jacobian(fit);
}

TEST(ProfileCost, JacobianAgreesWithDifferencesWhereNothingIsClipped) {
  sim::Scene scene = fit_scene();
  scene.fit.free.resize(3);
  scene.fit.free[0].path = "sheet.main.energy_kev";
  scene.fit.free[1].path = "sheet.main.center_km.north";
  scene.fit.free[2].path = "blur.width_deg.6300";
  expect_jacobian(Fitting(scene, {20, 10, 120, 100}, 4, {4, true, false}, true));
}

/// One energy for two sheets, a sheet that keeps its distance from the other, and a number that is no
/// parameter's.
TEST(ProfileCost, JacobianAgreesWithDifferencesWhereNumbersAreTied) {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].beams = 4000;
  scene.sheets[0].name = "a";
  scene.sheets.push_back(scene.sheets[0]);
  scene.sheets[1].name = "b-2";
  scene.sheets[1].center_km.north = 230.0;
  scene.blur.width_deg = {0.43, 0.25, 0.3};
  const auto add = [&](const char* path, const char* name) {
    scene.fit.free.push_back(tests::free_entry(path));
    scene.fit.free.back().name = name;
  };
  add("sheet.a.energy_kev", "e");
  add("sheet.b-2.energy_kev", "e");
  add("sheet.a.center_km.north", "");
  add("sheet.a.bearing_deg", "");
  add("", "gap");
  scene.fit.free.back().start = 40.0;
  scene.fit.free.back().min = 10.0;
  scene.fit.free.back().max = 90.0;
  scene.fit.free.back().prior = sim::Prior{50.0, 0.2, sim::PriorLaw::log_normal};
  scene.fit.tied = {
      {"sheet.b-2.center_km.north", "sheet.a.center_km.north + gap * sin_deg(sheet.a.bearing_deg)", "", 0},
      {"sheet.b-2.bearing_deg", "sheet.a.bearing_deg", "", 0}};
  sim::validate(scene);
  const Fitting fit(scene, {20, 10, 120, 100}, 4, {4, true, false});
  ASSERT_EQ(fit.free.size(), 4u);
  EXPECT_EQ(fit.cost->num_residuals(), 4 * 100 * 3 + 1);
  expect_jacobian(fit);
}

TEST(ProfileCost, IsInfiniteWhereATieLeavesItsLimits) {
  sim::Scene scene = tests::small_scene();
  scene.fit.free = {tests::free_entry("sheet.main.energy_kev")};
  scene.fit.tied = {{"camera.hfov_deg", "20 * sheet.main.energy_kev", "", 0}};
  const Fitting fit(scene, {0, 0, 160, 120}, 2, {2, false, false});
  EXPECT_TRUE(std::isfinite(fit.cost->at({3.0}, false).chi2));
  EXPECT_FALSE(std::isfinite(fit.cost->at({15.0}, false).chi2));
  std::vector<double> r(fit.cost->num_residuals());
  const double u = fit.free[0].coordinate(15.0);
  const double* parameters[] = {&u};
  EXPECT_FALSE(fit.cost->Evaluate(parameters, r.data(), nullptr)) << "the solver takes a shorter step then";
}

TEST(ProfileCost, PriorsAreResidualsOfTheirOwn) {
  sim::Scene scene = fit_scene();
  scene.fit.free.resize(1);
  scene.fit.free[0].path = "sheet.main.energy_kev";
  scene.fit.free[0].prior = sim::Prior{4.0, 0.5};
  const Fitting fit(scene, {0, 0, 160, 120}, 2, {2, false, false});
  std::vector<double> jacobian;
  const std::vector<double> u = fit.start(), r = fit.residuals(u, &jacobian);
  EXPECT_NEAR(r.back(), (3.0 - 4.0) / 0.5, 1e-9);
  EXPECT_NEAR(jacobian.back(), fit.free[0].slope(u[0]) / 0.5, 1e-9);
  double chi2 = 0.0;
  for (double x : r) chi2 += x * x;
  EXPECT_NEAR(fit.cost->at({3.0}, false).chi2, chi2, 1e-9 * chi2);
}

TEST(ProfileCost, OverallFluxIsTakenUpByTheGain) {
  sim::Scene scene = fit_scene();
  scene.fit.free.resize(1);
  scene.fit.free[0].path = "sheet.main.energy_flux_mw_m2";
  const Fitting fit(scene, {0, 0, 160, 120}, 2, {2, false, false});
  std::vector<double> jacobian;
  const std::vector<double> r = fit.residuals(fit.start(), &jacobian);
  double largest = 0.0, residual = 0.0;
  for (std::size_t k = 0; k < r.size(); ++k) {
    largest = std::max(largest, std::abs(jacobian[k]));
    residual = std::max(residual, std::abs(r[k]));
  }
  EXPECT_GT(residual, 1.0);
  EXPECT_LT(largest, 1e-4 * residual);
}

TEST(ProfileCost, GivesUpWhenItsEvaluationsAreSpent) {
  sim::Scene scene = fit_scene();
  scene.fit.free.resize(1);
  Fitting fit(scene, {0, 0, 160, 120}, 2, {2, false, false});
  fit.residuals(fit.start());
  EXPECT_EQ(fit.log.residuals, 1);
  fit.log.limit = 1;
  std::vector<double> r(fit.cost->num_residuals());
  const std::vector<double> u = fit.start();
  const double* parameters[] = {u.data()};
  EXPECT_FALSE(fit.cost->Evaluate(parameters, r.data(), nullptr));
}

/// How far the profile of `scene` is from that of a photograph of `truth`, as a fraction of its light. The
/// film of the fit has cells up to four pixels wide and beams without jitter; sky and gain are known.
double profile_error(const sim::Scene& truth, const sim::Scene& scene, bool is_signed = false) {
  const Photo photo = photo_of(truth, is_signed);
  const Region region{20, 10, 120, 100};
  const Profile data = extract_profile(photo, region, 2);
  ProfileModel model(scene, photo, region, 2, 1.0, 0.0, 0);
  ModelProfile aurora;
  model.evaluate(scene, aurora);
  double error = 0.0, size = 0.0;
  for (int b = 0; b < 2; ++b)
    for (int r = 0; r < data.rows; ++r)
      for (int c = 0; c < 3; ++c) {
        const double place = (region.y + r + 0.5) / scene.camera.height - 0.5;
        const double light =
            data.mean[data.index(b, r, c)] - scene.sky.level[c] - scene.sky.gradient[c] * place;
        const double expected = scene.sensor.gain_per_kilorayleigh * aurora.value[data.index(b, r, c)];
        error += (light - expected) * (light - expected);
        size += light * light;
      }
  return std::sqrt(error / size);
}

TEST(ProfileModel, OfThePhotographsOwnSceneIsThePhotographsProfile) {
  sim::Scene scene = fit_scene();
  scene.sheets[0].spacing_jitter = 0.0;
  EXPECT_LT(profile_error(scene, scene), 0.01);
}

TEST(ProfileModel, OfAnExposureOfADriftingSheetIsThePhotographsProfile) {
  sim::Scene scene = fit_scene();
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sheets[0].beams = 1000;
  scene.sheets[0].drift_km_s = {0.0, 2.5};
  scene.sheets[0].sine_speed_km_s = 8.5;
  scene.time.start_s = 1.0;
  scene.time.exposure_s = 8.0;
  scene.time.instants = 4;
  EXPECT_LT(profile_error(scene, scene), 0.01) << "nothing is left at the truth";
  sim::Scene still = scene;
  still.time.instants = 1;
  EXPECT_GT(profile_error(scene, still), 0.1) << "the motion counts";
}

/// The kernel's light grows in proportion to the energy flux; that the profile per unit of it changes as well
/// is added from exposures of its slope. No sample moves: the differences are as exact as floats.
TEST(ProfileModel, DerivativeByTheEnergyFluxHasTheFluxLawInIt) {
  sim::Scene scene = tests::small_scene();
  scene.emission.flux_law = sim::FluxLaw::column;
  scene.sheets[0].beams = 2000;
  scene.sheets[0].energy_flux_mw_m2 = 1.0;
  scene.blur.width_deg = {0.43, 0.25, 0.3};
  scene.sheets.push_back(scene.sheets[0]);  // whose flux is not the one
  scene.sheets[1].name = "other";
  scene.sheets[1].center_km.north += 20.0;
  double& flux = scene.sheets[0].energy_flux_mw_m2;
  const Photo photo = photo_of(scene, true);  // nothing is clipped
  ProfileModel model(scene, photo, {20, 10, 120, 100}, 4, 1.0, 0.0, 2);
  ModelProfile here, up, down;
  model.evaluate_with_derivatives(scene, {sim::parameter_with(sim::ParameterRole::energy_flux, 0)}, here);
  ASSERT_EQ(here.free, 1);
  const double step = 0.02;
  flux += step;
  model.evaluate(scene, up);
  flux -= 2.0 * step;
  model.evaluate(scene, down);
  flux += step;
  sim::Scene dark = scene;
  dark.sheets[0].energy_flux_mw_m2 = 0.0;
  ModelProfile other;
  model.evaluate(dark, other);
  double error = 0.0, of_proportion = 0.0, size = 0.0;
  ASSERT_EQ(here.derivative.size(), up.value.size());
  for (std::size_t i = 0; i < up.value.size(); ++i) {
    const double difference = (up.value[i] - down.value[i]) / (2.0 * step);
    error += std::pow(here.derivative[i] - difference, 2);
    of_proportion += std::pow((here.value[i] - other.value[i]) / flux - difference, 2);
    size += difference * difference;
  }
  ASSERT_GT(size, 0.0);
  EXPECT_LT(std::sqrt(error / size), 1e-4);
  EXPECT_GT(std::sqrt(of_proportion / size), 5e-3) << "proportion alone is off by a hundredth";
}

/// Light is linear in a profile's coefficients, and no sample moves: the differences are as exact as floats.
TEST(ProfileCost, JacobianOfAFreeFormProfileAgreesWithDifferences) {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].beams = 2000;
  scene.sheets[0].profile = sim::ProfileKind::spline;
  scene.sheets[0].spline_knots = 10;
  scene.blur.width_deg = {0.43, 0.25, 0.3};
  sim::fill_spline_rates(scene);
  scene.fit.free.push_back(tests::free_entry("sheet.main.spline_rate"));
  sim::Scene elsewhere = scene;
  for (int k = 0; k < 30; ++k) elsewhere.sheets[0].spline_rate[k] *= 1.0 + 0.5 * std::sin(k);
  const Photo photo = photo_of(elsewhere);
  const Region region{20, 10, 120, 100};
  const std::vector<FreeNumber> free = free_numbers(scene);
  const Profile data = extract_profile(photo, region, 4);
  const std::vector<double> sigma = profile_sigma(data, 0.05);
  scene.fit.bands = 4;
  Comparison comparison(scene, photo, data, sigma, {1.0, 0.0, 2});
  EvaluationLog log;
  const ProfileCost cost(free, {{scene, ParameterMap(scene, free), &comparison}}, log,
                         {{}, {}, spline_prior(scene, free, 2.0), 3.0});
  ASSERT_EQ(cost.num_residuals(), 4 * 100 * 3 + 3 * 8 + 1);
  std::vector<double> u;
  for (const FreeNumber& number : free) u.push_back(number.coordinate(number.start));
  const std::size_t p = u.size(), n = static_cast<std::size_t>(cost.num_residuals());
  std::vector<double> here(n), up(n), down(n), jacobian(n * p);
  double* rows[] = {jacobian.data()};
  const double* at[] = {u.data()};
  ASSERT_TRUE(cost.Evaluate(at, here.data(), rows));
  for (std::size_t j = 0; j < p; ++j) {
    const double kept = u[j], step = 1e-3;  // 4 % of a coefficient
    u[j] = kept + step;
    ASSERT_TRUE(cost.Evaluate(at, up.data(), nullptr));
    u[j] = kept - step;
    ASSERT_TRUE(cost.Evaluate(at, down.data(), nullptr));
    u[j] = kept;
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double difference = (up[k] - down[k]) / (2.0 * step);
      error += std::pow(jacobian[k * p + j] - difference, 2);
      size += difference * difference;
    }
    ASSERT_GT(size, 0.0);
    EXPECT_LT(std::sqrt(error / size), 2e-3) << free[j].label();
  }
}

}  // namespace
}  // namespace vegard::fit::profile_cost_test
