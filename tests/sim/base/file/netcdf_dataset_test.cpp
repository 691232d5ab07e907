// Datasets of netCDF: names, units, flags, and what stands in a file.
#include "sim/base/file/netcdf_dataset.h"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <cmath>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::netcdf_dataset_test {
namespace {

NetcdfDataset made() {
  NetcdfDataset dataset("a title", "a source");
  dataset.dimension("row", 2);
  dataset.dimension("column", 3);
  dataset.real("the map", "a map", "mW m-2", {"row", "column"}, {1.0, 2.0, std::nan(""), 4.0, 5.0, 6.0})
      .with("comment", "first")
      .with("comment", "second");
  dataset.whole("count", "a count", "1", {"row"}, {3, 7});
  dataset.flags("kind", "what it is", {"not told", "good"}, {"row"}, {1, kNetcdfNoFlag});
  dataset.text("name", "a name", {"row"}, {"a", "b, c"});
  dataset.real("alone", "one number", "km", {}, {110.0});
  return dataset;
}

std::string words_of(int file, const char* variable, const char* attribute) {
  int id = -1;
  std::size_t size = 0;
  EXPECT_EQ(nc_inq_varid(file, variable, &id), NC_NOERR) << variable;
  if (nc_inq_attlen(file, id, attribute, &size) != NC_NOERR) return "none";
  std::string words(size, ' ');
  EXPECT_EQ(nc_get_att_text(file, id, attribute, words.data()), NC_NOERR);
  return words;
}

TEST(NetcdfDataset, WritesWhatItHolds) {
  const tests::TemporaryFolder folder;
  const NetcdfDataset dataset = made();
  EXPECT_EQ(dataset.find("the_map")->attribute("comment"), "second");
  EXPECT_EQ(dataset.size_of("column"), 3u);
  EXPECT_EQ(dataset.find("nothing"), nullptr);
  write_netcdf(dataset, folder / "a.nc", false);
  int file = -1, id = -1;
  ASSERT_EQ(nc_open((folder / "a.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
  EXPECT_EQ(words_of(file, "the_map", "units"), "mW m-2");
  EXPECT_EQ(words_of(file, "the_map", "long_name"), "a map");
  EXPECT_EQ(words_of(file, "kind", "flag_meanings"), "not_told good");
  EXPECT_EQ(words_of(file, "kind", "units"), "none");
  double map[6] = {}, alone = 0.0;
  ASSERT_EQ(nc_inq_varid(file, "the_map", &id), NC_NOERR);
  EXPECT_EQ(nc_get_var_double(file, id, map), NC_NOERR);
  EXPECT_EQ(map[1], 2.0);
  EXPECT_EQ(map[2], kNetcdfNoReal);
  EXPECT_EQ(map[3], 4.0);
  ASSERT_EQ(nc_inq_varid(file, "alone", &id), NC_NOERR);
  EXPECT_EQ(nc_get_var_double(file, id, &alone), NC_NOERR);
  EXPECT_EQ(alone, 110.0);
  signed char kinds[2] = {};
  ASSERT_EQ(nc_inq_varid(file, "kind", &id), NC_NOERR);
  EXPECT_EQ(nc_get_var_schar(file, id, kinds), NC_NOERR);
  EXPECT_EQ(kinds[0], 1);
  EXPECT_EQ(kinds[1], kNetcdfNoFlag);
  nc_close(file);
}

TEST(NetcdfDataset, HasTheSameBytesAndSparesWhatIsThere) {
  const tests::TemporaryFolder folder;
  write_netcdf(made(), folder / "a.nc", false);
  write_netcdf(made(), folder / "b.nc", false);
  EXPECT_EQ(tests::bytes_of(folder / "a.nc"), tests::bytes_of(folder / "b.nc"));
  tests::expect_error(ErrorKind::existing_output, [&] { write_netcdf(made(), folder / "a.nc", false); });
  write_netcdf(made(), folder / "a.nc", true);
}

TEST(NetcdfDataset, GivesNamesThatNoTwoVariablesHave) {
  NetcdfDataset dataset("", "");
  EXPECT_EQ(dataset.real("a.b", "", "1", {}, {1.0}).name, "a_b");
  EXPECT_EQ(dataset.real("a b", "", "1", {}, {1.0}).name, "a_b_2");
}

TEST(NetcdfDataset, WritesUnitsAsUdunitsHasThem) {
  EXPECT_EQ(udunits_of("mW m\u207b\u00b2"), "mW m-2");
  EXPECT_EQ(udunits_of("deg"), "degree");
  EXPECT_EQ(udunits_of("km"), "km");
  EXPECT_EQ(udunits_of(""), "1");
  EXPECT_EQ(udunits_of("dex"), "1");
  EXPECT_EQ(udunits_of("m/s"), "m/s");
  EXPECT_EQ(udunits_of("deg/s"), "degree s-1");
  EXPECT_EQ(udunits_of("white/s"), "1 s-1");
}

TEST(NetcdfDataset, NumbersFlagsByTheirWords) {
  EXPECT_EQ(flag_number({"a", "b"}, "b"), 1);
  EXPECT_EQ(flag_number({"a", "b"}, "c"), kNetcdfNoFlag);
  EXPECT_EQ(netcdf_flag_meanings({"not told", "good"}), "not_told good");
}

}  // namespace
}  // namespace vegard::sim::netcdf_dataset_test
