#include "sim/light/chemistry/table_maker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"

namespace vegard::sim::table_maker_test {
namespace {

TableRequest quick_request() {
  TableRequest request;
  request.refinement = 0.25;
  request.oxygen_factors = {1.0};
  request.maxwellian_kev = {0.5, 2.0};
  request.mono_kev.clear();
  for (double energy = 0.1; energy < 40.0; energy *= 1.35) request.mono_kev.push_back(energy);
  return request;
}

const MadeTables& quick_tables() {
  static const MadeTables tables = make_tables(quick_request(), 2);
  return tables;
}

TEST(TableMaker, WritesEveryEnergyAndAltitude) {
  const CsvTable maxwellian = read_csv_table(quick_tables().at("ver_maxwellian.csv"), "ver_maxwellian.csv");
  const std::size_t altitudes = made_altitudes_km().size();
  EXPECT_EQ(maxwellian.rows(), altitudes * quick_request().maxwellian_kev.size());
  EXPECT_EQ(read_csv_table(quick_tables().at("ver_mono.csv"), "ver_mono.csv").rows(),
            altitudes * quick_request().mono_kev.size());
  EXPECT_DOUBLE_EQ(maxwellian.column("altitude_km").front(), 80.0);
  EXPECT_DOUBLE_EQ(maxwellian.column("altitude_km").back(), 640.0);
  EXPECT_DOUBLE_EQ(usual_maxwellian_kev().front(), 0.1);
  EXPECT_DOUBLE_EQ(usual_maxwellian_kev().back(), 20.0);
  for (const char* line : {"ver_3371", "ver_4278", "ver_5200", "ver_5577", "ver_6300", "ver_6705", "ver_7774",
                           "ver_8446", "ionisation_electron"})
    EXPECT_TRUE(maxwellian.has(line)) << line;
}

// The columns of their file are the integrals of the rates: of 427.8 nm, whose altitudes are fine enough for
// it.
TEST(TableMaker, ColumnsAreTheIntegralsOfTheRates) {
  const CsvTable rates = read_csv_table(quick_tables().at("ver_maxwellian.csv"), "ver_maxwellian.csv");
  const CsvTable columns =
      read_csv_table(quick_tables().at("column_brightness.csv"), "column_brightness.csv");
  const std::vector<double>&blue = rates.column("ver_4278"), &altitude = rates.column("altitude_km");
  const std::size_t altitudes = made_altitudes_km().size();
  for (std::size_t e = 0; e < columns.rows(); ++e) {
    double sum = 0.0;
    for (std::size_t a = e * altitudes; a + 1 < (e + 1) * altitudes; ++a)
      if (blue[a] > 0.0 && blue[a + 1] > 0.0)
        sum += 0.1 * (altitude[a + 1] - altitude[a]) * 0.5 * (blue[a] + blue[a + 1]);
    EXPECT_NEAR(sum / columns.column("R_4278")[e], 1.0, 0.01) << columns.column("E0_keV")[e];
  }
}

// A Maxwellian is a sum of single energies, and prompt light is a sum of theirs: phi(E) E dE in steps of ln
// E.
TEST(TableMaker, SingleEnergiesMakeAMaxwellian) {
  const CsvTable mono = read_csv_table(quick_tables().at("ver_mono.csv"), "ver_mono.csv");
  const CsvTable maxwellian = read_csv_table(quick_tables().at("ver_maxwellian.csv"), "ver_maxwellian.csv");
  const std::vector<double> energies = quick_request().mono_kev, e0s = quick_request().maxwellian_kev;
  const std::size_t altitudes = made_altitudes_km().size();
  const std::vector<double>& single = mono.column("ver_4278");
  for (const std::size_t e : {0u, 1u}) {
    double weights = 0.0, sum = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < energies.size(); ++i) {
      const double weight = std::pow(energies[i], 3) * std::exp(-energies[i] / e0s[e]);
      weights += weight;
      for (std::size_t a = 0; a + 1 < altitudes; ++a)
        sum += weight * single[i * altitudes + a] * (made_altitudes_km()[a + 1] - made_altitudes_km()[a]);
    }
    for (std::size_t a = 0; a + 1 < altitudes; ++a)
      whole += maxwellian.column("ver_4278")[e * altitudes + a] *
               (made_altitudes_km()[a + 1] - made_altitudes_km()[a]);
    // The coarse grid of this test errs by a per cent in energy for each of the two.
    EXPECT_NEAR(sum / weights / whole, 1.0, 0.03) << e0s[e];
  }
}

TEST(TableMaker, TakesEveryNumberOfThreadsAlike) {
  EXPECT_EQ(make_tables(quick_request(), 1), quick_tables());
}

TEST(TableMaker, RefusesAirThatEndsTooLow) {
  TableRequest request = quick_request();
  request.air_file = "mine.csv";
  while (request.air.altitude_km.back() > 500.0) {
    request.air.altitude_km.pop_back();
    request.air.temperature_k.pop_back();
    for (auto& gas : request.air.density_cm3) gas.pop_back();
  }
  try {
    make_tables(request, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("mine.csv"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("640 km"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vegard::sim::table_maker_test
