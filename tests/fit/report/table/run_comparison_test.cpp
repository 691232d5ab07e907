// Runs are compared by what their result.json says, and only if they are of the same data.
#include "fit/report/table/run_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "fit/report/table/result_json.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_fit.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::run_comparison_test {
namespace {

RunSummary run_named(const std::string& name, double chi2, int unknowns) {
  RunSummary run;
  run.name = name;
  run.verdict = "good";
  run.chi2 = chi2;
  run.dof = 1000 - unknowns;
  run.pictures = {{"photo", "aa"}};
  run.decoding = "linear";
  run.regions_px = {{0, 0, 10, 10}};
  run.values = 1000;
  run.sum_of_weights = 1e6;
  run.unknowns = unknowns;
  return run;
}

TEST(ReadRun, FindsWhatWasWritten) {
  const tests::TemporaryFolder folder;
  const FitResult result = tests::small_fit(tests::small_photo());
  tests::put(folder / "result.json", result_json(result));
  const std::string directory = std::filesystem::path(folder / "result.json").parent_path().string();
  const RunSummary run = read_run(directory + "/");
  EXPECT_EQ(run.name, directory);
  EXPECT_EQ(run.verdict, "doubtful");
  EXPECT_EQ(run.chi2, result.chi2);
  EXPECT_EQ(run.dof, result.dof);
  EXPECT_EQ(run.correlated_residuals, 2.25);
  ASSERT_EQ(run.paths.size(), 2u);
  EXPECT_EQ(run.parameters.at("sheet.main.energy_kev").value, result.parameters[0].value);
  EXPECT_EQ(run.parameters.at("sheet.main.energy_kev").sigma, 0.1234);
  EXPECT_FALSE(run.parameters.at("sheet.main.phase_rad").sigma);
  ASSERT_EQ(run.pictures.size(), 1u) << "the scene is what may differ";
  EXPECT_EQ(run.pictures[0][1], std::string(64, 'a'));
  EXPECT_EQ(run.regions_px, result.compared.regions_px);
  EXPECT_EQ(run.values, 120);
  EXPECT_EQ(run.sum_of_weights, 1e4 / 3.0);
  EXPECT_EQ(run.sampling_error, 0.004);
  EXPECT_EQ(run.unknowns, 10);
}

TEST(ReadRun, RefusesWhatIsNone) {
  const tests::TemporaryFolder folder;
  const std::string directory = std::filesystem::path(folder / "x").parent_path().string();
  const auto text = [&] {
    return tests::expect_error(sim::ErrorKind::unreadable_input, [&] { read_run(directory); });
  };
  EXPECT_NE(text().find("no such file"), std::string::npos);
  tests::put(folder / "result.json", "[1]");
  EXPECT_NE(text().find("no JSON"), std::string::npos);
  tests::put(folder / "result.json", "{\"verdict\": \"good\"}");
  EXPECT_NE(text().find("fit it again"), std::string::npos);
}

TEST(ComparedRuns, TheLeastBicIsTheBest) {
  // chi2 falls by 40 for three unknowns, by 1 for another; inflation 1, so that all values are independent.
  const RunComparison c =
      compared({run_named("one", 1040.0, 10), run_named("two", 1000.0, 13), run_named("three", 999.0, 14)});
  EXPECT_EQ(c.best, 1u);
  EXPECT_EQ(c.runs[1].bic_difference, 0.0);
  EXPECT_NEAR(c.runs[0].bic_difference, 40.0 - 3.0 * std::log(c.independent_values), 1.0);
  EXPECT_NEAR(c.runs[2].bic_difference, std::log(c.independent_values) - 1.0, 0.1);
  EXPECT_NEAR(c.runs[0].aic_difference, 34.0, 1.0);
  ASSERT_EQ(c.sentences.size(), 2u);
  EXPECT_TRUE(tests::has_facts(c.sentences[0], "two | better than one")) << c.sentences[0];
  EXPECT_TRUE(tests::has_facts(c.sentences[1], "two | better than three")) << c.sentences[1];
}

TEST(ComparedRuns, AreOfTheSameData) {
  const RunSummary one = run_named("one", 1040.0, 10);
  const auto refusal = [&](const RunSummary& two) {
    return tests::expect_error(sim::ErrorKind::usage, [&] { compared({one, two}); });
  };
  RunSummary two = run_named("two", 1000.0, 13);
  EXPECT_NO_THROW(compared({one, two}));
  two.pictures[0][1] = "bb";
  EXPECT_NE(refusal(two).find("another photograph"), std::string::npos);
  two = run_named("two", 1000.0, 13);
  two.decoding = "sRGB";
  EXPECT_NE(refusal(two).find("decoding"), std::string::npos);
  two = run_named("two", 1000.0, 13);
  two.regions_px[0][2] = 9;
  EXPECT_NE(refusal(two).find("fit.roi_px"), std::string::npos);
  two = run_named("two", 1000.0, 13);
  two.values = 999;
  EXPECT_NE(refusal(two).find("number of values"), std::string::npos);
  two = run_named("two", 1000.0, 13);
  two.sum_of_weights *= 1.001;
  EXPECT_NE(refusal(two).find("weights"), std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::run_comparison_test
