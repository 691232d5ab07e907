// The validation of a fit's error bars, on whole fits of small pictures that the simulator renders.
#include "fit/answer/error_bar_validation.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>
#include <string>

#include "fit/fit.h"
#include "fit/report/table/result_json.h"
#include "fit/search/file_journal.h"
#include "sim/render/render.h"
#include "tests/support/free_paths.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::error_bar_validation_test {
namespace {

constexpr int kBands = 16;

sim::Scene validated_scene() {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].spacing_jitter = 0.0;
  scene.emission.uncertainty = sim::TablesUncertainty::none;  // of the data alone
  scene.sheets[0].layers = 1;
  scene.sheets[0].beams = 300;
  scene.sky.level = {0.002, 0.003, 0.004};
  scene.fit.bands = kBands;
  scene.fit.sky_terms = 1;
  scene.fit.scan_points = 0;
  scene.fit.model_error = 0.005;
  scene.fit.free = {tests::free_entry("sheet.main.center_km.north"),
                    tests::free_entry("sheet.main.energy_kev")};
  return scene;
}

/// With white noise far above what the model misses: residuals are what the error bars take them for.
Photo noisy_photo(const sim::Scene& scene) {
  Photo photo = tests::linear_photo(scene);
  float peak = 0.0f;
  for (const float light : photo.linear.data) peak = std::max(peak, light);
  std::mt19937 random(11);
  std::normal_distribution<float> normal(0.0f, 0.1f * peak);
  for (float& light : photo.linear.data) light += normal(random);
  return photo;
}

FitOptions all_validations(int threads) {
  FitOptions options;
  options.threads = threads;
  options.intervals = true;
  options.bootstrap = 400;
  options.mcmc = 40;
  return options;
}

double half_width(const ProfiledInterval& p) { return 0.5 * (p.upper68.value() - p.lower68.value()); }

TEST(ErrorBarValidation, BootstrapAndChainAgreeWithTheCurvatureWhereNoiseIsWhite) {
  const sim::Scene scene = validated_scene();
  const FitResult r = fit_photo(scene, noisy_photo(scene), all_validations(2));
  ASSERT_EQ(r.profile_intervals.size(), 2u) << r.verdict_line;
  ASSERT_TRUE(r.bootstrap && r.chain);
  EXPECT_EQ(r.bootstrap->bands, kBands);
  EXPECT_FALSE(r.validation_interrupted);
  for (std::size_t j = 0; j < 2; ++j) {
    const double sigma = r.parameters[j].sigma.value();
    // 16 bands tell their own scatter to 1 / sqrt(2 * 15) = 18 %; three of those.
    // Profiles are smoothed, so that noise is correlated from row to row: the inflation has that.
    EXPECT_NEAR(r.bootstrap->sigma[j] / sigma, 1.0, 0.55)
        << r.parameters[j].path << ", inflation " << r.error_inflation;
    // A standard deviation from so many independent samples; three of its own, beside the Jacobian's noise.
    EXPECT_NEAR(r.chain->sigma[j] / sigma, 1.0, 0.15 + 3.0 / std::sqrt(2.0 * r.chain->effective[j]))
        << r.parameters[j].path;
  }
}

/// Where the inflation is large beside the Monte-Carlo roughness of chi2, as of most photographs.
TEST(ErrorBarValidation, IntervalsAreTheCurvaturesWhereChi2IsSmooth) {
  sim::Scene scene = validated_scene();
  scene.sheets[0].layers = 3;
  const Photo photo = tests::linear_photo(scene);
  FitOptions options;
  options.intervals = true;
  const FitResult r = fit_photo(scene, photo, options);
  ASSERT_EQ(r.profile_intervals.size(), 2u) << r.verdict_line;
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_TRUE(r.profile_intervals[j].whole);
    EXPECT_FALSE(r.profile_intervals[j].found_better);
    // The curvature's derivatives are smoothed over two rows; a descent ends within a seventh of a standard
    // deviation. What the scatter of the bands adds is no curvature.
    const double of_curvature = r.parameters[j].sigma.value() / r.parameters[j].by_bands;
    EXPECT_NEAR(half_width(r.profile_intervals[j]) / of_curvature, 1.0, 0.2)
        << r.parameters[j].path;
  }
}

TEST(ErrorBarValidation, TakePriorsForWhatTheyAre) {
  sim::Scene scene = validated_scene();
  const Photo photo = noisy_photo(scene);
  const double known_kev = 0.004;  // the photograph knows some 0.05
  sim::Prior prior;
  prior.mean = scene.sheets[0].energy_kev;
  prior.sigma = known_kev;
  scene.fit.free[1].prior = prior;
  const FitResult r = fit_photo(scene, photo, all_validations(2));
  ASSERT_EQ(r.profile_intervals.size(), 2u) << r.verdict_line;
  EXPECT_NEAR(r.parameters[1].sigma.value() / known_kev, 1.0, 0.05);
  EXPECT_NEAR(half_width(r.profile_intervals[1]) / known_kev, 1.0, 0.05);
  // 400 draws of a normal number: 3.5 %; three of those, and the photograph's part.
  EXPECT_NEAR(r.bootstrap->sigma[1] / known_kev, 1.0, 0.15);
  EXPECT_NEAR(r.chain->sigma[1] / known_kev, 1.0, 0.05 + 3.0 / std::sqrt(2.0 * r.chain->effective[1]));
}

TEST(ErrorBarValidation, SayTheSameWithAnyNumberOfThreadsAndAfterAnInterruption) {
  sim::Scene scene = validated_scene();
  const Photo photo = noisy_photo(scene);
  const std::string whole = result_json(fit_photo(scene, photo, all_validations(1)));
  EXPECT_NE(whole.find("\"profile_intervals\""), std::string::npos);
  EXPECT_EQ(whole, result_json(fit_photo(scene, photo, all_validations(2))));

  const tests::TemporaryFolder folder;
  const std::string file = folder / "run.part";
  const JournalSubject subject = {{"the scene", "small"}};
  {
    FileJournal journal(file, subject, JournalMode::fresh);
    std::atomic<bool> stop = false;
    FitOptions options = all_validations(1);
    options.journal = &journal;
    options.stop = &stop;
    int chain_steps = 0;
    options.progress = [&](const std::string& stage, int, double, double) {
      if (stage == "Markov chain" && ++chain_steps > 30) stop = true;  // in the second batch
    };
    const FitResult cut = fit_photo(scene, photo, options);
    EXPECT_TRUE(cut.validation_interrupted);
    EXPECT_NE(cut.verdict, Verdict::interrupted) << "the fit itself was finished";
    EXPECT_EQ(cut.profile_intervals.size(), 2u);
    EXPECT_TRUE(cut.bootstrap);
    EXPECT_FALSE(cut.chain);
  }
  FileJournal journal(file, subject, JournalMode::resume);
  FitOptions options = all_validations(2);
  options.journal = &journal;
  EXPECT_EQ(whole, result_json(fit_photo(scene, photo, options)));
}

}  // namespace
}  // namespace vegard::fit::error_bar_validation_test
