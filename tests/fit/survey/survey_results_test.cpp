// A shard's database: what is kept, what is refused, and what a full disk or a second writer leaves.
#include "fit/survey/survey_results.h"

#include <gtest/gtest.h>

#include "tests/fit/survey/made_answers.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::survey_results_test {
namespace {

using tests::made_answer;
using tests::made_survey_plan;

std::vector<FrameAnswer> all_of(const std::string& name) {
  const SqliteFile file(name, SqliteFile::Opening::read);
  std::vector<FrameAnswer> all;
  SurveyReader(file).frames(0, 1000, [&](const FrameAnswer& answer) { all.push_back(answer); });
  return all;
}

TEST(SurveyResults, ComeBackExactly) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_survey_plan(2, 3);
  ShardResults results(folder / "a.sqlite", plan);
  EXPECT_EQ(results.done(0), 0);
  EXPECT_FALSE(results.last_fit(0));
  results.add({made_answer(plan, 0, 0), made_answer(plan, 0, 1)});
  results.add({made_answer(plan, 0, 2), made_answer(plan, 1, 0)});
  EXPECT_EQ(results.done(0), 3);
  EXPECT_EQ(results.done(1), 1);
  const std::vector<FrameAnswer> all = all_of(folder / "a.sqlite");
  ASSERT_EQ(all.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    const FrameAnswer made = made_answer(plan, i / 3, i % 3), &read = all[static_cast<std::size_t>(i)];
    EXPECT_EQ(read.frame, made.frame);
    EXPECT_EQ(read.block, made.block);
    EXPECT_EQ(read.camera, made.camera);
    EXPECT_EQ(read.file, made.file);
    EXPECT_EQ(read.time_s, made.time_s);
    EXPECT_EQ(read.status, made.status);
    EXPECT_EQ(read.reason, made.reason);
    EXPECT_EQ(read.sha256, made.sha256);
    ASSERT_EQ(read.works.size(), made.works.size());
    for (std::size_t w = 0; w < read.works.size(); ++w) {
      EXPECT_EQ(read.works[w].verdict, made.works[w].verdict);
      EXPECT_EQ(read.works[w].free_values, made.works[w].free_values);
      EXPECT_EQ(read.works[w].physics, made.works[w].physics);
      EXPECT_EQ(read.works[w].seed, made.works[w].seed);
      ASSERT_EQ(read.works[w].quantities.size(), made.works[w].quantities.size());
      for (std::size_t q = 0; q < read.works[w].quantities.size(); ++q) {
        EXPECT_EQ(read.works[w].quantities[q].name, made.works[w].quantities[q].name);
        EXPECT_EQ(read.works[w].quantities[q].value, made.works[w].quantities[q].value);
        EXPECT_EQ(read.works[w].quantities[q].sigma, made.works[w].quantities[q].sigma);
        EXPECT_EQ(read.works[w].quantities[q].reason, made.works[w].quantities[q].reason);
      }
    }
  }
  const SqliteFile file(folder / "a.sqlite", SqliteFile::Opening::read);
  EXPECT_EQ(count_by_status(file), (std::vector<int>{3, 0, 1, 0, 0}));
  EXPECT_EQ(SurveyReader(file).blocks()[0].done, 3);
  EXPECT_EQ(SurveyReader(file).blocks()[1].done, 1);
}

TEST(SurveyResults, TellWhereTheNextFrameStarts) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_survey_plan(1, 4);
  ShardResults results(folder / "a.sqlite", plan);
  results.add({made_answer(plan, 0, 0)});
  FrameAnswer missing = made_answer(plan, 0, 1);
  missing.works.clear();
  FrameAnswer refused = made_answer(plan, 0, 3);
  refused.works.back().verdict = "refused";
  results.add({missing, made_answer(plan, 0, 2), refused});
  ASSERT_TRUE(results.last_fit(0));
  EXPECT_EQ(results.last_fit(0)->free_values, made_answer(plan, 0, 0).works.back().free_values);
}

TEST(SurveyResults, OfAnotherPlanOrVersionAreRefused) {
  const tests::TemporaryFolder folder;
  SurveyPlan plan = made_survey_plan(1, 2);
  { ShardResults results(folder / "a.sqlite", plan); }
  const std::string before = tests::bytes_of(folder / "a.sqlite");
  { ShardResults results(folder / "a.sqlite", plan); }
  plan.sha256 = std::string(64, 'f');
  const auto words_of = [&] {
    return tests::expect_error(sim::ErrorKind::existing_output,
                               [&] { ShardResults results(folder / "a.sqlite", plan); });
  };
  EXPECT_NE(words_of().find("another plan"), std::string::npos);
  plan = made_survey_plan(1, 2);
  {
    SqliteFile file(folder / "a.sqlite", SqliteFile::Opening::write);
    file.run("UPDATE origin SET ceres = '0.0.1'");
  }
  EXPECT_NE(words_of().find("Ceres 0.0.1"), std::string::npos);
  EXPECT_NE(tests::bytes_of(folder / "a.sqlite"), before);  // by the line above, and nothing else
}

