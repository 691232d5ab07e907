// profiles.csv, profile.csv and trace.csv.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "fit/report/table/run_tables.h"
#include "sim/base/file/csv_table.h"
#include "tests/support/small_fit.h"

namespace vegard::fit::run_tables_test {
namespace {

std::vector<std::string> lines_without_comments(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.empty() || line[0] != '#') lines.push_back(line);
  return lines;
}

/// The cells of a line without quotes.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> list(1);
  for (const char c : line) {
    if (c == ',')
      list.emplace_back();
    else
      list.back() += c;
  }
  return list;
}

TEST(CsvText, QuotesWhatWouldBreakALine) {
  EXPECT_EQ(sim::csv_cell("plain"), "plain");
  EXPECT_EQ(sim::csv_cell("a,\"b\"\nc"), "\"a,\"\"b\"\"\nc\"");
  EXPECT_EQ(sim::csv_comment("a\nb"), "# a b\n");
  EXPECT_EQ(sim::csv_number(std::nan("")), "");
  EXPECT_EQ(std::stod(sim::csv_number(1.0 / 3.0)), 1.0 / 3.0);
}

TEST(FreeProfilesCsv, EveryColumnIsOfItsLineWhateverIsFreeInASheet) {
  FitResult result;
  result.profiles = {{"low", 557.7, {100.0, 101.0}, {1.0, 2.0}, {0.5, 1.5}, {2.0, 3.0}},
                     {"low", 427.8, {101.0, 102.0}, {4.0, 5.0}, {3.0, 4.0}, {6.0, 7.0}},
                     {"high", 630.0, {200.0}, {8.0}, {7.0}, {9.0}},
                     {"high", 427.8, {200.0}, {0.25}, {0.125}, {0.5}}};
  const auto lines = lines_without_comments(free_profiles_csv(result));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0],
            "sheet,altitude_km,rate_5577,lower_5577,upper_5577,rate_4278,lower_4278,upper_4278,rate_6300,"
            "lower_6300,upper_6300");
  EXPECT_EQ(lines[1], "low,100,1,0.5,2,,,,,,");
  EXPECT_EQ(lines[2], "low,101,2,1.5,3,4,3,6,,,");
  EXPECT_EQ(lines[3], "low,102,,,,5,4,7,,,");
  EXPECT_EQ(lines[4], "high,200,,,,0.25,0.125,0.5,8,7,9");
}

TEST(ProfilesCsv, HoldsEveryValueOfTheProfile) {
  const Photo photo = tests::small_photo();
  const FitResult result = tests::small_fit(photo);
  const auto lines = lines_without_comments(
      profiles_csv(result, result.photos[0], [](double, double y_px) { return 100.0 - y_px; }));
  ASSERT_EQ(lines.size(), 1 + result.photos[0].data.mean.size());
  EXPECT_EQ(lines[0], "band,row_px,elevation_deg,channel,data,sigma,model,residual_over_sigma,count");
  // The first value has sigma 0: not used, no residual.
  EXPECT_EQ(cells(lines[1])[7], "");
  const std::size_t i = result.photos[0].data.index(1, 7, 2);
  const auto row = cells(lines[1 + i]);
  EXPECT_EQ(row[0], "1");
  EXPECT_EQ(row[1], "7");
  EXPECT_EQ(row[2], "92.5");
  EXPECT_EQ(row[3], "b");
  EXPECT_EQ(std::stod(row[4]), result.photos[0].data.mean[i]);
  EXPECT_EQ(std::stod(row[6]), result.photos[0].model[i]);
  EXPECT_DOUBLE_EQ(std::stod(row[7]), (result.photos[0].data.mean[i] - result.photos[0].model[i]) / 0.01);
  EXPECT_EQ(row[8], std::to_string(result.photos[0].data.count[i]));
}

TEST(ProfilesCsv, StandsWithoutAModel) {
  const Photo photo = tests::small_photo();
  FitResult result = tests::small_fit(photo);
  result.photos[0].model.clear();
  const auto lines = lines_without_comments(profiles_csv(result, result.photos[0], {}));
  EXPECT_EQ(cells(lines[5])[6], "");
  EXPECT_EQ(cells(lines[5])[7], "");
}

TEST(TraceCsv, NamesTheParametersAndQuotesTheStages) {
  const Photo photo = tests::small_photo();
  const auto lines = lines_without_comments(trace_csv(tests::small_fit(photo)));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "stage,evaluation,chi2,chi2_per_dof,sheet.main.energy_kev,sheet.main.phase_rad");
  EXPECT_EQ(lines[2].substr(0, 24), "\"scan, \"\"wide\"\"\",100,300");
  EXPECT_EQ(std::stod(cells(lines[3])[5]), 1.0 / 3.0);
}

}  // namespace
}  // namespace vegard::fit::run_tables_test
