// The words of --decoding and fit.decoding, what is wrong with others, and curves from files.
#include "fit/photo/decoding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "fit/photo/photo.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/decoding_word.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::decoding_test {
namespace {

TEST(DecodingWord, AllWordsAreKnown) {
  for (const char* word : {"auto", "srgb", "linear", "sensor", "unknown", "unknown:2", "gamma:2.2",
                           "srgb:1.3", "srgb:1.3:0.8", "curve:a.csv"})
    EXPECT_FALSE(sim::decoding_complaint(word)) << word;
  EXPECT_EQ(decoding_of_word("auto"), Decoding::automatic);
  EXPECT_EQ(decoding_of_word("sensor"), Decoding::sensor);
  EXPECT_EQ(decoding_of_word("unknown"), Decoding::unknown);
  EXPECT_EQ(decoding_of_word("unknown:2").unknowns, 2);
  EXPECT_NEAR(decoding_of_word("gamma:2.2").curve->decode(0.5), std::pow(0.5, 2.2), 1e-12);
  EXPECT_EQ(decoding_of_word("gamma:2.2").words, "gamma 2.2");
  const sim::BentSrgb bent{1.3, 0.8};
  EXPECT_EQ(decoding_of_word("srgb:1.3:0.8").curve->decode(0.4), bent.decode(0.4));
}

struct Wrong {
  std::string word, problem;
};
class WrongWord : public testing::TestWithParam<Wrong> {};

TEST_P(WrongWord, IsToldApart) {
  const auto complaint = sim::decoding_complaint(GetParam().word);
  ASSERT_TRUE(complaint);
  EXPECT_NE(complaint->problem.find(GetParam().problem), std::string::npos) << complaint->problem;
  EXPECT_FALSE(complaint->expected.empty());
  EXPECT_THROW(decoding_of_word(GetParam().word), sim::Error);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongWord,
    testing::Values(Wrong{"gamma", "does not say which gamma"}, Wrong{"gamma:0", "no increasing"},
                    Wrong{"gamma:-2", "no increasing"}, Wrong{"gamma:nan", "is no number"},
                    Wrong{"gamma:two", "is no number"}, Wrong{"gamma:50", "outside the limits"},
                    Wrong{"gamma:2.2:1", "does not say which"}, Wrong{"srgb:0", "no increasing"},
                    Wrong{"srgb:1:-1", "no increasing"}, Wrong{"srgb:", "is no number"},
                    Wrong{"curve:", "names no table"}, Wrong{"curve:a.txt", "names no table"},
                    Wrong{"unknown:3", "is no decoding"}, Wrong{"srbg", "is no decoding"},
                    Wrong{"", "is no decoding"}));

void write(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

class CurveFile : public testing::Test {
 protected:
  const tests::TemporaryFolder folder_;
  const std::string file_ = folder_ / "curve.csv";

  void refused(const std::string& text, const std::string& problem) {
    write(file_, text);
    try {
      decoding_of_word("curve:" + file_);
      FAIL() << "taken: " << text;
    } catch (const sim::Error& error) {
      EXPECT_EQ(error.kind(), sim::ErrorKind::unreadable_input);
      EXPECT_EQ(error.details().file, file_);
      EXPECT_NE(error.details().problem.find(problem), std::string::npos) << error.details().problem;
    }
  }
};

TEST_F(CurveFile, IsRead) {
  write(file_, "linear,encoded\n0,0\n0.25,0.5\n1,1\n");
  const Decoding decoding = decoding_of_word("curve:" + file_);
  EXPECT_NEAR(decoding.curve->decode(0.25), 0.125, 1e-12);
  EXPECT_EQ(decoding.words.find("curve curve.csv, SHA-256 "), 0u);
  write(file_, "linear,encoded\n0,0\n0.2,0.5\n1,1\n");
  EXPECT_NE(decoding_of_word("curve:" + file_).words, decoding.words);
  EXPECT_THROW(decoding_of_word("curve:" + (folder_ / "none.csv")), sim::Error);
}

TEST_F(CurveFile, IsRefused) {
  refused("linear,encoded\n0,0\n0.5,0.7\n0.6,0.7\n1,1\n", "increas");
  refused("linear,encoded\n0,0\n0.5,0.7\n0.4,0.8\n1,1\n", "increas");
  refused("linear,encoded\n0,0\n", "one row is no curve");
  refused("linear,encoded\n0,0\n1,1.5\n", "1.5");
  refused("linear,encoded\n-0.5,0\n1,1\n", "-0.5");
  refused("linear,encoded\n0,0\n0.9,1\n", "from black to white");
  refused("linear,coded\n0,0\n1,1\n", "encoded");
  refused("", "");
}

// Beside the scene's file, and read with it.
TEST_F(CurveFile, OfASceneStandsBesideIt) {
  write(file_, "linear,encoded\n0,0\n0.25,0.5\n1,1\n");
  const std::string scene_file = folder_ / "scene.toml";
  write(scene_file, "[[sheet]]\nname = \"main\"\n[fit]\ndecoding = \"curve:curve.csv\"\n");
  const sim::Scene scene = sim::read_scene(scene_file);
  EXPECT_EQ(scene.fit.decoding, "curve:curve.csv");
  EXPECT_NEAR(decoding_of_word(scene.fit.decoding, &scene).curve->decode(0.5), 0.25, 1e-12);
  write(scene_file, "[[sheet]]\nname = \"main\"\n[fit]\ndecoding = \"curve:other.csv\"\n");
  EXPECT_THROW(sim::read_scene(scene_file), sim::Error);
}

}  // namespace
}  // namespace vegard::fit::decoding_test
