// Maps as models of the ionosphere read them.
#include "fit/report/netcdf/model_inputs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "sim/base/array/array_format.h"
#include "tests/fit/report/netcdf/made_map.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::model_inputs_test {
namespace {

using tests::made_map;

TEST(ModelInputs, NamesFilesByTheirSecondsOfTheDay) {
  EXPECT_EQ(gemini_file_name(1394431533.5), "20140310_21933.500000.h5");
  EXPECT_EQ(gemini_file_name(1394409600.0), "20140310_00000.000000.h5");
  EXPECT_EQ(gemini_file_name(1394409599.9999999), "20140310_00000.000000.h5");
}

TEST(ModelInputs, GivesGeminiItsLayout) {
  const tests::TemporaryFolder folder;
  const ModelInputs inputs = model_inputs(
      {made_map(folder / "b", "2014-03-10T06:05:43"), made_map(folder / "a", "2014-03-10T06:05:33")},
      EarthFrame::gemini_dipole, 0.1, 0.0, {});
  EXPECT_EQ(inputs.names, (std::vector<std::string>{"a", "b"}));
  write_gemini(folder / "out", false, inputs);
  const auto size = sim::open_array_file(folder / "out/simsize.h5");
  const auto numbers = [](sim::ArrayFile& file, const std::string& name) {
    for (const sim::StoredArray& array : file.arrays())
      if (array.name == name) return file.read_numbers(array);
    ADD_FAILURE() << "no " << name;
    return std::vector<double>();
  };
  EXPECT_EQ(numbers(*size, "llon"),
            (std::vector<double>{static_cast<double>(inputs.grid.longitude_deg.size())}));
  EXPECT_EQ(numbers(*size, "llat"),
            (std::vector<double>{static_cast<double>(inputs.grid.latitude_deg.size())}));
  const auto grid = sim::open_array_file(folder / "out/simgrid.h5");
  EXPECT_EQ(numbers(*grid, "mlon"), inputs.grid.longitude_deg);
  const auto frame = sim::open_array_file(folder / "out/20140310_21933.000000.h5");
  const std::vector<double> flux = numbers(*frame, "Qp"), energy = numbers(*frame, "E0p");
  ASSERT_EQ(flux.size(), inputs.grid.cells());
  double most = 0.0;
  for (const double q : flux) most = std::max(most, q);
  EXPECT_NEAR(most, 4.0, 1e-6);
  // Nowhere 0 eV, and everywhere a number.
  for (const double e : energy) EXPECT_NEAR(e, 2000.0, 1e-3);
  for (const sim::StoredArray& array : frame->arrays())
    if (array.name == "Qp") {
      EXPECT_EQ(array.dims, (std::vector<std::uint64_t>{inputs.grid.latitude_deg.size(),
                                                        inputs.grid.longitude_deg.size()}));
    }
  tests::expect_error(sim::ErrorKind::existing_output, [&] { write_gemini(folder / "out", false, inputs); });
  write_gemini(folder / "out", true, inputs);
  std::ofstream(folder / "out/notes.txt") << "mine";
  tests::expect_error(sim::ErrorKind::existing_output, [&] { write_gemini(folder / "out", true, inputs); });
}

TEST(ModelInputs, GivesLompeConductances) {
  const tests::TemporaryFolder folder;
  const ModelInputs inputs =
      model_inputs({made_map(folder / "a", "2014-03-10T06:05:33")}, EarthFrame::geographic, 0.1, 0.0, {});
  const sim::NetcdfDataset dataset = lompe_dataset(inputs);
  const sim::NetcdfVariable &sp = *dataset.find("SP"), &sigma = *dataset.find("SP_sigma");
  EXPECT_EQ(sp.attribute("units"), "S");
  std::size_t told = 0;
  for (std::size_t i = 0; i < sp.reals.size(); ++i) {
    if (!std::isfinite(sp.reals[i])) continue;
    ++told;
    // Robinson's formula at a mean energy of 4 keV, where the energy's error does not count.
    EXPECT_NEAR(sp.reals[i], 10.0, 1e-4);
    EXPECT_NEAR(sigma.reals[i], 0.5, 1e-4);
  }
  EXPECT_GT(told, 20u);
  EXPECT_EQ(dataset.find("time")->reals[0], 1394431533.0);
}

TEST(ModelInputs, RefusesWhatItCannotScaleOrDate) {
  const tests::TemporaryFolder folder;
  const std::string relative = made_map(folder / "r", "2014-03-10T06:05:33", "relative"),
                    undated = made_map(folder / "u", ""),
                    dated = made_map(folder / "d", "2014-03-10T06:05:33"),
                    narrow = made_map(folder / "n", "2014-03-10T06:05:33", "absolute", "gaussian");
  const auto refused = [&](sim::ErrorKind kind, const std::vector<std::string>& maps, double factor,
                           std::optional<double> time) {
    return tests::expect_error(kind, [&] { model_inputs(maps, EarthFrame::geographic, 0.1, factor, time); });
  };
  EXPECT_NE(refused(sim::ErrorKind::unreadable_input, {relative}, 0.0, {}).find("--flux-factor"),
            std::string::npos);
  EXPECT_NE(refused(sim::ErrorKind::unreadable_input, {undated}, 0.0, {}).find("--time"), std::string::npos);
  EXPECT_NE(refused(sim::ErrorKind::unreadable_input, {narrow}, 0.0, {}).find("gaussian"), std::string::npos);
  EXPECT_NE(refused(sim::ErrorKind::usage, {dated, dated}, 0.0, {}).find("of the time"), std::string::npos);
  EXPECT_NE(refused(sim::ErrorKind::usage, {dated, undated}, 0.0, 5.0).find("--time"), std::string::npos);
  EXPECT_NE(refused(sim::ErrorKind::usage, {dated}, -1.0, {}).find("--flux-factor"), std::string::npos);
  refused(sim::ErrorKind::unreadable_input, {folder / "nothing"}, 0.0, {});
  const ModelInputs scaled = model_inputs({relative}, EarthFrame::geographic, 0.1, 2.5, {});
  double most = 0.0;
  for (const double q : scaled.maps[0].energy_flux_mw_m2)
    if (std::isfinite(q)) most = std::max(most, q);
  EXPECT_NEAR(most, 10.0, 1e-6);
}

}  // namespace
}  // namespace vegard::fit::model_inputs_test
