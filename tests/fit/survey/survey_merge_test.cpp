// Many databases as one: the same bytes however the work was cut, and what is refused.
#include "fit/survey/survey_merge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "fit/survey/survey_export.h"
#include "fit/survey/survey_results.h"
#include "fit/survey/survey_run.h"
#include "tests/fit/survey/made_answers.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::survey_merge_test {
namespace {

using tests::bytes_of;
using tests::made_answer;
using tests::made_survey_plan;

/// The shard's database, up to `most` frames of each block; in transactions of three frames or less.
std::string made_shard(const std::string& name, const SurveyPlan& plan, int shard, int shards,
                       int most = 1000) {
  ShardResults results(name, plan);
  const BlockRange range = blocks_of_shard(plan, shard, shards);
  for (int b = range.begin; b < range.end; ++b) {
    std::vector<FrameAnswer> some;
    const int count =
        std::min(most, static_cast<int>(plan.blocks[static_cast<std::size_t>(b)].frames.size()));
    for (int f = results.done(b); f < count; ++f) {
      some.push_back(made_answer(plan, b, f));
      if (some.size() < 3 && f + 1 < count) continue;
      results.add(some);
      some.clear();
    }
  }
  return name;
}

std::vector<std::string> made_shards(const tests::TemporaryFolder& folder, const SurveyPlan& plan,
                                     int shards) {
  std::vector<std::string> names;
  for (int shard = 1; shard <= shards; ++shard)
    names.push_back(made_shard(folder / shard_name(shard, shards), plan, shard, shards));
  return names;
}

TEST(SurveyMerge, GivesTheSameBytesForAnyNumberAndOrderOfShards) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_survey_plan(20, 7);
  const SurveyMerge one = merge_surveys(made_shards(folder, plan, 1), folder / "one.sqlite", false, false);
  EXPECT_EQ(one.frames, 140);
  EXPECT_EQ(one.lacking, 0);
  std::vector<std::string> seven = made_shards(folder, plan, 7);
  merge_surveys(seven, folder / "seven.sqlite", false, false);
  EXPECT_EQ(bytes_of(folder / "one.sqlite"), bytes_of(folder / "seven.sqlite"));
  std::reverse(seven.begin(), seven.end());
  std::swap(seven[1], seven[4]);
  merge_surveys(seven, folder / "turned.sqlite", false, false);
  EXPECT_EQ(bytes_of(folder / "one.sqlite"), bytes_of(folder / "turned.sqlite"));
  // Twice the same, what was merged before, and shards of another cut.
  seven.push_back(folder / "one.sqlite");
  seven.push_back(seven[0]);
  for (const std::string& name : made_shards(folder, plan, 3)) seven.push_back(name);
  merge_surveys(seven, folder / "one.sqlite.again", false, false);
  EXPECT_EQ(bytes_of(folder / "one.sqlite"), bytes_of(folder / "one.sqlite.again"));
  merge_surveys(made_shards(folder, plan, 7), folder / "one.sqlite.again", false, true);
  EXPECT_EQ(bytes_of(folder / "one.sqlite"), bytes_of(folder / "one.sqlite.again"));
}

TEST(SurveyMerge, TakesTheLongestOfABlockThatSeveralHave) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_survey_plan(4, 7);
  const std::string cut_off = made_shard(folder / "cut.sqlite", plan, 1, 1, 5);
  const SurveyMerge part = merge_surveys({cut_off}, folder / "part.sqlite", false, false);
  EXPECT_EQ(part.frames, 20);
  EXPECT_EQ(part.lacking, 8);
  const std::string half = made_shard(folder / "half.sqlite", plan, 2, 2);
  const SurveyMerge more = merge_surveys({cut_off, half}, folder / "more.sqlite", false, false);
  EXPECT_EQ(more.frames, 24);
  merge_surveys({made_shard(folder / "cut.sqlite", plan, 1, 1)}, folder / "whole.sqlite", false, false);
  merge_surveys({folder / "part.sqlite", folder / "cut.sqlite"}, folder / "both.sqlite", false, false);
  EXPECT_EQ(bytes_of(folder / "whole.sqlite"), bytes_of(folder / "both.sqlite"));
}

TEST(SurveyMerge, RefusesTwoAnswersForOneFrame) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_survey_plan(2, 3);
  const std::string a = made_shard(folder / "a.sqlite", plan, 1, 1),
                    b = made_shard(folder / "b.sqlite", plan, 1, 1);
  for (const char* change : {"UPDATE quantity SET value = value + 1e-12 WHERE frame = 4",
                             "UPDATE frame SET sha256 = '00' WHERE frame = 0",
                             "UPDATE result SET verdict = 'doubtful' WHERE frame = 1 AND work = 'fit'"}) {
    std::filesystem::copy_file(a, b, std::filesystem::copy_options::overwrite_existing);
    {
      SqliteFile file(b, SqliteFile::Opening::write);
      file.run(change);
    }
    const std::string words = tests::expect_error(sim::ErrorKind::unreadable_input, [&] {
      merge_surveys({a, b}, folder / "out.sqlite", false, false);
    });
    EXPECT_NE(words.find("other answers"), std::string::npos) << words;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.sqlite"));
  }
}

