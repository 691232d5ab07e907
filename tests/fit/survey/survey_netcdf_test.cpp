// A survey as netCDF, read back by the library.
#include "fit/survey/survey_export.h"

#include <gtest/gtest.h>
#include <netcdf.h>

#include "fit/survey/survey_motion.h"
#include "fit/survey/survey_results.h"
#include "tests/fit/survey/made_answers.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::survey_netcdf_test {
namespace {

using tests::bytes_of;
using tests::made_answer;

/// A file of the library's, for reading.
class OpenNetcdf {
 public:
  explicit OpenNetcdf(const std::string& name) {
    EXPECT_EQ(nc_open(name.c_str(), NC_NOWRITE, &id_), NC_NOERR);
  }
  ~OpenNetcdf() { nc_close(id_); }
  OpenNetcdf(const OpenNetcdf&) = delete;
  OpenNetcdf& operator=(const OpenNetcdf&) = delete;

  std::size_t frames() const {
    int dimension = -1;
    std::size_t size = 0;
    EXPECT_EQ(nc_inq_dimid(id_, "frame", &dimension), NC_NOERR);
    EXPECT_EQ(nc_inq_dimlen(id_, dimension, &size), NC_NOERR);
    return size;
  }
  std::string words(const std::string& variable, const std::string& attribute) const {
    const int of = variable.empty() ? NC_GLOBAL : id_of(variable);
    std::size_t size = 0;
    EXPECT_EQ(nc_inq_attlen(id_, of, attribute.c_str(), &size), NC_NOERR) << variable << " " << attribute;
    std::string text(size, ' ');
    EXPECT_EQ(nc_get_att_text(id_, of, attribute.c_str(), text.data()), NC_NOERR);
    return text;
  }
  std::vector<double> numbers(const std::string& variable) const {
    std::vector<double> values(frames());
    EXPECT_EQ(nc_get_var_double(id_, id_of(variable), values.data()), NC_NOERR) << variable;
    return values;
  }
  std::string text(const std::string& variable, std::size_t row) const {
    char* text = nullptr;
    EXPECT_EQ(nc_get_var1_string(id_, id_of(variable), &row, &text), NC_NOERR);
    const std::string copy = text != nullptr ? text : "";
    nc_free_string(1, &text);
    return copy;
  }

