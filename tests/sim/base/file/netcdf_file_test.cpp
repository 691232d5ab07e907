// The writer of netCDF: names, numbers of several dimensions, and what cannot be written.
#include "sim/base/file/netcdf_file.h"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <cmath>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::netcdf_file_test {
namespace {

TEST(NetcdfFile, MakesNamesThatAllProgramsTake) {
  EXPECT_EQ(netcdf_name("fit distance of the main sheet"), "fit_distance_of_the_main_sheet");
  EXPECT_EQ(netcdf_name("I(630.0)/I(557.7) along the field"), "I_630_0_I_557_7_along_the_field");
  EXPECT_EQ(netcdf_name("557.7 nm"), "n_557_7_nm");
  EXPECT_EQ(netcdf_name("caf\u00e9"), "caf");
  EXPECT_EQ(netcdf_name(""), "n_");
}

TEST(NetcdfFile, HoldsNumbersOfTwoDimensions) {
  const tests::TemporaryFolder folder;
  {
    NetcdfFile file(folder / "a.nc", "a.nc");
    const auto row = file.dimension("row", 2), column = file.dimension("column", 3);
    const auto map = file.variable("map", NetcdfType::real, {row, column});
    const auto count = file.variable("count", NetcdfType::whole, {row});
    const auto seed = file.variable("seed", NetcdfType::whole, {});
    file.attribute(map, "valid_min", 0.5);
    file.put(map, 0, std::vector<double>{1.0, 2.0, std::nan(""), 4.0, 5.0, 6.0});
    file.put(count, 1, std::vector<int>{7});
    file.put(count, 0, std::vector<int>{3});
    file.put(seed, 0, std::vector<int>{22});
    file.close();
  }
  int id = -1, map = -1, count = -1, seed = -1;
  ASSERT_EQ(nc_open((folder / "a.nc").c_str(), NC_NOWRITE, &id), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(id, "map", &map), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(id, "count", &count), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(id, "seed", &seed), NC_NOERR);
  double values[6] = {}, least = 0.0, fill = 0.0;
  int counts[2] = {}, number = 0;
  EXPECT_EQ(nc_get_var_double(id, map, values), NC_NOERR);
  EXPECT_EQ(nc_get_var_int(id, count, counts), NC_NOERR);
  EXPECT_EQ(nc_get_var_int(id, seed, &number), NC_NOERR);
  EXPECT_EQ(nc_get_att_double(id, map, "valid_min", &least), NC_NOERR);
  EXPECT_EQ(nc_get_att_double(id, map, "_FillValue", &fill), NC_NOERR);
  nc_close(id);
  for (const int i : {0, 1, 3, 4, 5}) EXPECT_EQ(values[i], i + 1.0);
  EXPECT_EQ(values[2], fill);
  EXPECT_EQ(fill, kNetcdfNoReal);
  EXPECT_EQ(counts[0], 3);
  EXPECT_EQ(counts[1], 7);
  EXPECT_EQ(number, 22);
  EXPECT_EQ(least, 0.5);
}

TEST(NetcdfFile, SaysWhatCannotBeWritten) {
  const tests::TemporaryFolder folder;
  const std::string words = tests::expect_error(
      ErrorKind::unwritable_output, [&] { NetcdfFile(folder / "no/such/folder.nc", "folder.nc"); });
  EXPECT_NE(words.find("folder.nc"), std::string::npos);
}

}  // namespace
}  // namespace vegard::sim::netcdf_file_test
