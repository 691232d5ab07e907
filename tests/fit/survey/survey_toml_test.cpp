// Surveys' files: what is read, what is refused and in which words.
#include "fit/survey/survey.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.h"
#include "sim/base/utc_time.h"

namespace vegard::fit::survey_toml_test {
namespace {

constexpr const char* kWhole = R"([survey]
name = "winter"
work = ["fit", "filter", "border"]
scene = "scene.toml"
block_frames = 20
gap_s = 60
shard_minutes = 45.5
max_shards = 7
[survey.cost_s]
border = 0.25
[[camera]]
name = "gill"
frames = ["gill", "more.txt"]
endings = [".PNG"]
set = ["fit.bands=5"]
decoding = "linear"
channel = "red"
[[camera.calibration]]
until = "2019-03-01"
file = "gill_1.toml"
[[camera.calibration]]
from = "2019-03-01T00:00:00Z"
file = "gill_2.toml"
mask = "gill.png"
[[camera]]
name = "kho"
frames = ["kho"]
[[skip]]
camera = "kho"
from = "2019-02-01T10:00:00+01:00"
until = "2019-02-02"
reason = "fog"
[[skip]]
list = "bad.txt"
reason = "a lamp"
)";

TEST(SurveyToml, ReadsAllKeys) {
  const Survey survey = parse_survey(kWhole, "nights/winter.toml");
  EXPECT_EQ(survey.name, "winter");
  EXPECT_EQ(survey.work, (std::vector<SurveyWork>{SurveyWork::filter, SurveyWork::border, SurveyWork::fit}));
  EXPECT_EQ(survey.block_frames, 20);
  EXPECT_EQ(survey.gap_s, 60.0);
  EXPECT_EQ(survey.shard_minutes, 45.5);
  EXPECT_EQ(survey.max_shards, 7);
  EXPECT_EQ(survey.cost_s,
            (std::array{kSurveyCost_s[0], 0.25, kSurveyCost_s[2], kSurveyCost_s[3], kSurveyCost_s[4]}));
  EXPECT_EQ(survey.place("gill"), "nights/gill");
  EXPECT_EQ(survey.sha256.size(), 64u);
  ASSERT_EQ(survey.cameras.size(), 2u);
  const SurveyCamera& gill = survey.cameras[0];
  EXPECT_EQ(gill.scene, "scene.toml");
  EXPECT_EQ(gill.frames, (std::vector<std::string>{"gill", "more.txt"}));
  EXPECT_EQ(gill.endings, std::vector<std::string>{".png"});
  EXPECT_EQ(gill.changes, std::vector<std::string>{"fit.bands=5"});
  EXPECT_EQ(gill.decoding, "linear");
  EXPECT_EQ(gill.channel, 0);
  EXPECT_EQ(gill.filter, "");
  ASSERT_EQ(gill.calibrations.size(), 2u);
  const double march = *sim::utc_seconds("2019-03-01T00:00:00Z");
  EXPECT_TRUE(gill.calibrations[0].period.has(march - 1.0));
  EXPECT_FALSE(gill.calibrations[0].period.has(march));
  EXPECT_TRUE(gill.calibrations[1].period.has(march));
  EXPECT_EQ(gill.calibrations[1].mask, "gill.png");
  const SurveyCamera& kho = survey.cameras[1];
  EXPECT_EQ(kho.endings, picture_endings());
  EXPECT_EQ(kho.channel, 1);
  ASSERT_EQ(kho.calibrations.size(), 1u);  // the scene has the camera, at all times
  EXPECT_EQ(kho.calibrations[0].file, "");
  ASSERT_EQ(survey.skips.size(), 2u);
  EXPECT_EQ(survey.skips[0].period.from_s, *sim::utc_seconds("2019-02-01T09:00:00Z"));
  EXPECT_EQ(survey.skips[1].list, "bad.txt");
}

struct BadSurvey {
  const char* old_text;
  const char* new_text;
  int line;
  const char* key;
  const char* words;  ///< of problem, expected and hint together
};
void PrintTo(const BadSurvey& bad, std::ostream* stream) { *stream << bad.new_text; }

class RefusedSurvey : public ::testing::TestWithParam<BadSurvey> {};

TEST_P(RefusedSurvey, NamesTheLineAndWhatWouldBeRight) {
  const BadSurvey& bad = GetParam();
  std::string text = kWhole;
  const std::size_t at = text.find(bad.old_text);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(bad.old_text).size(), bad.new_text);
  try {
    parse_survey(text, "winter.toml");
    FAIL() << "was read";
  } catch (const sim::Error& error) {
    const sim::ErrorDetails& d = error.details();
    const std::string words = d.problem + " | " + d.expected + " | " + d.hint;
    EXPECT_EQ(static_cast<int>(error.kind()), static_cast<int>(sim::ErrorKind::scene));
    EXPECT_EQ(d.file, "winter.toml");
    EXPECT_EQ(d.line, bad.line) << words;
    EXPECT_EQ(d.key, bad.key) << words;
    EXPECT_NE(words.find(bad.words), std::string::npos) << words;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Survey, RefusedSurvey,
    ::testing::Values(
        BadSurvey{"block_frames", "block_frame", 5, "survey.block_frame", "did you mean 'block_frames'"},
        BadSurvey{"\"winter\"", "\"win ter\"", 2, "survey.name", "letters, digits"},
        BadSurvey{"name = \"winter\"\n", "", 1, "survey.name", "is missing"},
        BadSurvey{"\"border\"]", "\"dance\"]", 3, "survey.work", "'dance' is no work"},
        BadSurvey{"\"border\"]", "\"fit\"]", 3, "survey.work", "twice"},
        BadSurvey{"work = [\"fit\", \"filter\", \"border\"]", "", 1, "survey.work", "what to do"},
        BadSurvey{"= 20", "= 20.5", 5, "survey.block_frames", "whole number"},
        BadSurvey{"= 20", "= 0", 5, "survey.block_frames", "from 1 to"},
        BadSurvey{"= 60", "= nan", 6, "survey.gap_s", "from 0 to"},
        BadSurvey{"border = 0.25", "boarder = 0.25", 10, "survey.cost_s.boarder", "did you mean 'border'"},
        BadSurvey{"frames = [\"gill\", \"more.txt\"]", "frames = \"gill\"", 13, "camera.frames", "an array"},
        BadSurvey{"frames = [\"gill\", \"more.txt\"]", "frames = []", 13, "camera.frames", "has no frames"},
        BadSurvey{"\"linear\"", "\"lineal\"", 16, "camera.decoding", "lineal"},
        BadSurvey{"\"red\"", "\"infrared\"", 17, "camera.channel", "red, green or blue"},
        BadSurvey{"until = \"2019-03-01\"", "until = \"2019-03-02\"", 18, "camera.calibration",
                  "the same time"},
        BadSurvey{"\"2019-03-01\"", "\"2019-02-29\"", 19, "camera.calibration.until", "is no time"},
        BadSurvey{"file = \"gill_1.toml\"\n", "", 18, "camera.calibration.file", "says nothing"},
        BadSurvey{"\"kho\"\nframes", "\"gill\"\nframes", 26, "camera.name", "two cameras"},
        BadSurvey{"camera = \"kho\"", "camera = \"khoo\"", 29, "skip.camera", "did you mean 'kho'"},
        BadSurvey{"until = \"2019-02-02\"", "until = \"2019-02-01\"", 31, "skip.until", "ends before"},
        BadSurvey{"reason = \"fog\"\n", "", 28, "skip.reason", "why"},
        BadSurvey{"list = \"bad.txt\"\n", "", 34, "skip.reason", "skips everything"},
        BadSurvey{"name = \"kho\"", "name = kho", 26, "", "TOML"}));

TEST(SurveyToml, AsksForACameraWithItsCalibration) {
  const char* text =
      "[survey]\nname = \"a\"\nwork = [\"border\"]\n[[camera]]\nname = \"b\"\nframes = [\"c\"]\n";
  try {
    parse_survey(text, "a.toml");
    FAIL() << "was read";
  } catch (const sim::Error& error) {
    EXPECT_EQ(error.details().line, 4);
    EXPECT_NE(error.details().problem.find("no calibration"), std::string::npos);
  }
}

TEST(SurveyToml, MayNameTheTreesOfAFilter) {
  const Survey survey = parse_survey(
      "[survey]\nname = \"a\"\nwork = [\"filter\"]\nscene = \"a.toml\"\n[[camera]]\nname = \"b\"\nframes = "
      "[\"c\"]\nfilter = \"trees.json\"\n",
      "a.toml");
  EXPECT_EQ(survey.cameras[0].filter, "trees.json");
}

TEST(SurveyToml, IsRefusedWithoutItsHead) {
  try {
    parse_survey("[sruvey]\nname = \"a\"\n", "a.toml");
    FAIL() << "was read";
  } catch (const sim::Error& error) {
    EXPECT_EQ(error.details().key, "survey");
    EXPECT_NE(error.details().problem.find("[survey]"), std::string::npos);
  }
}

TEST(FrameReference, HasANumberAfterTheLastHash) {
  EXPECT_EQ(frame_reference("a/b.pgm.gz#7").file, "a/b.pgm.gz");
  EXPECT_EQ(frame_reference("a/b.pgm.gz#7").number, 7);
  for (const char* name : {"a/b.png", "#7", "a#b.png", "a#", "a#-1", "a#1234567"}) {
    EXPECT_EQ(frame_reference(name).file, name);
    EXPECT_FALSE(frame_reference(name).number) << name;
  }
}

}  // namespace
}  // namespace vegard::fit::survey_toml_test