 private:
  int id_of(const std::string& variable) const {
    int id = -1;
    EXPECT_EQ(nc_inq_varid(id_, variable.c_str(), &id), NC_NOERR) << variable;
    return id;
  }
  int id_ = -1;
};

std::string made_shard(const std::string& name, const SurveyPlan& plan) {
  ShardResults results(name, plan);
  std::vector<FrameAnswer> all;  // at once: each transaction waits for the disk
  for (int b = 0; b < static_cast<int>(plan.blocks.size()); ++b)
    for (int f = 0; f < static_cast<int>(plan.blocks[0].frames.size()); ++f)
      all.push_back(made_answer(plan, b, f));
  results.add(all);
  return name;
}

TEST(SurveyNetcdf, HasAllThatFramesTell) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = tests::made_survey_plan(3, 7);
  const SqliteFile database(made_shard(folder / "a.sqlite", plan), SqliteFile::Opening::read);
  write_survey_netcdf(database, folder / "a.nc", false);
  const OpenNetcdf file(folder / "a.nc");
  ASSERT_EQ(file.frames(), 21u);
  EXPECT_EQ(file.words("", "Conventions"), "CF-1.8");
  EXPECT_EQ(file.words("", "plan_sha256"), plan.sha256);
  EXPECT_EQ(file.words("time", "units"), "seconds since 1970-01-01 00:00:00");
  EXPECT_EQ(file.words("time", "calendar"), "standard");
  EXPECT_EQ(file.words("fit_distance_of_the_main_sheet", "units"), "km");
  EXPECT_EQ(file.words("fit_distance_of_the_main_sheet", "long_name"), "distance of the main sheet");
  EXPECT_EQ(file.words("fit_distance_of_the_main_sheet", "ancillary_variables"),
            "fit_distance_of_the_main_sheet_sigma fit_distance_of_the_main_sheet_trust");
  EXPECT_EQ(file.words("fit_sheet_main_energy_kev", "ancillary_variables"),
            "fit_sheet_main_energy_kev_sigma");
  EXPECT_EQ(file.words("fit_energy_flux_Q_of_the_main_sheet", "units"), "mW m-2");
  EXPECT_EQ(file.words("fit_distance_of_the_main_sheet_trust", "flag_meanings"),
            "good doubtful unconstrained");
  EXPECT_EQ(file.words("status", "flag_meanings"), "done skipped missing unreadable filtered");
  EXPECT_EQ(file.words("border_verdict", "flag_meanings"), "none");
  const std::vector<double> time = file.numbers("time"), status = file.numbers("status"),
                            verdict = file.numbers("fit_verdict"),
                            distance = file.numbers("fit_distance_of_the_main_sheet"),
                            sigma = file.numbers("fit_distance_of_the_main_sheet_sigma"),
                            energy = file.numbers("fit_sheet_main_energy_kev"),
                            flux = file.numbers("fit_energy_flux_Q_of_the_main_sheet"),
                            trust = file.numbers("fit_energy_flux_Q_of_the_main_sheet_trust");
  for (int i = 0; i < 21; ++i) {
    const FrameAnswer made = made_answer(plan, i / 7, i % 7);
    const auto row = static_cast<std::size_t>(i);
    EXPECT_EQ(time[row], made.time_s);
    EXPECT_EQ(file.text("camera", row), "gill");
    EXPECT_EQ(file.text("file", row), made.file);
    const bool is_done = made.status == FrameStatus::done;
    EXPECT_EQ(status[row], is_done ? 0.0 : 2.0);
    EXPECT_EQ(verdict[row], is_done ? 0.0 : -127.0);
    EXPECT_EQ(distance[row], is_done ? 220.0 + i : NC_FILL_DOUBLE);
    EXPECT_EQ(sigma[row], is_done ? 3.25 : NC_FILL_DOUBLE);
    EXPECT_EQ(energy[row], is_done ? std::sqrt(i) : NC_FILL_DOUBLE);
    EXPECT_EQ(flux[row], NC_FILL_DOUBLE);
    EXPECT_EQ(trust[row], is_done ? 2.0 : -127.0);
  }
}

TEST(SurveyNetcdf, HasVelocitiesWhereTheyAreTold) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = tests::made_survey_plan(1, 20);
  smooth_survey(made_shard(folder / "a.sqlite", plan), folder / "b.sqlite", {}, false);
  write_survey_netcdf(SqliteFile(folder / "b.sqlite", SqliteFile::Opening::read), folder / "b.nc", false);
  const OpenNetcdf file(folder / "b.nc");
  EXPECT_EQ(file.words("fit_velocity_of_distance_of_the_main_sheet", "units"), "m/s");
  const std::vector<double> velocity = file.numbers("fit_velocity_of_distance_of_the_main_sheet"),
                            flag = file.numbers("fit_velocity_of_distance_of_the_main_sheet_flag");
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    if (i % 5 == 2) {
      EXPECT_EQ(velocity[i], NC_FILL_DOUBLE);
      EXPECT_EQ(flag[i], -127.0);
    } else {
      EXPECT_NEAR(velocity[i], 1000.0 / 3.0, 1e-2);  // a kilometre every 3 s
      EXPECT_EQ(flag[i], 0.0);
    }
  }
}

TEST(SurveyNetcdf, IsTheSameLaterOn) {
  const tests::TemporaryFolder folder;
  const SqliteFile database(made_shard(folder / "a.sqlite", tests::made_survey_plan(3, 7)),
                            SqliteFile::Opening::read);
  write_survey_netcdf(database, folder / "a.nc", false);
  tests::await_next_second();  // HDF5's times are whole seconds
  write_survey_netcdf(database, folder / "b.nc", false);
  EXPECT_EQ(bytes_of(folder / "a.nc"), bytes_of(folder / "b.nc"));
  tests::expect_error(sim::ErrorKind::existing_output,
                      [&] { write_survey_netcdf(database, folder / "a.nc", false); });
  write_survey_netcdf(database, folder / "a.nc", true);
}

}  // namespace
}  // namespace vegard::fit::survey_netcdf_test
