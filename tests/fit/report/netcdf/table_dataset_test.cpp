// Tables of profiles and keograms as arrays.
#include "fit/report/netcdf/table_dataset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_error.h"

namespace vegard::fit::table_dataset_test {
namespace {

constexpr const char* kKeogram =
    "# keogram: mean light\n# picture: 2014-02-21T19:30:00Z aa one.png\n"
    "# picture: 2014-02-21T19:30:10.5Z bb two.png\n# time: ISO 8601, UTC\n"
    "time,row_px,r,g,b,sigma_r,sigma_g,sigma_b,n_r,n_g,n_b\n"
    "2014-02-21T19:30:00Z,0,1,2,3,0.1,0.2,0.3,5,6,7\n2014-02-21T19:30:00Z,1,4,5,6,,,,0,0,0\n"
    "2014-02-21T19:30:10.5Z,0,7,8,9,0.1,0.2,0.3,5,6,7\n2014-02-21T19:30:10.5Z,1,,,,,,,0,0,0\n";

TEST(TableDataset, MakesArraysByTimeAndPlace) {
  const sim::NetcdfDataset dataset = table_dataset(kKeogram, "k.csv");
  const sim::NetcdfVariable& time = *dataset.find("time");
  ASSERT_EQ(time.reals.size(), 2u);
  EXPECT_EQ(time.reals[1] - time.reals[0], 10.5);
  EXPECT_EQ(time.reals[0], 1393011000.0);  // date -u -d 2014-02-21T19:30:00Z +%s
  EXPECT_EQ(time.attribute("units"), "seconds since 1970-01-01 00:00:00");
  const sim::NetcdfVariable& green = *dataset.find("g");
  EXPECT_EQ(green.dimensions, (std::vector<std::string>{"time", "row_px"}));
  EXPECT_EQ(green.reals[0], 2.0);
  EXPECT_EQ(green.reals[1], 5.0);
  EXPECT_EQ(green.reals[2], 8.0);
  EXPECT_TRUE(std::isnan(green.reals[3]));
  EXPECT_EQ(green.attribute("ancillary_variables"), "sigma_g n_g");
  EXPECT_EQ(dataset.find("n_b")->numbers, (std::vector<int>{7, 0, 7, 0}));
  EXPECT_EQ(dataset.find("row_px")->reals, (std::vector<double>{0.0, 1.0}));
}

TEST(TableDataset, LeavesAGapWhereThereIsNoRow) {
  const sim::NetcdfDataset dataset = table_dataset(
      "# by direction\nazimuth_deg,elevation_deg,r,sigma_r\n10,30,1,0.1\n20,30,2,0.2\n20,31,3,0.3\n",
      "d.csv");
  EXPECT_EQ(dataset.find("r")->dimensions, (std::vector<std::string>{"azimuth_deg", "elevation_deg"}));
  EXPECT_EQ(dataset.find("r")->reals[0], 1.0);
  EXPECT_TRUE(std::isnan(dataset.find("r")->reals[1]));
  EXPECT_EQ(dataset.find("r")->reals[3], 3.0);
  EXPECT_EQ(dataset.find("azimuth_deg")->attribute("units"), "degree");
}

TEST(TableDataset, KeepsElevationsAsPlacesOfRows) {
  const sim::NetcdfDataset dataset = table_dataset(
      "# p\nband,row_px,elevation_deg,channel,data,sigma,model,residual_over_sigma,count\n"
      "0,5,40,r,1,2,3,4,9\n0,5,40,g,5,6,7,8,9\n0,6,39,r,1,2,3,4,9\n0,6,39,g,5,6,7,8,9\n",
      "p.csv");
  EXPECT_EQ(dataset.find("elevation_deg")->dimensions, (std::vector<std::string>{"band", "row_px"}));
  EXPECT_EQ(dataset.find("elevation_deg")->reals, (std::vector<double>{40.0, 39.0}));
  EXPECT_EQ(dataset.find("data")->attribute("coordinates"), "elevation_deg");
  EXPECT_EQ(dataset.find("data")->reals, (std::vector<double>{1.0, 5.0, 1.0, 5.0}));
  EXPECT_EQ(dataset.find("channel")->texts, (std::vector<std::string>{"r", "g"}));
}

TEST(TableDataset, RefusesWhatIsNoTableOfOurs) {
  const auto refused = [](const std::string& text) {
    return tests::expect_error(sim::ErrorKind::unreadable_input, [&] { table_dataset(text, "t.csv"); });
  };
  EXPECT_NE(refused("").find("no table"), std::string::npos);
  EXPECT_NE(refused("a,b\n1,2\n").find("none of those"), std::string::npos);
  EXPECT_NE(refused("band,row_px,r\n0,1\n").find("t.csv:2"), std::string::npos);
  EXPECT_NE(refused("band,row_px,r\n0,1,soon\n").find("no number"), std::string::npos);
  EXPECT_NE(refused("band,row_px,r\n0,1,2\n0,1,3\n").find("t.csv:3"), std::string::npos);
  EXPECT_NE(refused("band,row_px,row_px\n0,1,2\n").find("one name"), std::string::npos);
  EXPECT_NE(refused("# x\n# time: ISO 8601, UTC\ntime,row_px,r\nsoon,1,2\n").find("no time"),
            std::string::npos);
}

TEST(TableDataset, RefusesKeysThatMakeNoGrid) {
  // 10000 rows, each of a place of its own both ways: a grid of 10^8 numbers.
  std::string text = "band,row_px,r\n";
  for (int i = 0; i < 10000; ++i) text += std::to_string(i) + "," + std::to_string(i) + ",1\n";
  const std::string words =
      tests::expect_error(sim::ErrorKind::unreadable_input, [&] { table_dataset(text, "t.csv"); });
  EXPECT_NE(words.find("no grid"), std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::table_dataset_test
