#include "sim/render/emitters/footprint_volumes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/render/beams/beams.h"
#include "sim/view/colour/line_colours.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::footprint_profiles_test {
namespace {

/// What the sensor makes of a row of a profile.
Vector3 colour_at(const Scene& scene, const HeightProfile& profile, double altitude_km) {
  const std::size_t row =
      static_cast<std::size_t>((altitude_km - HeightProfile::kBottomKm) / HeightProfile::kStepKm) *
      profile.stride;
  const std::vector<Vector3> of_line = line_colours(scene);
  Vector3 sum{};
  for (int l = 0; l < profile.lines; ++l)
    for (int c = 0; c < 3; ++c) sum[c] += profile.rate[row + l] * of_line[l][c];
  return sum;
}

TEST(FootprintProfiles, OfColoursInsideTheLinesTriangleHaveThemExactly) {
  Scene scene;
  Footprint f;
  f.light = FootprintLight::colours;
  // Of light that the lines can make: sums of their own colours.
  const std::vector<Vector3> of_line = line_colours_at_unit_gain(scene);
  for (int c = 0; c < 3; ++c) {
    f.low_colour[c] = 0.1 * of_line[0][c] + 0.8 * of_line[1][c] + 0.3 * of_line[2][c];
    f.high_colour[c] = 0.7 * of_line[0][c] + 0.1 * of_line[1][c] + 0.4 * of_line[2][c];
  }
  scene.footprints = {f};
  const ProfileTable table = footprint_profiles(scene, scene.footprints[0], 0.0, 0.0);
  ASSERT_EQ(table.of_energy.size(), 1u);
  for (const double altitude : {100.0, 110.0, 165.0, 220.0, 280.0}) {
    const double high = std::min(std::max((altitude - 110.0) / 110.0, 0.0), 1.0);
    const Vector3 seen = colour_at(scene, table.of_energy[0], altitude);
    Vector3 wanted{};
    double seen_size = 0.0, wanted_size = 0.0;
    for (int c = 0; c < 3; ++c) {
      wanted[c] = (1.0 - high) * f.low_colour[c] + high * f.high_colour[c];
      seen_size += std::abs(seen[c]);
      wanted_size += std::abs(wanted[c]);
    }
    ASSERT_GT(seen_size, 0.0);
    // Rates are floats.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / seen_size, wanted[c] / wanted_size, 1e-6) << altitude;
  }
}

TEST(FootprintProfiles, OfLinesAreTheTable) {
  Scene scene;
  scene.footprints.emplace_back();
  const ProfileTable own = footprint_profiles(scene, scene.footprints[0], 0.0, 0.1),
                     table = profile_table(scene.emission.lines, scene, scene.footprints[0], 0.0, 0.1);
  ASSERT_EQ(own.of_energy.size(), table.of_energy.size());
  for (std::size_t i = 0; i < own.of_energy.size(); ++i)
    EXPECT_EQ(own.of_energy[i].rate, table.of_energy[i].rate);
}

TEST(BeamLayout, HasNoBeamsWhereAFootprintStandsForTheSheets) {
  Scene scene = tests::small_scene();
  EXPECT_FALSE(BeamLayout(scene, 0.0).chunks().empty());
  scene.footprints.emplace_back();
  EXPECT_FALSE(BeamLayout(scene, 0.0).chunks().empty());
  scene.footprints[0].source = FootprintSource::sheets;
  EXPECT_TRUE(BeamLayout(scene, 0.0).chunks().empty());
}

}  // namespace
}  // namespace vegard::sim::footprint_profiles_test
