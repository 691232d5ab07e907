#include "fit/answer/verdict.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace vegard::fit::verdict_test {
namespace {

/// A fit with nothing against it.
FitResult fine() {
  FitResult r;
  r.chi2 = 1000.0;
  r.dof = 1000;
  r.rms_over_peak = 0.01;
  r.correlated_residuals = 4.0;
  FittedParameter p;
  p.path = "sheet.main.energy_kev";
  p.sigma = 0.1;
  p.moved_sigma = 3.0;
  r.chi2_initial = 5e5;
  r.gradient_cosine = 0.001;
  r.parameters.push_back(p);
  return r;
}

Evidence clear() {
  Evidence e;
  e.converged = true;
  e.chi2_without_aurora = 1e6;
  return e;
}

TEST(Verdict, BelievesWhatNothingSpeaksAgainst) {
  FitResult r = fine();
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::good);
  EXPECT_TRUE(r.reasons.empty());
}

TEST(Verdict, NotesAModelErrorThatIsTooLarge) {
  FitResult r = fine();
  r.chi2 = 290.0;
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::good);
  ASSERT_EQ(r.reasons.size(), 1u);
  EXPECT_NE(r.reasons[0].find("model misses"), std::string::npos);
}

TEST(Verdict, DoubtsForEachReasonByItself) {
  const auto doubts = [](const Evidence& evidence, FitResult r, const std::string& word) {
    assess_fit(evidence, r);
    EXPECT_EQ(r.verdict, Verdict::doubtful) << word;
    ASSERT_EQ(r.reasons.size(), 1u) << word;
    EXPECT_NE(r.reasons[0].find(word), std::string::npos) << r.reasons[0];
    EXPECT_NE(r.verdict_line.find(word), std::string::npos) << r.verdict_line;
  };
  FitResult r = fine();
  r.chi2 = 3100.0;
  doubts(clear(), r, "misses something");
  r = fine();
  r.rms_over_peak = 0.11;
  doubts(clear(), r, "rms residual");
  r = fine();
  r.correlated_residuals = 102.0;  // to one independent value: fewer than ten are left
  doubts(clear(), r, "correlated");
  r = fine();
  r.parameters[0].at_limit = true;
  doubts(clear(), r, "at a limit");
  r = fine();
  r.parameters[0].sigma.reset();
  doubts(clear(), r, "no error bar");
  r = fine();
  r.chi2_initial = 999.0;
  doubts(clear(), r, "diverged");
  r = fine();
  r.gradient_cosine = 0.03;
  doubts(clear(), r, "still falls");
  r = fine();
  r.parameters.push_back(r.parameters[0]);
  r.parameters[0].moved = false;
  doubts(clear(), r, "did not move");
  Evidence e = clear();
  e.chi2_without_aurora = 1900.0;
  doubts(e, fine(), "without any aurora");
  e = clear();
  e.second_mode = true;
  e.second_mode_text = "another answer";
  doubts(e, fine(), "another answer");
}

// 0.16 % of chi2 is more than the 0.04 % of a level end, but of 1000 it is 1.6: with an inflation of 3 a
// fifth of its square.
TEST(Verdict, TakesAnEndForLevelWhereNoiseWouldHideTheRest) {
  FitResult r = fine();
  r.gradient_cosine = 0.04;
  r.error_inflation = 3.0;
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::good);
  r.error_inflation = 2.0;
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::doubtful);
}

