// Velocities of a survey: which numbers are followed, where tracks end, and the same bytes again.
#include "fit/survey/survey_motion.h"

#include <gtest/gtest.h>

#include "fit/survey/survey_export.h"
#include "fit/survey/survey_merge.h"
#include "fit/survey/survey_results.h"
#include "fit/survey/survey_run.h"
#include "tests/fit/survey/made_answers.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::survey_motion_test {
namespace {

using tests::bytes_of;
using tests::made_survey_plan;

/// Two blocks of 20 frames, the second a quarter of an hour after the first. The main sheet goes away by 200
/// m/s, with a jump in frame 8; every fifth frame is missing.
SurveyPlan made_moving_plan() {
  SurveyPlan plan = made_survey_plan(2, 20);
  for (PlannedFrame& frame : plan.blocks[1].frames) frame.time_s += 900.0;
  plan.sha256 = sim::sha256(plan_json(plan));
  return plan;
}

FrameAnswer made_moving_answer(const SurveyPlan& plan, int block, int number) {
  FrameAnswer answer = tests::made_answer(plan, block, number);
  if (answer.status != FrameStatus::done) return answer;
  WorkAnswer& fit = answer.works[1];
  const double since_s = answer.time_s - plan.blocks[0].frames[0].time_s;
  for (SurveyQuantity& q : fit.quantities)
    if (q.name == "distance of the main sheet") {
      q.value = 220.0 + 0.2 * since_s + (answer.frame == 8 ? 40.0 : 0.0);
      q.sigma = 0.5;
    } else if (q.name == "sheet.main.energy_kev") {
      q.sigma = 0.1;
    }
  fit.quantities.push_back(
      {0, "lower border of 557.7 nm (a tenth of the peak) of the main sheet", "km", 100.0, 0.5, "good", {}});
  if (number == 11) fit.verdict = "failed";
  return answer;
}

std::string made_survey(const std::string& name, const SurveyPlan& plan, int shards) {
  std::vector<std::string> names;
  for (int shard = 1; shard <= shards; ++shard) {
    names.push_back(name + shard_name(shard, shards));
    ShardResults results(names.back(), plan);
    const BlockRange range = blocks_of_shard(plan, shard, shards);
    std::vector<FrameAnswer> all;  // at once: each transaction waits for the disk
    for (int b = range.begin; b < range.end; ++b)
      for (int f = 0; f < 20; ++f) all.push_back(made_moving_answer(plan, b, f));
    results.add(all);
  }
  merge_surveys(names, name, false, false);
  return name;
}

TEST(SurveyMotion, FollowsDistancesAndBordersBetweenGaps) {
  const tests::TemporaryFolder folder;
  const std::string survey = made_survey(folder / "a.sqlite", made_moving_plan(), 1);
  const SurveyMotion motion = smooth_survey(survey, folder / "moving.sqlite", {}, false);
  EXPECT_EQ(motion.tracks, 4);  // two numbers before the gap, and two behind it
  // Of 20 frames each, 4 are missing, and one fit has failed.
  EXPECT_EQ(motion.used + motion.outliers, 4 * 15);
  EXPECT_EQ(motion.outliers, 1);
  EXPECT_EQ(motion.breaks, 0);
  const SqliteFile file(folder / "moving.sqlite", SqliteFile::Opening::read);
  const SurveyReader reader(file);  // takes the tables for sound
  EXPECT_TRUE(has_motion(file));
  SqliteStatement flags(file, "SELECT frame, name, kind, chi2 > chi2_limit FROM flag");
  ASSERT_TRUE(flags.step());
  EXPECT_EQ(flags.integer(0), 8);
  EXPECT_EQ(flags.text(1), "distance of the main sheet");
  EXPECT_EQ(flags.text(2), "outlier");
  EXPECT_EQ(flags.integer(3), 1);
  EXPECT_FALSE(flags.step());
  SqliteStatement rows(
      file, "SELECT velocity, velocity_sigma, velocity_unit FROM velocity WHERE name LIKE 'distance%'");
  int count = 0;
  for (; rows.step(); ++count) {
    EXPECT_NEAR(rows.number(0), 200.0, 0.1);
    EXPECT_GT(rows.number(1), 0.0);
    EXPECT_EQ(rows.text(2), "m/s");
  }
  EXPECT_EQ(count, 30);
}

TEST(SurveyMotion, FollowsWhatIsAskedForAsWell) {
  const tests::TemporaryFolder folder;
  const std::string survey = made_survey(folder / "a.sqlite", made_moving_plan(), 1);
  SurveyMotionOptions options;
  options.quantities = {"sheet.main.energy_kev"};
  options.gap_s = 1000.0;
  EXPECT_EQ(smooth_survey(survey, folder / "moving.sqlite", options, false).tracks, 3);
  const SqliteFile file(folder / "moving.sqlite", SqliteFile::Opening::read);
  EXPECT_EQ(file.integer("SELECT count(*) FROM velocity WHERE velocity_unit = 'keV/s'"), 30);
}

TEST(SurveyMotion, GivesTheSameBytesOfAnyCutAndOfItself) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_moving_plan();
  const std::string one = made_survey(folder / "one.sqlite", plan, 1),
                    two = made_survey(folder / "two.sqlite", plan, 2);
  smooth_survey(one, folder / "one.moving", {}, false);
  smooth_survey(two, folder / "two.moving", {}, false);
  EXPECT_EQ(bytes_of(folder / "one.moving"), bytes_of(folder / "two.moving"));
  smooth_survey(folder / "one.moving", folder / "again.moving", {}, false);
  EXPECT_EQ(
      SqliteFile(folder / "again.moving", SqliteFile::Opening::read).integer("SELECT count(*) FROM velocity"),
      60);
  // Merged again it is what it was before.
  merge_surveys({folder / "one.moving"}, folder / "merged.sqlite", false, false);
  EXPECT_EQ(bytes_of(folder / "merged.sqlite"), bytes_of(one));
}

