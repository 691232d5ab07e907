#include "sim/scene/emission_line.h"

#include <gtest/gtest.h>

#include "sim/scene/emission_lines.h"

namespace vegard::sim {
namespace {

TEST(EmissionLines, AreKnownToTheSceneAndToTheLightAlike) {
  ASSERT_FALSE(known_emission_lines_nm().empty());
  EXPECT_EQ(known_emission_lines_nm().size(), emission_lines().size());
  for (const double wavelength_nm : known_emission_lines_nm()) {
    const EmissionLine* line = find_emission_line(wavelength_nm);
    ASSERT_NE(line, nullptr) << wavelength_nm;
    EXPECT_NEAR(line->wavelength_nm, wavelength_nm, 1e-9);
  }
}

}  // namespace
}  // namespace vegard::sim
