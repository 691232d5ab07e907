// A scene and the transfer curve of its photograph, found together.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "fit/fit.h"
#include "fit/report/table/result_json.h"
#include "tests/support/expect_error.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::transfer_curve_fit_test {
namespace {

constexpr double kEnergy = 4.0;

sim::Scene true_scene() {
  sim::Scene scene = tests::two_stations();
  scene.fit.photos.clear();
  scene.camera.width = 96;
  scene.camera.height = 72;
  scene.sheets[0].profile = sim::ProfileKind::maxwellian;
  scene.sheets[0].layers = 1;
  scene.sheets[0].beams = 4000;
  scene.sheets[0].energy_kev = kEnergy;
  scene.sheets[0].energy_flux_mw_m2 = 8.0;
  scene.sheets[0].ray_contrast = 0.0;
  scene.fit.bands = 6;
  return scene;
}

sim::Scene start_of(const sim::Scene& truth, const std::vector<std::string>& paths = {
                                                 "sheet.main.energy_kev", "sheet.main.center_km.north"}) {
  sim::Scene start = truth;
  start.seed += 1;
  start.sheets[0].beams = 800;
  start.sheets[0].energy_kev = 3.2;
  if (paths.size() > 1) start.sheets[0].center_km.north *= 1.03;
  start.fit.scan_points = 0;
  for (const std::string& path : paths) {
    sim::FreeParameter free;
    free.path = path;
    start.fit.free.push_back(free);
  }
  return start;
}

/// Seed 7: noise of 0.003 of white.
Photo photo_by(const sim::BentSrgb& curve) {
  return tests::encoded_photo(
      tests::rendered_photo(true_scene()), [&](double x) { return curve.encode(x); }, 0.003, 7);
}

void tell(const char* what, const FitResult& r) {
  std::cout << what << ": E0 " << r.parameters[0].value << " +- " << r.parameters[0].sigma.value_or(NAN)
            << ", chi2/dof " << r.chi2 / r.dof;
  if (r.transfer_curve)
    std::cout << ", " << r.transfer_curve->words << ", " << r.transfer_curve->trials.size() << " trials";
  std::cout << "\n  " << r.verdict_line << "\n";
}

void expect_truth(const FitResult& r, double exponent) {
  ASSERT_TRUE(r.transfer_curve);
  ASSERT_EQ(r.transfer_curve->exponents.size(), 1u);
  const FittedTransferCurve::Exponent& e = r.transfer_curve->exponents[0];
  EXPECT_FALSE(e.undetermined);
  EXPECT_FALSE(e.at_limit);
  // Three standard deviations: two numbers of each of two photographs, 1 % by chance.
  EXPECT_NEAR(e.value, exponent, 3.0 * e.sigma);
  EXPECT_LT(e.sigma, 0.2);
  ASSERT_TRUE(r.parameters[0].sigma);
  EXPECT_NEAR(r.parameters[0].value, kEnergy, 3.0 * *r.parameters[0].sigma);
}

TEST(TransferCurveFit, FindsACurveThatIsNotSrgb) {
  const sim::Scene start = start_of(true_scene(), {"sheet.main.energy_kev"});
  Photo photo = photo_by({1.6, 1.6});
  const FitResult wrong = fit_photo(start, photo, {});
  tell("1.6 as sRGB", wrong);
  const FitResult found = fit_photo_and_transfer_curve(start, photo, {});
  tell("1.6 unknown", found);
  expect_truth(found, 1.6);
  // As sRGB the model explains less (a chi2 of four times as much), and the energy is further off.
  EXPECT_GT(wrong.chi2 / wrong.dof, 3.0 * found.chi2 / found.dof);
  EXPECT_GT(std::abs(wrong.parameters[0].value - kEnergy),
            3.0 * std::abs(found.parameters[0].value - kEnergy));
  // What was found is in every number that is handed on.
  EXPECT_EQ(photo.decoding, found.photos[0].decoding);
  EXPECT_TRUE(tests::has_facts(photo.decoding, "unknown | sRGB"));
  EXPECT_NE(photo.decoding.find("(8-bit PNG"), std::string::npos);
  const std::string json = result_json(found);
  EXPECT_NE(json.find("\"curve\""), std::string::npos);
  EXPECT_EQ(found.derived.back().name, "exponent of the transfer curve over sRGB of all light");
  EXPECT_EQ(found.derived.back().value, found.transfer_curve->exponents[0].value);
}

TEST(TransferCurveFit, OfSrgbFindsSrgbAndWiderErrorBars) {
  const sim::Scene start = start_of(true_scene());
  Photo photo = photo_by({});
  const FitResult known = fit_photo(start, photo, {});
  tell("sRGB known", known);
  const FitResult found = fit_photo_and_transfer_curve(start, photo, {});
  tell("sRGB unknown", found);
  expect_truth(found, 1.0);
  EXPECT_GT(*found.parameters[0].sigma, *known.parameters[0].sigma);
}

TEST(TransferCurveFit, IsTheSameForAnyNumberOfThreads) {
  const sim::Scene start = start_of(true_scene());
  Photo one = photo_by({1.2, 1.2}), two = one;
  FitOptions options;
  options.threads = 1;
  const FitResult a = fit_photo_and_transfer_curve(start, one, options);
  options.threads = 2;
  const FitResult b = fit_photo_and_transfer_curve(start, two, options);
  EXPECT_EQ(a.transfer_curve->trials, b.transfer_curve->trials);
  EXPECT_EQ(a.parameters[0].value, b.parameters[0].value);
  EXPECT_EQ(a.parameters[0].sigma, b.parameters[0].sigma);
  EXPECT_EQ(one.decoding, two.decoding);
}

TEST(TransferCurveFit, RefusesWhatItCannotWeigh) {
  const Photo photo = photo_by({});
  const auto refused = [&](const sim::Scene& scene, const FitOptions& options, const std::string& key) {
    Photo copy = photo;
    try {
      fit_photo_and_transfer_curve(scene, copy, options);
      ADD_FAILURE() << "not refused: " << key;
    } catch (const sim::Error& error) {
      EXPECT_NE(error.details().key.find(key), std::string::npos) << error.details().key;
    }
  };
  const sim::Scene start = start_of(true_scene());
  sim::Scene scene = start;
  scene.fit.weight[sim::StatisticKind::colour] = 1.0;
  refused(scene, {}, "fit.colour_weight");
  scene = start;
  scene.fit.photo_noise = sim::PhotoNoise::sensor;
  refused(scene, {}, "fit.photo_noise");
  FitOptions options;
  options.mcmc = 10;
  refused(start, options, "--mcmc");
  scene = start;
  scene.fit.photos = {{"a", "a.png", "", "", {}, 0}};
  EXPECT_THROW(fit_photos(scene, {photo}, {}), sim::Error);
}

}  // namespace
}  // namespace vegard::fit::transfer_curve_fit_test
