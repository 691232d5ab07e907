#include "sim/render/beams/altitude_slabs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim::altitude_slabs_test {
namespace {

constexpr double kTopKm = 500.0;

std::vector<AltitudeSlab> slabs_of(double nm, double wind_m_s = 0.0, double max_km2 = 1e9) {
  const EmissionLine& line = *find_emission_line(nm);
  return altitude_slabs(spread_profile(line, wind_m_s), spread_profile(line, 0.0), 0.25, max_km2, kTopKm);
}

TEST(AltitudeSlabs, ShareOutAllOfALineAndKeepItsVariance) {
  for (const double nm : {630.0, 557.7, 520.0})
    for (const double wind_m_s : {0.0, 500.0}) {
      const std::vector<AltitudeSlab> slabs = slabs_of(nm, wind_m_s);
      const SpreadProfile spread = spread_profile(*find_emission_line(nm), wind_m_s);
      for (int a = 0; HeightProfile::altitude_km(a) <= kTopKm; ++a) {
        double share = 0.0, variance = 0.0;
        for (const AltitudeSlab& slab : slabs) {
          ASSERT_GE((*slab.share)[a], 0.0f);
          share += (*slab.share)[a];
          variance += (*slab.share)[a] * slab.variance_km2;
        }
        ASSERT_NEAR(share, 1.0, 1e-6) << nm << " at " << HeightProfile::altitude_km(a);
        // Two floats of 2^-24 each, and slabs of one variance that go by altitude.
        ASSERT_NEAR(variance, spread.variance_km2[a], 2e-3 * spread.variance_km2[a] + 1e-6)
            << nm << " at " << HeightProfile::altitude_km(a);
      }
    }
}

TEST(AltitudeSlabs, AreNarrowEnoughToStandForTheirLight) {
  const std::vector<AltitudeSlab> slabs = slabs_of(630.0);
  ASSERT_GT(slabs.size(), 6u);
  EXPECT_EQ(slabs.front().variance_km2, 0.0);
  EXPECT_EQ(slabs.front().lifetime_s, 0.0);
  for (std::size_t s = 2; s < slabs.size(); ++s) {
    // A step of the profile may lead beyond a doubling where the variance grows fastest.
    EXPECT_LE(slabs[s].variance_km2, 2.05 * slabs[s - 1].variance_km2) << s;
    EXPECT_LE(slabs[s].altitude_km, 1.41 * slabs[s - 1].altitude_km) << s;
    EXPECT_GT(slabs[s].altitude_km, slabs[s - 1].altitude_km) << s;
  }
}

TEST(AltitudeSlabs, EndWhereMoreMakesNoDifference) {
  const std::vector<AltitudeSlab> all = slabs_of(630.0), few = slabs_of(630.0, 0.0, 100.0);
  EXPECT_LT(few.size(), all.size());
  EXPECT_EQ(few.back().variance_km2, 100.0);
  EXPECT_EQ(few.back().share->back(), 1.0f);
}

TEST(AltitudeSlabs, TakeOfAProfileWhatIsTheirs) {
  HeightProfile profile = dark_profile(2);
  for (float& rate : profile.rate) rate = 3.0f;
  profile.d_rate_d_ln_energy.assign(profile.rate.size(), 2.0f);
  Emission emission;
  take_altitude_share(emission, profile);
  EXPECT_EQ(profile.rate[0], 3.0f) << "nothing is said";
  emission.altitude_share = {slabs_of(630.0)[1].share, nullptr};
  take_altitude_share(emission, profile);
  const int a = 600;
  const float share = (*emission.altitude_share[0])[a];
  EXPECT_EQ(profile.rate[a * profile.stride], 3.0f * share);
  EXPECT_EQ(profile.d_rate_d_ln_energy[a * profile.stride], 2.0f * share);
  EXPECT_EQ(profile.rate[a * profile.stride + 1], 0.0f);
}

}  // namespace
}  // namespace vegard::sim::altitude_slabs_test