TEST(SurveyResults, OfTwoWritersAreThoseOfTheFirst) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_survey_plan(1, 3);
  ShardResults first(folder / "a.sqlite", plan), second(folder / "a.sqlite", plan);
  first.add({made_answer(plan, 0, 0)});
  FrameAnswer late = made_answer(plan, 0, 0);
  late.decoding = "from elsewhere";
  second.add({late, made_answer(plan, 0, 1)});
  EXPECT_EQ(second.frames_of_others(), 1);
  first.add({made_answer(plan, 0, 1), made_answer(plan, 0, 2)});
  EXPECT_EQ(first.frames_of_others(), 1);
  const std::vector<FrameAnswer> all = all_of(folder / "a.sqlite");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].decoding, made_answer(plan, 0, 0).decoding);
}

TEST(SurveyResults, KeepTheLastWholeTransactionOnAFullDisk) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_survey_plan(1, 500);
  int kept = 0;
  {
    ShardResults results(folder / "a.sqlite", plan);
    const tests::FullDisk full(200000);
    const std::string words = tests::expect_error(sim::ErrorKind::unwritable_output, [&] {
      for (; kept < 500; kept += 2) results.add({made_answer(plan, 0, kept), made_answer(plan, 0, kept + 1)});
    });
    EXPECT_NE(words.find("cannot be written"), std::string::npos) << words;
  }
  EXPECT_GT(kept, 10);
  EXPECT_LT(kept, 500);
  ShardResults again(folder / "a.sqlite", plan);
  EXPECT_EQ(again.done(0), kept);  // both frames of a transaction or neither
  EXPECT_EQ(all_of(folder / "a.sqlite").size(), static_cast<std::size_t>(kept));
  again.add({made_answer(plan, 0, kept)});
}

TEST(SurveyResults, AreRefusedWhereTheyAreNone) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_survey_plan(1, 2);
  const auto refused = [&](const std::string& sql) {
    const std::string name = folder / "b.sqlite";
    std::filesystem::remove(name);
    {
      ShardResults results(name, plan);
      results.add({made_answer(plan, 0, 0)});
    }
    {
      SqliteFile file(name, SqliteFile::Opening::write);
      file.run(sql);
    }
    std::string words = tests::expect_error(sim::ErrorKind::unreadable_input, [&] {
      const SqliteFile file(name, SqliteFile::Opening::read);
      const SurveyReader reader(file);
      reader.blocks();
      reader.frames(0, 9, [](const FrameAnswer&) {});
    });
    EXPECT_NE(words.find("b.sqlite"), std::string::npos) << words;
    return words;
  };
  EXPECT_NE(refused("PRAGMA application_id = 5").find("no database"), std::string::npos);
  EXPECT_NE(refused("PRAGMA user_version = 1").find("another version"), std::string::npos);
  refused("CREATE TABLE more (a)");
  refused("DROP TABLE result");
  refused("CREATE VIEW v AS SELECT * FROM frame");
  refused("DELETE FROM plan");
  refused("UPDATE origin SET plan = 9");
  refused("UPDATE frame SET status = 'doen'");
  refused("UPDATE frame SET camera = x'00'");
  refused("UPDATE frame SET time_s = 1e300");
  refused("UPDATE result SET work = 'dance' WHERE work = 'fit'");
  refused("UPDATE result SET free_values = '[\"a\"]'");
  refused("UPDATE quantity SET value = 'a'");
  refused("UPDATE block SET frames = 2147483647, first_frame = 5");
  refused("UPDATE block SET origin = 0");
  tests::put(folder / "c.sqlite", "no database at all, whatever its name says, and rather long at that");
  EXPECT_NE(tests::expect_error(sim::ErrorKind::unreadable_input,
                                [&] {
                                  const SqliteFile file(folder / "c.sqlite", SqliteFile::Opening::read);
                                  const SurveyReader reader(file);
                                })
                .find("c.sqlite"),
            std::string::npos);
  tests::expect_error(sim::ErrorKind::unreadable_input,
                      [&] { const SqliteFile file(folder / "none.sqlite", SqliteFile::Opening::read); });
  EXPECT_FALSE(std::filesystem::exists(folder / "none.sqlite"));
}

}  // namespace
}  // namespace vegard::fit::survey_results_test