// An effective sample size of 120 is too small for fifteen parameters, and enough for a distance; lateral
// numbers (a wavelength) suffer from patterns from band to band. With 60 nothing is good.
TEST(Verdict, DoubtsLateralNumbersWhereResidualsAreCorrelated) {
  const auto assessed_with = [](double independent) {
    FitResult r = fine();
    r.parameters.resize(15, r.parameters.front());
    r.correlated_residuals = r.dof / independent;
    DerivedNumber distance;
    distance.name = "distance of the main sheet";
    distance.value = 200.0;
    distance.sigma = 2.0;
    distance.quantity = Quantity::distance;
    DerivedNumber wavelength = distance;
    wavelength.name = "wavelength of the main sheet";
    wavelength.quantity = Quantity::width;
    wavelength.is_lateral = true;
    r.derived = {distance, wavelength};
    assess_fit(clear(), r);
    assess_quantities(r);
    EXPECT_EQ(r.verdict, Verdict::doubtful);
    return r;
  };
  const FitResult some = assessed_with(120.0), few = assessed_with(60.0);
  EXPECT_EQ(some.derived[0].trust, Trust::good);
  EXPECT_EQ(some.derived[1].trust, Trust::doubtful);
  EXPECT_NE(some.derived[1].trust_reason.find("correlated"), std::string::npos);
  EXPECT_EQ(few.derived[0].trust, Trust::doubtful);
}

// Where no end of a sheet is in view, its length, phase and place along itself are nobody's fault.
TEST(Verdict, HoldsWithoutBlameWhatOnlyEndsWouldTell) {
  FitResult r = fine();
  sim::Sheet sheet;
  sheet.name = "main";
  r.best.sheets = {sheet};
  FittedParameter p;
  for (const char* path : {"sheet.main.length_km", "sheet.main.center_km.east"}) {
    p.path = path;
    r.parameters.push_back(p);
  }
  FitResult without_distance = r;
  DerivedNumber distance;
  distance.name = "distance of the main sheet";
  distance.value = 200.0;
  distance.sigma = 2.0;
  r.derived = {distance};
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::good);
  EXPECT_NE(r.verdict_line.find("length_km and center_km.east"), std::string::npos) << r.verdict_line;
  assess_fit(clear(), without_distance);
  EXPECT_EQ(without_distance.verdict, Verdict::doubtful);

  r.parameters[1].sigma = 30.0;
  r.parameters[1].at_limit = true;
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::good) << "a length at its limit";
  r.parameters[0].sigma.reset();
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::doubtful) << "the energy has no error bar";
}

TEST(Verdict, KeepsWhatItAskedAndWhatItFound) {
  FitResult r = fine();
  r.chi2 = 3100.0;
  r.termination = "converged";
  assess_fit(clear(), r);
  std::vector<std::string> names, failed;
  for (const Check& check : r.checks) {
    names.push_back(check.name);
    EXPECT_FALSE(check.words.empty()) << check.name;
    if (!check.passed) failed.push_back(check.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"converged", "chi2 fell", "gradient at the end",
                                             "chi2 per degree of freedom", "rms residual",
                                             "effective sample size", "moved", "inside the limits",
                                             "error bars", "aurora or none", "one answer"}));
  EXPECT_EQ(failed, std::vector<std::string>{"chi2 per degree of freedom"});
  assess_fit(clear(), r);
  EXPECT_EQ(r.checks.size(), names.size()) << "assessed again, not twice";
}

TEST(Verdict, SaysHowTheSearchEndedOnceAndWithoutTheSolversWords) {
  FitResult r = fine();
  r.termination = "converged: another step would hardly change chi2 (Ceres: Function tolerance reached.)";
  assess_fit(clear(), r);
  EXPECT_TRUE(tests::has_facts(r.checks.front().words, "another step"));
  for (const char* bare : {"converged", ""}) {
    r.termination = bare;
    assess_fit(clear(), r);
    EXPECT_EQ(r.checks.front().words, "the search ended");
  }
}

TEST(Verdict, AStartThatIsTheAnswerIsNoReasonToDoubt) {
  FitResult r = fine();
  r.parameters.push_back(r.parameters[0]);
  for (FittedParameter& p : r.parameters) p.moved = false;
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::good) << r.verdict_line;
  // All stand still on a slope: nothing was searched.
  r.gradient_cosine = 0.5;
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::doubtful);
  EXPECT_EQ(r.reasons.size(), 3u);
}

