// Density profiles from CSV and from Madrigal's HDF5 (tests/data/imagers/make.py), and how others are
// refused.
#include "fit/radar/density_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/expect_error.h"
#include "tests/support/source_folder.h"

namespace vegard::fit::density_table_test {
namespace {

using sim::ErrorKind;
using tests::expect_words;

DensityTable table_of(const std::string& text) { return density_table_of_csv(text, "it.csv", 80.0, 150.0); }

const std::string kRows = "90,1e11,1e9\n95,2e11,1e9\n100,3e11,1e9\n105,3e11,1e9\n110,2e11,1e9\n";

TEST(DensityTable, ReadsUnitsAndTimes) {
  const DensityTable per_m3 = table_of("altitude_km,density_m3,density_m3_error\n160,1,1\n" + kRows);
  ASSERT_EQ(per_m3.altitude_km.size(), 5u);  // 160 km is beyond what was asked for
  EXPECT_FALSE(per_m3.has_times());
  EXPECT_DOUBLE_EQ(per_m3.profiles[0].density_cm3[1], 2e5);
  EXPECT_DOUBLE_EQ(per_m3.profiles[0].sigma_cm3[1], 1e3);
  const std::string few = "90,1e5,1e3\n95,2e5,1e3\n100,3e5,1e3\n105,3e5,1e3\n110,2e5,1e3\n";
  EXPECT_DOUBLE_EQ(table_of("altitude_km,density_cm3,density_cm3_error\n" + few).profiles[0].density_cm3[1],
                   2e5);
  std::string text = "time_s,altitude_km,density_m3,density_m3_error\n";
  for (const char* time : {"20", "10"})
    for (int i = 0; i < 5; ++i) text += std::string(time) + "," + std::to_string(90 + i) + ",-1e9,5e9\n";
  const DensityTable times = table_of(text + "20,96,1e11,1e9\n");
  ASSERT_EQ(times.profiles.size(), 2u);
  EXPECT_EQ(times.profiles[0].time_s, 10.0);
  EXPECT_TRUE(std::isnan(times.profiles[0].density_cm3[5]));  // not measured then
  EXPECT_EQ(times.profiles[1].density_cm3[5], 1e5);
  EXPECT_EQ(times.profiles[0].measured(), 5);
  // A time with too few altitudes is kept among others.
  EXPECT_EQ(table_of(text + "30,96,1e11,1e9\n").profiles[2].measured(), 1);
}

TEST(DensityTable, RefusesWhatItCannotUse) {
  const auto refused = [](const std::vector<std::string>& words, const std::string& text) {
    expect_words(ErrorKind::unreadable_input, words, [&] { table_of(text); });
  };
  refused({"it.csv", "errors", "density_m3_error"}, "altitude_km,density_m3\n90,1\n");
  refused({"unit", "density_cm3"}, "altitude_km,density\n90,1\n");
  refused({"it.csv", "altitude_km"}, "z,density_m3,density_m3_error\n90,1,1\n");
  refused({"it.csv:2", "above 0"}, "altitude_km,density_m3,density_m3_error\n90,1,0\n");
  refused({"it.csv:2", "nan"}, "altitude_km,density_m3,density_m3_error\n90,nan,1\n");
  refused({"4 altitudes", "80 to 150 km", "5"},
          "altitude_km,density_m3,density_m3_error\n" + kRows.substr(kRows.find('\n') + 1));
  // Densities in m^-3 that are called cm^-3, and relative errors.
  refused({"it.csv:2", "1e+17 m^-3", "unit"}, "altitude_km,density_cm3,density_cm3_error\n" + kRows);
  refused({"it.csv:2", "1e+11 m^-3 with the error 0.05", "unit"},
          "altitude_km,density_m3,density_m3_error\n90,1e11,0.05\n");
  refused({"two densities", "90 km"}, "altitude_km,density_m3,density_m3_error\n90,1,1\n" + kRows);
}

TEST(DensityTable, ReadsMadrigal) {
  const std::string file = tests::source_folder() + "/tests/data/imagers/madrigal.h5";
  expect_words(ErrorKind::unreadable_input, {"madrigal.h5", "2 beams", "--beam"},
               [&] { read_density_table(file, 80.0, 150.0); });
  expect_words(ErrorKind::unreadable_input, {"no beam 7"},
               [&] { read_density_table(file, 80.0, 150.0, 7.0); });
  const DensityTable first = read_density_table(file, 80.0, 150.0, 1.0),
                     second = read_density_table(file, 80.0, 150.0, 2.0);
  ASSERT_EQ(first.profiles.size(), 2u);
  ASSERT_EQ(first.altitude_km.size(), 14u);
  EXPECT_EQ(first.profiles[0].time_s, 1206515030.0);
  EXPECT_TRUE(std::isnan(first.profiles[0].density_cm3[3]));
  EXPECT_NEAR(first.profiles[1].density_cm3[5], std::pow(10.0, 5.5), 1.0);  // nel 11.5 at 110 km
  EXPECT_NEAR(first.profiles[1].sigma_cm3[5], std::pow(10.0, 4.2), 0.1);    // dnel 10.2: the error's log10
  // dnel 0.02: the error of the log10.
  EXPECT_NEAR(second.profiles[1].sigma_cm3[5], 0.02 * std::log(10.0) * std::pow(10.0, 5.5), 0.1);
}

// NaN has no place in an order: rows without a time or a beam are in no profile, and change none.
TEST(DensityTable, LeavesOutRowsOfMadrigalWithoutTimeOrBeam) {
  const std::string file = tests::source_folder() + "/tests/data/imagers/madrigal_gaps.h5";
  for (const std::optional<double> beam : {std::optional<double>(), std::optional<double>(1.0)}) {
    const DensityTable table = read_density_table(file, 80.0, 150.0, beam);
    ASSERT_EQ(table.profiles.size(), 2u);
    EXPECT_EQ(table.profiles[0].time_s, 1206515030.0);
    EXPECT_EQ(table.profiles[1].time_s, 1206515150.0);
    EXPECT_EQ(table.profiles[0].measured(), 14);
    EXPECT_EQ(table.profiles[1].measured(), 13);
    EXPECT_NEAR(table.profiles[0].density_cm3[3], 1e5, 1.0);
    EXPECT_TRUE(std::isnan(table.profiles[1].density_cm3[3]));
  }
}

}  // namespace
}  // namespace vegard::fit::density_table_test