TEST(SurveyMotion, IsExportedAndRefused) {
  const tests::TemporaryFolder folder;
  const std::string survey = made_survey(folder / "a.sqlite", made_moving_plan(), 1);
  const SqliteFile before(survey, SqliteFile::Opening::read);
  tests::expect_error(sim::ErrorKind::usage, [&] {
    write_survey_csv(before, SurveyTableKind::velocities, folder / "v.csv", false);
  });
  smooth_survey(survey, folder / "moving.sqlite", {}, false);
  const SqliteFile file(folder / "moving.sqlite", SqliteFile::Opening::read);
  write_survey_csv(file, SurveyTableKind::velocities, folder / "v.csv", false);
  write_survey_csv(file, SurveyTableKind::flags, folder / "f.csv", false);
  const std::string table = bytes_of(folder / "v.csv"), flags = bytes_of(folder / "f.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 61);
  EXPECT_NE(table.find("\n0,gill,2019-03-01T22:10:00.25Z,fit,0,distance of the main sheet,1,"),
            std::string::npos)
      << table.substr(0, 300);
  EXPECT_NE(flags.find("\n8,gill,gill/8.png,"), std::string::npos) << flags;
  tests::expect_error(sim::ErrorKind::existing_output,
                      [&] { smooth_survey(survey, folder / "moving.sqlite", {}, false); });
  for (const double share : {0.0, 0.5, -1.0}) {
    SurveyMotionOptions options;
    options.false_alarms = share;
    tests::expect_error(sim::ErrorKind::usage,
                        [&] { smooth_survey(survey, folder / "other.sqlite", options, false); });
  }
  tests::put(folder / "none.sqlite", "no database");
  tests::expect_error(sim::ErrorKind::unreadable_input,
                      [&] { smooth_survey(folder / "none.sqlite", folder / "other.sqlite", {}, false); });
}

}  // namespace
}  // namespace vegard::fit::survey_motion_test
