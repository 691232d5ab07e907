#include "sim/base/file/csv_table.h"

#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::csv_table_test {
namespace {

/// The message that a text is refused with; empty if it is not.
std::string refusal(const std::string& text) {
  try {
    read_csv_table(text, "curve.csv");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    return error.what();
  }
  return {};
}

TEST(CsvTable, KeepsNumbersByColumnAndWhereTheyStood) {
  const CsvTable table =
      read_csv_table("# drawn by hand\r\naltitude_km, 557.7\r\n\r\n100,1e3\r\n+110.5 , -2\r\n", "a.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"altitude_km", "557.7"}));
  EXPECT_EQ(table.column("altitude_km"), (std::vector<double>{100.0, 110.5}));
  EXPECT_EQ(table.column("557.7"), (std::vector<double>{1e3, -2.0}));
  EXPECT_EQ(table.lines, (std::vector<int>{4, 5}));
}

TEST(CsvTable, TakesAByteOrderMarkForNoPartOfAName) {
  EXPECT_TRUE(read_csv_table("\xEF\xBB\xBFx,y\n1,2", "a.csv").has("x"));
}

TEST(CsvTable, NamesFileAndLineOfWhatItRefuses) {
  EXPECT_TRUE(tests::has_facts(refusal("x,y\n1,2\n3,four\n"), "curve.csv:3: | 'four' | 'y'"));
  EXPECT_NE(refusal("x,y\n1\n").find("curve.csv:2: 1 cell for 2 columns"), std::string::npos);
  EXPECT_NE(refusal("x,x\n1,2\n").find("curve.csv:1: two columns"), std::string::npos);
  EXPECT_NE(refusal("1,2\n3,4\n").find("begins with"), std::string::npos);
  EXPECT_NE(refusal("x,\n3,4\n").find("without a name"), std::string::npos);
  for (const char* number : {"nan", "inf", "", "1e999", "0x10", "1 2"})
    EXPECT_NE(refusal(std::string("x,y\n1,") + number + "\n").find("is no number"), std::string::npos)
        << number;
}

TEST(CsvTable, RefusesAFileWithoutNumbers) {
  EXPECT_NE(refusal("").find("is empty"), std::string::npos);
  EXPECT_NE(refusal("x,y\n# nothing\n").find("has no rows"), std::string::npos);
}

TEST(CsvTable, SaysWhichRowIsOutOfOrderOrLimits) {
  const CsvTable table = read_csv_table("x,y\n1,2\n2,-1\n2,0\n", "a.csv");
  const auto message = [](auto&& call) {
    try {
      call();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message([&] { table.require_increasing("x"); }).find("a.csv:4"), std::string::npos);
  EXPECT_NE(message([&] { table.require_within("y", 0.0, 5.0); }).find("a.csv:3: -1 in column 'y'"),
            std::string::npos);
  EXPECT_NE(message([&] { table.column("z"); }).find("x, y"), std::string::npos);
  EXPECT_EQ(message([&] { table.require_within("y", -1.0, 2.0); }), "");
}

TEST(CsvTable, SemicolonsTabsAndCapitalsAreReadAsWell) {
  for (const char* text :
       {"altitude_km;rate\n100,5;1e3\n110;-2\n", "altitude_km\trate\n100.5\t1e3\n110\t-2\n",
        "Altitude_KM,Rate\n100.5,1e3\n110,-2\n"}) {
    const CsvTable table = read_csv_table(text, "a.csv");
    EXPECT_TRUE(table.has("altitude_km"));
    EXPECT_EQ(table.column("altitude_km"), (std::vector<double>{100.5, 110.0})) << text;
    EXPECT_EQ(table.column("rate"), (std::vector<double>{1e3, -2.0})) << text;
  }
  // Two columns that differ by capitals alone are two.
  const CsvTable gases = read_csv_table("NO,No\n1,2\n", "a.csv");
  EXPECT_EQ(gases.column("No"), (std::vector<double>{2.0}));
  EXPECT_FALSE(gases.has("no"));
}

TEST(CsvCell, NoFormulaForASpreadsheet) {
  EXPECT_EQ(csv_cell("=1+1"), "\"'=1+1\"");
  EXPECT_EQ(csv_cell("@SUM(A1)"), "\"'@SUM(A1)\"");
  EXPECT_EQ(csv_cell("-2+3"), "\"'-2+3\"");
  EXPECT_EQ(csv_cell("sky_-2.png"), "sky_-2.png");
  EXPECT_EQ(csv_number(-2.0), "-2");
}

}  // namespace
}  // namespace vegard::sim::csv_table_test