// A frame that begins where the one before it ended: some numbers move in their last digits, others not.
TEST(Verdict, AStartNextToTheAnswerIsNoReasonToDoubt) {
  FitResult r = fine();
  r.parameters.push_back(r.parameters[0]);
  r.parameters[0].moved_sigma = 0.05;
  r.parameters[1].moved = false;
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::good) << r.verdict_line;
  r.parameters[0].moved_sigma = 0.2;
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::doubtful);
  r.parameters[0].moved_sigma = 0.05;
  r.gradient_cosine = 0.5;
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::doubtful);
}

TEST(Verdict, AParameterWithoutInfluenceDoesNotHaveToMove) {
  FitResult r = fine();
  r.parameters.push_back(r.parameters[0]);
  r.parameters[1].moved = false;
  r.parameters[1].sigma.reset();
  r.parameters[1].why_no_sigma = "the data do not bound it";
  assess_fit(clear(), r);
  ASSERT_EQ(r.reasons.size(), 1u);
  EXPECT_NE(r.reasons[0].find("no error bar"), std::string::npos);
}

TEST(Verdict, TellsATradeOffOnceThoughManyLeanOnIt) {
  FitResult r = fine();
  r.best.sheets.resize(1);
  r.parameters.push_back(r.parameters[0]);
  r.parameters[1].path = "sheet.main.center_km.north";
  for (FittedParameter& p : r.parameters) {
    p.sigma.reset();
    p.why_no_sigma = "told in the report";
  }
  r.undetermined = {"distance and energy of the main sheet trade off: this with that looks the same"};
  assess_fit(clear(), r);
  ASSERT_GE(r.reasons.size(), 2u);
  EXPECT_EQ(r.reasons[0], r.undetermined[0]);
  EXPECT_TRUE(tests::has_facts(r.reasons[1], "energy_kev and center_km.north"));
  EXPECT_EQ(r.verdict_line.find("told in the report"), std::string::npos) << r.verdict_line;
}

TEST(Verdict, NotesAnUnusualSheetWithoutDoubt) {
  FitResult r = fine();
  r.best.sheets.resize(1);
  r.best.sheets[0].wavelength_km = 10.0;
  assess_fit(clear(), r);
  EXPECT_EQ(r.verdict, Verdict::good);
  ASSERT_EQ(r.reasons.size(), 1u);
  EXPECT_NE(r.reasons[0].find("nature prefers 5.2 to 31.4"), std::string::npos) << r.reasons[0];
  EXPECT_EQ(r.verdict_line.find("nature"), std::string::npos);
}

TEST(Verdict, NeverCallsAFailureASuccess) {
  FitResult r = fine();
  Evidence e = clear();
  e.converged = false;
  assess_fit(e, r);
  EXPECT_EQ(r.verdict, Verdict::failed);
  e = clear();
  e.aurora_in_view = false;
  assess_fit(e, r);
  EXPECT_EQ(r.verdict, Verdict::failed);
  EXPECT_NE(r.verdict_line.find("region of interest"), std::string::npos);
  e = clear();
  e.stopped = true;
  assess_fit(e, r);
  EXPECT_EQ(r.verdict, Verdict::interrupted);
}

TEST(Verdict, SpeaksOfWhatTheSceneShinesWith) {
  const auto words_of = [](const sim::Scene& scene) {
    FitResult r = fine();
    r.best = scene;
    Evidence dark = clear();
    dark.chi2_without_aurora = r.chi2;
    assess_fit(dark, r);
    return r.verdict_line;
  };
  sim::Scene sun;
  sun.sun.shown = true;
  EXPECT_NE(words_of(sun).find("any solar light"), std::string::npos);
  sim::Scene arc = sun;
  arc.footprints.resize(1);
  EXPECT_NE(words_of(arc).find("without any aurora"), std::string::npos);
  sim::Scene nebula;
  nebula.nebulae.resize(1);
  EXPECT_NE(words_of(nebula).find("without any nebula"), std::string::npos);
  FitResult none = fine();
  none.best = sun;
  Evidence outside = clear();
  outside.aurora_in_view = false;
  assess_fit(outside, none);
  EXPECT_NE(none.verdict_line.find("no light"), std::string::npos) << none.verdict_line;
}

}  // namespace
}  // namespace vegard::fit::verdict_test
