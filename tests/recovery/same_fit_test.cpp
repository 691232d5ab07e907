// A fit is a function of its scene and its photograph: neither threads nor runs are in the answer.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fit/fit.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/source_folder.h"

namespace vegard::fit::same_fit_test {
namespace {

const std::string kShipped = tests::source_folder() + "/data/examples/h000";

/// The shipped example, with so few beams and trials that the whole search takes seconds.
sim::Scene short_work() {
  sim::Scene scene = sim::read_scene(kShipped + "/scene.toml");
  sim::set_from_text(scene, "sheet.main.beams", "240");
  sim::set_from_text(scene, "fit.bands", "8");
  sim::set_from_text(scene, "fit.scan_points", "4");
  sim::set_from_text(scene, "fit.scan_descents", "2");
  sim::validate(scene);
  return scene;
}

FitResult fitted(const sim::Scene& scene, int threads) {
  FitOptions options;
  options.threads = threads;
  options.max_evaluations = 150;
  return fit_photo(scene, read_photo(kShipped + "/photo.jpg", Decoding::automatic), options);
}

/// Bit for bit: == on doubles that are no NaN.
void expect_same(const FitResult& a, const FitResult& b) {
  EXPECT_EQ(a.verdict_line, b.verdict_line);
  EXPECT_EQ(a.termination, b.termination);
  EXPECT_EQ(a.chi2, b.chi2);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.jacobian_evaluations, b.jacobian_evaluations);
  EXPECT_EQ(a.error_inflation, b.error_inflation);
  ASSERT_EQ(a.parameters.size(), b.parameters.size());
  for (std::size_t j = 0; j < a.parameters.size(); ++j) {
    EXPECT_EQ(a.parameters[j].value, b.parameters[j].value) << a.parameters[j].path;
    EXPECT_EQ(a.parameters[j].sigma, b.parameters[j].sigma) << a.parameters[j].path;
    EXPECT_EQ(a.parameters[j].interval68, b.parameters[j].interval68) << a.parameters[j].path;
  }
  EXPECT_EQ(a.correlation, b.correlation);
  EXPECT_EQ(a.photos[0].gain, b.photos[0].gain);
  EXPECT_EQ(a.photos[0].model, b.photos[0].model);
  ASSERT_EQ(a.trace.size(), b.trace.size());
  for (std::size_t i = 0; i < a.trace.size(); ++i) {
    EXPECT_EQ(a.trace[i].stage, b.trace[i].stage);
    EXPECT_EQ(a.trace[i].chi2, b.trace[i].chi2);
    EXPECT_EQ(a.trace[i].values, b.trace[i].values);
  }
}

TEST(SameFit, ForAnyThreadsAndRun) {
  const sim::Scene scene = short_work();
  const FitResult one = fitted(scene, 1);
  ASSERT_EQ(one.parameters.size(), 7u);
  EXPECT_GT(one.jacobian_evaluations, 20);
  EXPECT_LT(one.chi2, one.chi2_initial);
  {
    SCOPED_TRACE("two threads");
    expect_same(one, fitted(scene, 2));
  }
  {
    SCOPED_TRACE("two threads again");
    expect_same(one, fitted(scene, 2));
  }
  // The comparison can fail: another seed draws other beams and another search.
  sim::Scene other = scene;
  other.seed += 1;
  EXPECT_NE(one.chi2, fitted(other, 2).chi2);
}

}  // namespace
}  // namespace vegard::fit::same_fit_test
