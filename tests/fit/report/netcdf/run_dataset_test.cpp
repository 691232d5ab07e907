// Runs and sequences as netCDF.
#include "fit/report/netcdf/run_dataset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::run_dataset_test {
namespace {

TEST(RunDataset, HasParametersCovarianceAndVerdict) {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "run");
  std::ofstream(folder / "run/result.json")
      << R"({"verdict": "doubtful", "verdict_line": "line", "version": "1",
 "checks": [{"name": "level", "passed": false, "words": "not level"}],
 "parameters": [
  {"path": "sheet.main.energy_kev", "meaning": "energy", "value": 3.0, "unit": "keV", "sigma": 0.5,
   "interval68": [2.5, 3.6], "initial": 4, "min": 0.1, "max": 20, "at_limit": false},
  {"path": "camera.azimuth_deg", "photo": "b", "meaning": "azimuth", "value": 10, "unit": "deg", "sigma": 2,
   "interval68": null, "initial": 4, "min": 0, "max": 360, "at_limit": true},
  {"path": "sheet.main.bearing_deg", "meaning": "bearing", "value": 90, "unit": "deg", "sigma": null}],
 "correlation": [[1, 0.3, 0], [0.3, 1, 0], [0, 0, 1]],
 "solved": [{"name": "gain", "value": 2, "sigma": 0.1}],
 "derived": [{"name": "distance of the sheet", "value": 200, "sigma": 5, "systematic": 7, "unit": "km",
   "trust": "unconstrained", "trust_reason": "because"}],
 "chi2": 10, "dof": 7})";
  const sim::NetcdfDataset dataset = run_dataset(folder / "run");
  EXPECT_EQ(dataset.find("sheet_main_energy_kev")->reals[0], 3.0);
  EXPECT_EQ(dataset.find("sheet_main_energy_kev")->attribute("units"), "keV");
  EXPECT_EQ(dataset.find("sheet_main_energy_kev")->attribute("ancillary_variables"),
            "sheet_main_energy_kev_sigma");
  EXPECT_EQ(dataset.find("camera_azimuth_deg_of_b_sigma")->attribute("units"), "degree");
  const std::vector<double>& covariance = dataset.find("covariance")->reals;
  EXPECT_EQ(covariance[0], 0.25);
  EXPECT_NEAR(covariance[1], 0.3, 1e-15);
  EXPECT_EQ(covariance[4], 4.0);
  EXPECT_TRUE(std::isnan(covariance[8]));  // without an error bar
  EXPECT_TRUE(std::isnan(dataset.find("correlation")->reals[2]));
  EXPECT_EQ(dataset.find("parameter")->texts[1], "camera.azimuth_deg of b");
  EXPECT_EQ(dataset.find("parameter_unit")->texts[1], "degree");
  EXPECT_EQ(dataset.find("parameter_interval68")->reals[1], 3.6);
  EXPECT_EQ(dataset.find("verdict")->numbers[0], 1);
  EXPECT_EQ(dataset.find("verdict")->flag_words[1], "doubtful");
  EXPECT_EQ(dataset.find("check_passed")->numbers[0], 0);
  EXPECT_EQ(dataset.find("distance_of_the_sheet")->attribute("ancillary_variables"),
            "distance_of_the_sheet_sigma distance_of_the_sheet_systematic distance_of_the_sheet_trust");
  EXPECT_EQ(dataset.find("distance_of_the_sheet_trust")->numbers[0], 2);
  EXPECT_EQ(dataset.find("gain_sigma")->reals[0], 0.1);
  EXPECT_EQ(dataset_of(folder / "run").variables().size(), dataset.variables().size());
}

TEST(RunDataset, RefusesWhatIsNoRun) {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "empty");
  const auto refused = [&](const std::string& path) {
    return tests::expect_error(sim::ErrorKind::unreadable_input, [&] { dataset_of(path); });
  };
  EXPECT_NE(refused(folder / "empty").find("no result.json"), std::string::npos);
  EXPECT_NE(refused(folder / "missing").find("no such file"), std::string::npos);
  std::ofstream(folder / "empty/result.json") << "{";
  EXPECT_NE(refused(folder / "empty").find("no JSON"), std::string::npos);
  std::ofstream(folder / "empty/result.json") << R"({"verdict": 3, "parameters": 5})";
  EXPECT_NE(refused(folder / "empty").find("no result"), std::string::npos);
}

TEST(SequenceDataset, GoesByTime) {
  std::vector<SequenceRow> rows(2);
  rows[0].frame = "a";
  rows[0].time_s = 1.5;
  rows[0].verdict = Verdict::good;
  rows[0].numbers = {{"sheet.main.energy_kev", "keV", 3.0, 0.5}};
  rows[1].frame = "b";
  rows[1].time_s = 2.5;
  rows[1].verdict = Verdict::failed;
  rows[1].numbers = {{"sheet.main.energy_kev", "keV", 4.0, {}}, {"distance", "km", 7.0, 1.0}};
  const sim::NetcdfDataset dataset = sequence_dataset(rows);
  EXPECT_EQ(dataset.find("time")->reals, (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(dataset.find("sheet_main_energy_kev")->reals, (std::vector<double>{3.0, 4.0}));
  EXPECT_TRUE(std::isnan(dataset.find("sheet_main_energy_kev_sigma")->reals[1]));
  EXPECT_TRUE(std::isnan(dataset.find("distance")->reals[0]));
  EXPECT_EQ(dataset.find("verdict")->numbers, (std::vector<int>{0, 2}));
  EXPECT_EQ(dataset.find("frame")->texts[1], "b");
}

}  // namespace
}  // namespace vegard::fit::run_dataset_test
