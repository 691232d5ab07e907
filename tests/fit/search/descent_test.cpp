#include "fit/search/descent.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "fit/compare/observation.h"
#include "tests/support/expect_error.h"
#include "tests/support/free_paths.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::descent_test {
namespace {

struct Fitting {
  sim::Scene scene = tests::small_scene();
  std::vector<FreeNumber> free;
  Photo photo;
  std::vector<Observation> observations;
  EvaluationLog log;
  std::vector<TraceRow> trace;

  Fitting() {
    scene.blur.width_deg = {0.43, 0.25, 0.3};
    scene.fit.bands = 4;
    for (const char* path : {"sheet.main.energy_kev", "sheet.main.center_km.north", "sheet.main.bearing_deg"})
      scene.fit.free.push_back(tests::free_entry(path));
    free = free_numbers(scene);
    sim::Scene elsewhere = scene;
    elsewhere.sheets[0].center_km.north += 8.0;
    elsewhere.sheets[0].energy_kev *= 1.4;
    elsewhere.sheets[0].bearing_deg += 3.0;
    photo = tests::rendered_photo(elsewhere);
    observations.push_back(observed(scene, photo, 2));
  }
  /// `weight` has no prior to weigh here: it only says how small a change of chi2 is of no account.
  Descent down(double weight, int iterations = 60) {
    ProfileCost::Options options;
    options.prior_weight = weight;
    const ProfileCost cost(free, cost_terms(observations, free, Detail::full), log, options);
    std::vector<double> start;
    for (const FreeNumber& number : free) start.push_back(number.start);
    trace.clear();
    return descend(cost, start, iterations, "test", log, trace);
  }
};

TEST(Descent, EndsAfterTwoStepsInARowThatAreOfNoAccount) {
  Fitting fit;
  const Descent whole = fit.down(1.0);
  ASSERT_TRUE(whole.converged) << whole.termination;
  ASSERT_GT(fit.trace.size(), 4u) << "more than three steps, or the next would say nothing";
  // A fiftieth of the weight squared is then more than all of chi2.
  const double weight = 10.0 * std::sqrt(whole.chi2_initial);
  const Descent early = fit.down(weight);
  EXPECT_EQ(fit.trace.size(), 3u) << "the start and two steps";
  EXPECT_TRUE(early.converged);
  EXPECT_TRUE(tests::has_facts(early.termination, "converged | (Ceres: "));
  EXPECT_EQ(early.values, fit.trace.back().values) << "the last step counts";
  EXPECT_DOUBLE_EQ(early.chi2, fit.trace.back().chi2);
  EXPECT_LT(early.chi2, early.chi2_initial);
  EXPECT_LT(whole.chi2, early.chi2);
}

TEST(Descent, LeavesNoMoreThanIsOfNoAccount) {
  Fitting fit;
  const Descent fine = fit.down(1e-9);
  // Steps of up to 2 are of no account, two of them, and what steps that grow smaller leave after them.
  const Descent coarse = fit.down(10.0);
  EXPECT_TRUE(coarse.converged) << coarse.termination;
  EXPECT_LT(coarse.chi2 - fine.chi2, 4.0);
}

TEST(Descent, IsNotConvergedWhereItIsCutOff) {
  Fitting fit;
  const Descent cut = fit.down(1.0, 1);
  EXPECT_FALSE(cut.converged);
  EXPECT_NE(cut.termination.find("not converged"), std::string::npos) << cut.termination;
  std::atomic<bool> stop{true};
  fit.log.stop = &stop;
  const Descent stopped = fit.down(1.0);
  EXPECT_FALSE(stopped.converged);
  EXPECT_EQ(stopped.termination, "stopped by the user");
  EXPECT_TRUE(std::isinf(stopped.chi2));
}

TEST(Descent, SaysThatTheEvaluationsRanOutOnTheWay) {
  Fitting fit;
  fit.log.limit = 3;
  const Descent cut = fit.down(1.0);
  EXPECT_FALSE(cut.converged);
  EXPECT_TRUE(tests::has_facts(cut.termination, "evaluations"));
  EXPECT_LE(cut.chi2, cut.chi2_initial);
  EXPECT_LE(fit.log.residuals, 4) << "the step under way is finished";
}

}  // namespace
}  // namespace vegard::fit::descent_test
