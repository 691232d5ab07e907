// Maps as netCDF.
#include "fit/report/netcdf/run_dataset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fit/report/netcdf/made_map.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::map_dataset_test {
namespace {

using tests::made_map;

TEST(MapDataset, HasPlacesErrorsAndCurtains) {
  const tests::TemporaryFolder folder;
  const sim::NetcdfDataset dataset = map_dataset(made_map(folder / "a", "2014-03-10T06:05:33"));
  EXPECT_EQ(dataset.find("energy_flux")->dimensions, (std::vector<std::string>{"north", "east"}));
  EXPECT_EQ(dataset.find("east")->reals[0], -40.0);
  EXPECT_EQ(dataset.find("north")->reals[1], 102.0);
  EXPECT_TRUE(std::isnan(dataset.find("energy_flux")->reals[0]));
  EXPECT_NEAR(dataset.find("energy_flux_sigma")->reals[1], 0.4, 1e-6);
  EXPECT_NEAR(dataset.find("energy_sigma")->reals[1], 0.4, 1e-6);
  // 100 km to the north on a sphere of 6481 km.
  EXPECT_NEAR(dataset.find("latitude")->reals[20],
              65.1 + std::asin(100.0 / 6481.0) * 180.0 / 3.14159265358979, 1e-9);
  EXPECT_NEAR(dataset.find("longitude")->reals[20], -147.4, 1e-9);
  EXPECT_EQ(dataset.find("curtain")->numbers, (std::vector<int>{1, 1, 2}));
  EXPECT_EQ(dataset.find("curtain_energy_sigma")->reals[0], 0.5);
  EXPECT_TRUE(std::isnan(dataset.find("curtain_distance_sigma")->reals[2]));
  EXPECT_EQ(dataset.find("verdict")->numbers, (std::vector<int>{0}));
  EXPECT_EQ(dataset.find("time")->reals[0], 1394431533.0);
  const sim::NetcdfDataset relative = map_dataset(made_map(folder / "r", "", "relative"));
  EXPECT_EQ(relative.find("energy_flux")->attribute("units"), "1");
  EXPECT_EQ(relative.find("time"), nullptr);
  const auto energy = [&](const std::string& spectrum) {
    return map_dataset(made_map(folder / ("s" + spectrum), "", "absolute", spectrum))
        .find("energy")
        ->attribute("long_name");
  };
  EXPECT_NE(energy("").find("Maxwellian"), std::string::npos);
  EXPECT_NE(energy("kappa").find("kappa"), std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::map_dataset_test
