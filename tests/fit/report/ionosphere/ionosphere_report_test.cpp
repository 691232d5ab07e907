#include "fit/report/ionosphere/ionosphere_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "sim/base/error.h"
#include "tests/fit/report/netcdf/made_map.h"

namespace vegard::fit::ionosphere_report_test {
namespace {

std::string folder() {
  const std::string made = testing::TempDir() + "ionosphere_report";
  std::filesystem::create_directories(made);
  return made;
}

std::string written(const std::string& name, const std::string& text) {
  const std::string file = folder() + "/" + name;
  std::ofstream(file) << text;
  return file;
}

std::string refusal(const std::string& path, const std::string& name = "", double factor = 0.0) {
  try {
    read_electron_source(path, name, factor);
  } catch (const sim::Error& error) {
    return error.what();
  }
  return "none";
}

TEST(IonosphereReport, OfAMapHasNumbersWhereElectronsAreKnown) {
  const std::string map = tests::made_map(folder() + "/map", "2014-03-10T06:05:33Z");
  const ElectronSource source = read_electron_source(map, "", 0.0);
  const sim::IonosphereModel model(sim::emission_tables("vegard"), {});
  const sim::IonosphereTable table(model, electron_range(source, model), 0, 1);
  const IonosphereAnswer answer = ionospheres(table, source, 1);
  const sim::NetcdfDataset dataset = ionosphere_dataset(table, source, answer, {}, false, 1);
  const sim::NetcdfVariable* hall = dataset.find("hall_conductance");
  ASSERT_NE(hall, nullptr);
  EXPECT_EQ(hall->attribute("units"), "S");
  EXPECT_TRUE(std::isnan(hall->reals[0]));  // the first column is unknown
  EXPECT_NEAR(hall->reals[1] / model.at(2.0, 4.0).hall_s, 1.0, 0.01);
  EXPECT_GT(dataset.find("hall_conductance_sigma")->reals[1], 0.0);
  EXPECT_EQ(dataset.find("electron_density"), nullptr);
  const sim::NetcdfDataset profiles = ionosphere_dataset(table, source, answer, {}, true, 1);
  const sim::NetcdfVariable* density = profiles.find("electron_density");
  EXPECT_EQ(density->dimensions, (std::vector<std::string>{"level", "north", "east"}));
  const std::size_t level = 30, cells = source.map->cells();
  EXPECT_NEAR(density->reals[level * cells + 1] / (1e6 * model.at(2.0, 4.0).ions[level].electrons), 1.0,
              0.01);
  EXPECT_NE(refusal(tests::made_map(folder() + "/relative", "", "relative")).find("--flux-factor"),
            std::string::npos);
  EXPECT_NE(refusal(tests::made_map(folder() + "/mono", "", "absolute", "mono")).find("mono"),
            std::string::npos);
}

TEST(IonosphereReport, ReadsAnswersOfInvert) {
  const ElectronSource one = read_electron_source(
      written("electrons.json",
              R"({"kind": "vegard invert", "spectrum": "maxwellian", "tables": "glow", "solutions": [
 {"energy_flux_mw_m2": {"value": 9.0, "free": false}, "energy_kev": {"value": 3.4, "free": true, "sigma_ln": 0.2},
  "oxygen_factor": {"value": 0.8, "free": true, "sigma_ln": 0.1}, "correlations": {"energy_kev,energy_flux_mw_m2": 0.5}}]})"),
      "", 0.0);
  ASSERT_EQ(one.rows.size(), 1u);
  EXPECT_EQ(one.rows[0].energy_kev, 3.4);
  EXPECT_EQ(one.rows[0].ln_energy_sigma, 0.2);
  EXPECT_EQ(one.rows[0].relative_flux_sigma, 0.0);  // it was held
  EXPECT_EQ(one.rows[0].correlation, 0.5);
  EXPECT_EQ(one.oxygen_factor, 0.8);
  EXPECT_EQ(one.tables, "glow");

  const ElectronSource table = read_electron_source(
      written("night.csv",
              "# vegard invert, maxwellian electrons\nUT_h,energy_flux_mw_m2,energy_kev,energy_kev_68_low,"
              "energy_kev_68_high,verdict\n8.5,2,4,2,8,good\n9,,,,,none\n"),
      "", 0.0);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_NEAR(table.rows[0].ln_energy_sigma, std::log(2.0), 1e-12);
  EXPECT_TRUE(std::isnan(table.rows[0].relative_flux_sigma));  // the table does not tell it
  EXPECT_TRUE(std::isnan(table.rows[1].energy_kev));
  EXPECT_EQ(table.row_name, "UT_h");
  EXPECT_EQ(table.row_numbers, (std::vector<double>{8.5, 9.0}));
}

TEST(IonosphereReport, ReadsTheSheetsOfAFit) {
  std::filesystem::create_directories(folder() + "/run");
  std::ofstream(folder() + "/run/result.json") << R"({"derived": [
 {"name": "characteristic energy E0 of the main sheet", "value": 4.0, "sigma": 0.4},
 {"name": "energy flux Q of the main sheet", "value": 8.0, "sigma": 2.0},
 {"name": "characteristic energy E0 of the other sheet", "value": 2.0, "sigma": null},
 {"name": "energy flux Q of the other sheet", "value": 3.0, "sigma": 1.5}]})";
  EXPECT_NE(refusal(folder() + "/run").find("main sheet"), std::string::npos);
  EXPECT_NE(refusal(folder() + "/run", "third").find("third"), std::string::npos);
  const ElectronSource main = read_electron_source(folder() + "/run", "main", 0.0);
  EXPECT_NEAR(main.rows[0].ln_energy_sigma, 0.1, 1e-12);
  EXPECT_NEAR(main.rows[0].relative_flux_sigma, 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(read_electron_source(folder() + "/run", "other", 0.0).rows[0].ln_energy_sigma));
}

}  // namespace
}  // namespace vegard::fit::ionosphere_report_test
