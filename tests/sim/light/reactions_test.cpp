#include "sim/light/reactions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "tests/support/source_folder.h"

namespace vegard::sim::reactions_test {
namespace {

constexpr const char* kHead = "number,value,exponent,activation_K,of\n";

TEST(Reactions, FollowTheTemperatures) {
  const Reactions& reactions = Reactions::standard();
  const RatesAtPlace cold = reactions.at(300.0, 300.0), warm = reactions.at(600.0, 900.0);
  EXPECT_DOUBLE_EQ(cold(Reaction::n2p_e), 2.2e-7);
  EXPECT_NEAR(warm(Reaction::n2p_e), 2.2e-7 * std::pow(3.0, -0.39), 1e-12);
  EXPECT_NEAR(warm(Reaction::o1d_n2), 2.0e-11 * std::exp(107.8 / 600.0), 1e-16);
  EXPECT_DOUBLE_EQ(warm(Reaction::o1s_5577), 1.26);
}

// The rows below and above 1200 K come from one fit that is continuous there.
TEST(Reactions, OfHotElectronsGoOnFromThoseOfCold) {
  const Reactions& reactions = Reactions::standard();
  const RatesAtPlace below = reactions.at(500.0, 1199.99), above = reactions.at(500.0, 1200.0);
  EXPECT_NEAR(above.o2p_e() / below.o2p_e(), 1.0, 0.002);
  EXPECT_NEAR(above.nop_e() / below.nop_e(), 1.0, 0.002);
}

// A share and its kind: what leaves one ion is what comes to the others.
TEST(Reactions, SharesOfNitrogenIonsAddUp) {
  const Reactions& reactions = Reactions::standard();
  EXPECT_NEAR(reactions.value(Reaction::np_to_nop) + reactions.value(Reaction::np_to_o2p) +
                  reactions.value(Reaction::np_to_op),
              1.0, 1e-12);
}

TEST(Reactions, AUsersRowsReplaceTheStandardOnes) {
  const Reactions changed = Reactions::changed(std::string(kHead) + "43,0.19,0,0,0\n", "mine.csv");
  EXPECT_DOUBLE_EQ(changed.value(Reaction::o1s_of_n2a), 0.19);
  EXPECT_DOUBLE_EQ(changed.value(Reaction::o1s_of_o2p), Reactions::standard().value(Reaction::o1s_of_o2p));
}

// The set that the columns "with GLOW's reactions" of docs/validation.md are made with.
TEST(Reactions, OfTheComparisonReplaceTheStandardOnes) {
  const std::string file = tests::source_folder() + "/data/electrons/reactions_solomon.csv";
  const Reactions changed = Reactions::changed(input_bytes(file, "a table of reactions"), file);
  EXPECT_DOUBLE_EQ(changed.value(Reaction::o1s_of_n2a), 0.19);
  EXPECT_DOUBLE_EQ(changed.value(Reaction::o1s_5577), 1.06);
  EXPECT_NEAR(changed.at(300.0, 1200.0)(Reaction::o1d_e), 1.62e-9, 1e-15);
}

void expect_refused(const std::string& row, const std::string& words) {
  try {
    Reactions::changed(kHead + row + "\n", "mine.csv");
    ADD_FAILURE() << row;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("mine.csv"), std::string::npos);
  }
}

TEST(Reactions, RefuseWhatIsNone) {
  expect_refused("29,1,0,0,0", "no reaction");
  expect_refused("43.5,1,0,0,0", "no reaction");
  expect_refused("-1,1,0,0,0", "no reaction");
  expect_refused("1000000,1,0,0,0", "no reaction");
  expect_refused("43,-0.1,0,0,0", "negative");
  expect_refused("74,0,0,0,0", "is 0");
  expect_refused("31,0,-0.7,0,2", "is 0");
  expect_refused("80,1.5,0,0,0", "share");
  expect_refused("82,0.6,0,0,0", "add up to 1");
  expect_refused("1e300,1,0,0,0", "no reaction");
  expect_refused("43,0.1,0,0,1", "`of`");
}

}  // namespace
}  // namespace vegard::sim::reactions_test
