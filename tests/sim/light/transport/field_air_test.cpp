#include "sim/light/transport/field_air.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/base/error.h"
#include "sim/light/atmosphere.h"

namespace vegard::sim::field_air_test {
namespace {

std::string refusal(const std::string& text) {
  try {
    read_air_table(text, "air.csv");
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(FieldAir, IsTheStandardAtmosphere) {
  const FieldAir column = field_air(standard_air_table(), 90.0);
  EXPECT_EQ(column.altitude_km.front(), 80.0);
  EXPECT_EQ(column.altitude_km.back(), 640.0);
  for (std::size_t m = 0; m < column.size(); m += 20) {
    const Air air = standard_air(column.altitude_km[m]);
    EXPECT_NEAR(column.density_cm3[0][m] / air.n2_cm3, 1.0, 0.02) << column.altitude_km[m];
    EXPECT_NEAR(column.density_cm3[2][m] / air.o_cm3, 1.0, 0.02) << column.altitude_km[m];
  }
}

TEST(FieldAir, IsLongerAlongALeaningField) {
  const AirTable table = standard_air_table();
  const FieldAir upright = field_air(table, 90.0), leaning = field_air(table, 30.0);
  EXPECT_NEAR(leaning.path_cm.back(), 2.0 * upright.path_cm.back(), 1e-3);
}

TEST(AirTable, IsReadAndRefused) {
  const std::string head = "altitude_km,T_K,nN2,nO2,nO\n";
  const std::string bottom = "90,190,4e13,1e13,2e11\n", top = "400,1000,4e6,1e5,1e8\n";
  EXPECT_EQ(read_air_table(head + bottom + top, "air.csv").altitude_km.size(), 2u);
  EXPECT_NE(refusal("altitude_km,T_K,nN2,nO2\n90,190,1,1\n400,1000,1,1\n").find("nO"), std::string::npos);
  EXPECT_NE(refusal(head + top + bottom).find("air.csv:3"), std::string::npos);
  EXPECT_NE(refusal(head + bottom + "400,1000,-4e6,1e5,1e8\n").find("air.csv:3"), std::string::npos);
  EXPECT_NE(refusal(head + bottom + "400,0,4e6,1e5,1e8\n").find("air.csv:3"), std::string::npos);
  EXPECT_NE(refusal(head + bottom + "200,1000,4e6,1e5,1e8\n").find("300 km"), std::string::npos);
  EXPECT_NE(refusal(head + bottom + "400,1000,0,0,0\n").find("no air"), std::string::npos);
}

}  // namespace
}  // namespace vegard::sim::field_air_test
