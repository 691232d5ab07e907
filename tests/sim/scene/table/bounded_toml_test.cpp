#include "sim/scene/table/bounded_toml.h"

#include <gtest/gtest.h>

#include <string>

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::bounded_toml_test {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

/// "2: a key has …"; empty if there is none.
std::string excess_of(const std::string& text) {
  const auto excess = toml_excess(text);
  return excess ? std::to_string(excess->line) + ": " + excess->problem : "";
}

const std::string kParts = "a key has more than 32 parts",
                  kDeep = "arrays and tables are nested more than 32 deep",
                  kLong = "a key is longer than 256 bytes";

TEST(BoundedToml, CountsThePartsOfKeys) {
  EXPECT_EQ(excess_of("seed = 1\na" + repeated(".a", 31) + " = 1\n"), "");
  EXPECT_EQ(excess_of("seed = 1\na" + repeated(".a", 32) + " = 1\n"), "2: " + kParts);
  EXPECT_EQ(excess_of("[a" + repeated(" . a", 32) + "]\n"), "1: " + kParts);
  EXPECT_EQ(excess_of("[[a" + repeated(".\"a\"", 32) + "]]\n"), "1: " + kParts);
  EXPECT_EQ(excess_of("x = {a" + repeated(".a", 32) + " = 1}\n"), "1: " + kParts);
  EXPECT_EQ(excess_of("\"" + repeated("a.", 60) + "\" = 1\n"), "");  // one part
}

TEST(BoundedToml, CountsDepth) {
  EXPECT_EQ(excess_of("x = " + repeated("[", 32) + repeated("]", 32) + "\n"), "");
  EXPECT_EQ(excess_of("\n\nx = " + repeated("[", 33)), "3: " + kDeep);
  EXPECT_EQ(excess_of("x = " + repeated("[\n", 33)), "33: " + kDeep);
  EXPECT_EQ(excess_of("x = " + repeated("{a = ", 33)), "1: " + kDeep);
  EXPECT_EQ(excess_of("x = " + repeated("[{a = ", 17)), "1: " + kDeep);
  // Beside each other they are no deeper; nor are the tables of a file.
  EXPECT_EQ(excess_of("x = [" + repeated("[1.5, 2.5],\n", 100) + "]\n" + repeated("[[sheet]]\na = 1\n", 100)),
            "");
}

TEST(BoundedToml, MeasuresKeys) {
  const std::string longest(256, 'k');
  EXPECT_EQ(excess_of(longest + " = 1\n[" + longest + "]\n x = { " + longest + " = 1 }\n"), "");
  EXPECT_EQ(excess_of(longest + "k = 1\n"), "1: " + kLong);
  EXPECT_EQ(excess_of("seed = 1\n[" + longest + "k]\n"), "2: " + kLong);
  EXPECT_EQ(excess_of("x = { a = 1, " + longest + "k = 1 }\n"), "1: " + kLong);
  EXPECT_EQ(excess_of("\n" + longest + "k"), "2: " + kLong);  // and no value
}

TEST(BoundedToml, KnowsTextsAndComments) {
  const std::string wild = repeated("[{a.", 300);
  EXPECT_EQ(excess_of("# " + wild + "\n  # " + wild + "\nx = 1 # " + wild + "\n"), "");
  EXPECT_EQ(excess_of("x = \"" + wild + "\"\ny = '" + wild + "'\n"), "");
  EXPECT_EQ(
      excess_of("x = \"\"\"" + wild + "\n\"" + wild + "\"\"\"\ny = '''" + wild + "'\n" + wild + "'''\n"), "");
  EXPECT_EQ(excess_of("x = \"\\\"" + wild + "\"\ny = '\\'\nz = \"\"\n"), "");
  EXPECT_EQ(excess_of("x = '''\n\n'''\ny = \"\"\"\n\"\"\"\nz = " + wild), "6: " + kDeep);
  EXPECT_EQ(excess_of("x = \"not closed\ny = " + wild), "2: " + kDeep);
}

TEST(BoundedToml, MeasuresTheWhole) {
  EXPECT_EQ(excess_of(std::string(kMaxTomlBytes, '\n')), "");
  EXPECT_TRUE(tests::has_facts(excess_of(std::string(kMaxTomlBytes + 1, '\n')), "16 MB"));
}

TEST(BoundedToml, WhatIsNoTomlIsSaidWhereItBegins) {
  const std::string longest(300, 'k');
  std::string said =
      tests::expect_error(ErrorKind::scene, [&] { parse_scene("\x89PNG\n\n" + longest, "a.png"); });
  EXPECT_EQ(said.rfind("a.png:1: ", 0), 0U) << said;
  EXPECT_EQ(said.find(kLong), std::string::npos) << said;
  // What is not finished before it is no mistake there.
  said = tests::expect_error(ErrorKind::scene,
                             [&] { parse_scene("seed = 1\nx = [\n1,\n" + repeated("[", 40), "a"); });
  EXPECT_NE(said.find("a:4: " + kDeep), std::string::npos) << said;
}

// Without the limit the parser calls itself for every part, and the process is killed.
TEST(BoundedToml, ScenesAndChangesAreRefusedAndNotFatal) {
  const std::string parts = "a" + repeated(".a", 50000), deep = repeated("[", 50000);
  for (const std::string& text : {parts + " = 1\n", "x = " + deep, "x = { " + parts + " = 1 }"}) {
    const std::string said =
        tests::expect_error(ErrorKind::scene, [&] { parse_scene("seed = 1\n" + text, "mine.toml"); });
    EXPECT_EQ(said.rfind("mine.toml:2: a", 0), 0U) << said;
    EXPECT_LT(said.size(), 200U);
  }
  Scene scene;
  for (const std::string& text : {deep, "[{" + parts + " = 1}]"})
    for (const char* path : {"camera.width", "fit.free", "fit.tied"}) {
      const std::string said =
          tests::expect_error(ErrorKind::scene, [&] { set_from_text(scene, path, text); });
      EXPECT_LT(said.size(), 300U);
    }
}

}  // namespace
}  // namespace vegard::sim::bounded_toml_test
