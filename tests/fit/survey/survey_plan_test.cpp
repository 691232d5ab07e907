// Plans: blocks, shards, and their file.
#include "fit/survey/survey_plan.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "fit/survey/survey.h"
#include "sim/base/number/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::survey_plan_test {
namespace {

using tests::put;

constexpr const char* kSurvey = R"([survey]
name = "night"
work = ["border", "fit"]
scene = "scene.toml"
block_frames = 4
gap_s = 10
shard_minutes = 0.5
[survey.cost_s]
border = 1
fit = 9
[[camera]]
name = "a"
frames = ["a.txt"]
[[camera.calibration]]
from = "2019-03-01T22:00:00Z"
until = "2019-03-01T22:00:20Z"
file = "a1.toml"
[[camera.calibration]]
from = "2019-03-01T22:00:20Z"
file = "a2.toml"
[[camera]]
name = "b"
frames = ["b.txt"]
[[skip]]
camera = "b"
until = "2019-03-01T22:00:02Z"
reason = "a lamp"
)";

/// Every two seconds, from 4 s before ten o'clock on.
SurveyPlan made_plan(const tests::TemporaryFolder& folder) {
  std::string a, b;
  for (int i = -2; i < 13; ++i)
    a += fmt::format("a{}.png 2019-03-01T{}:{:02}Z\n", i + 2, i < 0 ? "21:59" : "22:00", (120 + 2 * i) % 60);
  for (const int second : {0, 2, 4, 40})
    b += fmt::format("b{}.png 2019-03-01T22:00:{:02}Z\n", second, second);
  put(folder / "a.txt", a);
  put(folder / "b.txt", b);
  return plan_survey(parse_survey(kSurvey, folder / "survey.toml"),
                     {{"the setup of a, calibration 1", "00"}});
}

TEST(SurveyPlan, CutsBlocksAtCalibrationsGapsAndLengths) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_plan(folder);
  std::vector<int> cameras, calibrations, counts, firsts;
  for (const PlannedBlock& block : plan.blocks) {
    cameras.push_back(block.camera);
    calibrations.push_back(block.calibration);
    counts.push_back(static_cast<int>(block.frames.size()));
    firsts.push_back(block.first_frame);
  }
  // Two frames before any calibration; ten of the first, three of the second; then the other camera's, with a
  // gap.
  EXPECT_EQ(cameras, (std::vector<int>{0, 0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(calibrations, (std::vector<int>{-1, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(counts, (std::vector<int>{2, 4, 4, 2, 3, 3, 1}));
  EXPECT_EQ(firsts, (std::vector<int>{0, 2, 6, 10, 12, 15, 18}));
  EXPECT_EQ(plan.frames(), 19);
  EXPECT_TRUE(tests::has_facts(plan.blocks[0].frames[1].skip, "no calibration"));
  EXPECT_EQ(plan.blocks[5].frames[0].skip, "a lamp");
  EXPECT_EQ(plan.blocks[5].seconds, 20.0);
  EXPECT_EQ(plan.seconds(), 16 * 10.0);
  EXPECT_EQ(plan.shards, 2);  // 160 s in parts of at least 30 s and a block of 40 s
  EXPECT_EQ(plan.sha256_of("the setup of a, calibration 1"), "00");
  EXPECT_EQ(plan.sha256_of("a.txt").size(), 64u);
}

TEST(SurveyPlan, ComesBackFromItsFile) {
  const tests::TemporaryFolder folder;
  SurveyPlan plan = made_plan(folder);
  plan.folder = "..";
  plan.blocks[0].frames[0].file = "caf\xc3\xa9 \"x\".png#3";
  plan.blocks[0].frames[0].time_s = 1551477600.1234567;
  const std::string json = plan_json(plan);
  put(folder / "plan.json", json);
  const SurveyPlan read = read_plan(folder / "plan.json");
  EXPECT_EQ(plan_json(read), json);
  EXPECT_EQ(read.blocks[0].frames[0].time_s, plan.blocks[0].frames[0].time_s);
  EXPECT_EQ(read.blocks[6].first_frame, 18);
  EXPECT_EQ(read.place("b"),
            (std::filesystem::path(folder / "plan.json").parent_path().parent_path() / "b").string());
  EXPECT_EQ(read.sha256.size(), 64u);
}

TEST(SurveyPlan, IsRefusedWhereItIsNone) {
  const tests::TemporaryFolder folder;
  const std::string json = plan_json(made_plan(folder));
  const auto refused = [](std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const std::string words =
        tests::expect_error(sim::ErrorKind::unreadable_input, [&] { plan_of_json(text, "plan.json"); });
    EXPECT_NE(words.find("plan.json"), std::string::npos) << words;
  };
  refused(json, "vegard survey plan", "vegard border");
  refused(json, "\"format\": 1", "\"format\": 2");
  refused(json, "\"camera\":1", "\"camera\":2");
  refused(json, "\"camera\":1", "\"camera\":1e300");
  refused(json, "\"camera\":1", "\"camera\":-1");
  refused(json, "\"calibration\":1", "\"calibration\":2");
  refused(json, "\"calibration\":0", "\"calibration\":-2");
  refused(json, ",\"the camera has no calibration for this time\"", "");
  refused(json, "\"channel\":1", "\"channel\":3");
  refused(json, "\"border\"", "\"boarder\"");
  refused(json, "\"shards\": 2", "\"shards\": 0");
  refused(json, "\"frames\":[[", "\"frames\":[],\"no\":[[");
  refused(json, "\"a0.png\",1551477596.0", "\"a0.png\",null");
  refused(json, "]\n}\n", "");
}

/// Blocks of 1 to 40 s, some of nothing; seed 5. Whatever the number of shards, each block is in one of them,
/// in its order.
TEST(SurveyPlan, SharesAllBlocksAmongShards) {
  SurveyPlan plan;
  for (std::uint32_t i = 0; i < 300; ++i) {
    plan.blocks.emplace_back();
    const double u = sim::uniform(sim::random_words(5, sim::Stream::stars, i, 0, 0)[0]);
    plan.blocks.back().seconds = i % 7 == 0 ? 0.0 : 1.0 + 39.0 * u;
  }
  for (const int shards : {1, 2, 7, 50, 300, 1000}) {
    int next = 0;
    for (int shard = 1; shard <= shards; ++shard) {
      const BlockRange range = blocks_of_shard(plan, shard, shards);
      if (range.begin == range.end) continue;
      EXPECT_EQ(range.begin, next);
      EXPECT_LT(range.begin, range.end);
      next = range.end;
    }
    EXPECT_EQ(next, 300) << shards;
  }
  // Shards as they are planned are at least as long as was asked for.
  for (const double min_s : {100.0, 555.0, 2000.0}) {
    const int shards = shard_count(plan.blocks, min_s, 1000);
    for (int shard = 1; shard <= shards; ++shard) {
      const BlockRange range = blocks_of_shard(plan, shard, shards);
      double seconds = 0.0;
      for (int b = range.begin; b < range.end; ++b)
        seconds += plan.blocks[static_cast<std::size_t>(b)].seconds;
      EXPECT_GE(seconds, min_s) << shard << " of " << shards;
    }
    EXPECT_GT(shards, 1);
  }
  EXPECT_EQ(shard_count(plan.blocks, 0.0, 12), 12);
  EXPECT_EQ(shard_count(plan.blocks, 1e9, 12), 1);
}

}  // namespace
}  // namespace vegard::fit::survey_plan_test