TEST(SurveyMerge, MixesPlansAndVersionsOnlyWhenTold) {
  const tests::TemporaryFolder folder;
  const SurveyPlan night = made_survey_plan(2, 3), day = made_survey_plan(2, 2, "day");
  const std::string a = made_shard(folder / "a.sqlite", night, 1, 1),
                    b = made_shard(folder / "b.sqlite", day, 1, 1);
  const std::string old = made_shard(folder / "old.sqlite", night, 1, 1);
  {
    SqliteFile file(old, SqliteFile::Opening::write);
    file.run("UPDATE origin SET vegard = '0.0.9'; UPDATE result SET verdict = 'failed' WHERE work = 'fit'");
  }
  const auto refused = [&](const std::string& x, const std::string& y) {
    return tests::expect_error(sim::ErrorKind::usage, [&] {
      merge_surveys({x, y}, folder / "no.sqlite", false, false);
    });
  };
  EXPECT_TRUE(tests::has_facts(refused(a, b), "2 plans | 'day' | 'night'"));
  EXPECT_NE(refused(a, old).find("vegard 0.0.9"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "no.sqlite"));
  const SurveyMerge merge = merge_surveys({a, b}, folder / "ab.sqlite", true, false);
  EXPECT_EQ(merge.plans, 2);
  EXPECT_EQ(merge.frames, 10);
  merge_surveys({b, a}, folder / "ba.sqlite", true, false);
  EXPECT_EQ(bytes_of(folder / "ab.sqlite"), bytes_of(folder / "ba.sqlite"));
  const SqliteFile file(folder / "ab.sqlite", SqliteFile::Opening::read);
  int next = 0;
  SurveyReader(file).frames(0, 100, [&](const FrameAnswer& answer) { EXPECT_EQ(answer.frame, next++); });
  EXPECT_EQ(next, 10);
  EXPECT_EQ(SurveyReader(file).origins()[1].plan, 1);
  // Of both versions the newer counts.
  merge_surveys({old, a}, folder / "new.sqlite", true, false);
  const SqliteFile newer(folder / "new.sqlite", SqliteFile::Opening::read);
  SurveyReader(newer).frames(
      0, 1, [](const FrameAnswer& answer) { EXPECT_EQ(answer.works.back().verdict, "good"); });
  tests::expect_error(sim::ErrorKind::usage, [&] {
    merge_surveys({folder / "ab.sqlite", a}, folder / "no.sqlite", true, false);
  });
}

TEST(SurveyExport, HasARowForEachFrameOrNumber) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_survey_plan(1, 4);
  const SqliteFile file(made_shard(folder / "a.sqlite", plan, 1, 1), SqliteFile::Opening::read);
  const auto table = [&](SurveyTableKind kind) {
    write_survey_csv(file, kind, folder / "out.csv", true);
    return bytes_of(folder / "out.csv");
  };
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  const std::string wide = table(SurveyTableKind::wide);
  EXPECT_EQ(wide.substr(0, wide.find('\n')),
            "frame,camera,file,time_utc,status,reason,border verdict,fit verdict,fit: distance of the main "
            "sheet (km),sigma of "
            "fit: distance of the main sheet (km),trust of fit: distance of the main sheet (km),fit: energy "
            "flux Q of the main "
            "sheet (mW m\xe2\x81\xbb\xc2\xb2),sigma of fit: energy flux Q of the main sheet (mW "
            "m\xe2\x81\xbb\xc2\xb2),trust of fit: "
            "energy flux Q of the main sheet (mW m\xe2\x81\xbb\xc2\xb2),fit: sheet.main.energy_kev "
            "(keV),sigma of fit: "
            "sheet.main.energy_kev (keV),trust of fit: sheet.main.energy_kev (keV)");
  EXPECT_NE(
      wide.find(
          "\n1,gill,gill/1.png,2019-03-01T22:10:03.25Z,done,,none,good,221,3.25,good,,,unconstrained,1,,\n"),
      std::string::npos)
      << wide;
  EXPECT_NE(
      wide.find("\n2,gill,gill/2.png,2019-03-01T22:10:06.25Z,missing,there is no such file,,,,,,,,,,,\n"),
      std::string::npos)
      << wide;
  EXPECT_EQ(lines(wide), 5);
  EXPECT_EQ(lines(table(SurveyTableKind::frames)), 5);
  EXPECT_EQ(lines(table(SurveyTableKind::results)), 1 + 3 * 2);
  EXPECT_EQ(lines(table(SurveyTableKind::quantities)), 1 + 3 * 3);
}

}  // namespace
}  // namespace vegard::fit::survey_merge_test
