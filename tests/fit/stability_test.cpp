#include "fit/stability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "fit/answer/derived.h"
#include "fit/fit.h"
#include "fit/report/table/result_json.h"
#include "fit/report/table/validation_table.h"
#include "tests/support/free_paths.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::stability_test {
namespace {

StabilityRow row_of(const std::string& choice, double shift, double by_chance) {
  StabilityRow row;
  row.choice = choice;
  row.derived = {{shift, by_chance}};
  return row;
}

// Two regions 3 and -5 away, of which chance explains a variance of 1 each: a mean square of (9 + 25 - 2)
// / 2. A shift that chance explains adds nothing; a row without a value has no effect.
TEST(SystematicError, IsWhatGoesBeyondChanceAddedOverTheChoices) {
  std::vector<StabilityRow> rows = {row_of("region", 3.0, 1.0), row_of("region", -5.0, 1.0)};
  EXPECT_DOUBLE_EQ(systematic_error(rows, 0).value(), 4.0);
  rows.push_back(row_of("bands", 2.0, 100.0));
  EXPECT_DOUBLE_EQ(systematic_error(rows, 0).value(), 4.0);
  rows.push_back(row_of("air", 3.0, 0.0));
  EXPECT_DOUBLE_EQ(systematic_error(rows, 0).value(), 5.0);
  rows.push_back(row_of("curve", 50.0, 0.0));
  rows.back().is_refuted = true;
  EXPECT_DOUBLE_EQ(systematic_error(rows, 0).value(), 5.0);
  StabilityRow failed;
  failed.choice = "air";
  rows.push_back(failed);
  rows.push_back(row_of("air", std::nan(""), 0.0));
  EXPECT_DOUBLE_EQ(systematic_error(rows, 0).value(), 5.0);
  EXPECT_FALSE(systematic_error({}, 0));
  EXPECT_FALSE(systematic_error(rows, 1));
}

sim::Scene one_sheet() {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].name = "main";
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sky.level = {0.002, 0.003, 0.004};
  scene.fit.bands = 6;
  scene.fit.sky_terms = 2;
  scene.fit.scan_points = 0;
  scene.fit.free = {tests::free_entry("sheet.main.center_km.north"),
                    tests::free_entry("sheet.main.energy_kev")};
  return scene;
}

TEST(Variations, ChangeOneChoiceEach) {
  sim::Scene best = one_sheet();
  Photo photo = tests::linear_photo(best);
  std::multiset<std::string> choices;
  const std::vector<Variation> all = variations_of(best, {photo});
  for (const Variation& v : all) {
    choices.insert(v.choice);
    EXPECT_EQ(v.scene.fit.scan_points, 0);
    EXPECT_EQ(v.scene.sheets[0].center_km.north, best.sheets[0].center_km.north);
  }
  EXPECT_EQ(choices, (std::multiset<std::string>{"air", "air", "bands", "bands", "model error", "model error",
                                                 "region", "region", "region", "region", "sky", "sky"}));
  EXPECT_EQ(all[0].scene.fit.roi_px, (std::array<int, 4>{53, 0, 107, 120}));
  EXPECT_EQ(all[0].scene.fit.bands, 4) << "as wide as they were";
  EXPECT_EQ(all[3].scene.fit.roi_px, (std::array<int, 4>{0, 0, 160, 108}));

  // Where light came out of a display's curve, that may be another one; haze that is free is no choice.
  photo.srgb = true;
  best.air.model = sim::AirModel::standard;
  best.fit.free.push_back(tests::free_entry("air.aerosol_optical_depth"));
  choices.clear();
  for (const Variation& v : variations_of(best, {photo})) choices.insert(v.choice);
  EXPECT_EQ(choices.count("curve"), 2u);
  EXPECT_EQ(choices.count("air"), 0u);
}

const DerivedNumber& distance_in(const FitResult& result) { return result.derived.front(); }

// A picture of the model itself: no choice moves the distance by more than its error bars, or by 1 %, to
// which the fit's wider film has it (profile_cost_test). Two threads find what one does.
TEST(Stability, LetsTheModelsOwnPictureStand) {
  const sim::Scene truth = one_sheet();
  const std::vector<Photo> photos = {tests::linear_photo(truth)};
  FitResult alone = fit_photo(truth, photos.front(), {});
  ASSERT_EQ(distance_in(alone).name, "distance of the main sheet");
  FitResult side_by_side = alone;
  FitOptions options;
  options.threads = 1;
  assess_stability(photos, options, alone);
  options.threads = 2;
  assess_stability(photos, options, side_by_side);
  EXPECT_EQ(result_json(alone), result_json(side_by_side));

  ASSERT_TRUE(alone.stability && distance_in(alone).systematic);
  for (const StabilityRow& row : *alone.stability)
    EXPECT_EQ(row.problem, "") << row.choice << " " << row.name;
  EXPECT_LT(*distance_in(alone).systematic, 0.01 * distance_in(alone).value);
  EXPECT_DOUBLE_EQ(*distance_in(alone).error(),
                   std::hypot(*distance_in(alone).sigma, *distance_in(alone).systematic));
  EXPECT_NE(stability_table(alone).find("left third"), std::string::npos);
}

// The sheet of the picture turns away by 12 degrees where the model's bearing is held: the left of the region
// has it farther away than the right, which one distance cannot tell, and its error bar says so.
TEST(Stability, FindsWhatTheModelCannotHave) {
  sim::Scene truth = one_sheet();
  const std::vector<Photo> photos = {tests::linear_photo(truth)};
  sim::Scene start = truth;
  start.sheets[0].bearing_deg += 12.0;
  FitResult result = fit_photo(start, photos.front(), {});
  assess_stability(photos, {}, result);
  ASSERT_TRUE(result.stability && distance_in(result).systematic);
  const std::vector<StabilityRow>& rows = *result.stability;
  EXPECT_LT(rows[0].derived[0].by * rows[1].derived[0].by, 0.0) << "to either side";
  EXPECT_GT(*distance_in(result).systematic, 0.02 * distance_in(result).value);
}

TEST(Stability, LeavesAnAnswerAloneThatIsNone) {
  const sim::Scene scene = one_sheet();
  FitResult result;
  result.verdict = Verdict::failed;
  assess_stability({tests::linear_photo(scene)}, {}, result);
  EXPECT_FALSE(result.stability);
}

}  // namespace
}  // namespace vegard::fit::stability_test
