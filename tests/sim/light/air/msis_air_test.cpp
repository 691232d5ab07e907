#include "sim/light/air/msis_air.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/error.h"
#include "sim/base/utc_time.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::msis_air_test {
namespace {

AirConditions poker_flat() {
  AirConditions conditions;
  conditions.utc_s = utc_seconds("2014-03-10T06:05:33Z").value();
  conditions.latitude_deg = 65.0;
  conditions.longitude_deg = -148.0;
  conditions.f107 = 150.0;
  conditions.f107a = 140.0;
  conditions.ap = 20.0;
  return conditions;
}

TEST(MsisAir, KnowsTheDayAndTheLocalTime) {
  const MsisDrivers drivers = msis_drivers(poker_flat());
  EXPECT_EQ(drivers.day_of_year, 69.0);
  EXPECT_EQ(drivers.ut_s, 6.0 * 3600.0 + 5.0 * 60.0 + 33.0);
  EXPECT_NEAR(drivers.local_time_h, 24.0 + drivers.ut_s / 3600.0 - 148.0 / 15.0, 1e-12);
  AirConditions leap = poker_flat();
  leap.utc_s = utc_seconds("2016-12-31T23:59:59Z").value();
  EXPECT_EQ(msis_drivers(leap).day_of_year, 366.0);
  leap.utc_s += 1.0;
  EXPECT_EQ(msis_drivers(leap).day_of_year, 1.0);
  EXPECT_EQ(msis_drivers(leap).ut_s, 0.0);
  EXPECT_TRUE(tests::has_facts(condition_words(poker_flat()),
                               "2014-03-10T06:05:33Z | 65 N 148 W | 20:14 | F10.7 150 | mean 140 | Ap 20"));
}

TEST(MsisAir, IsTheSameForAllNamesOfALongitude) {
  AirConditions east = poker_flat();
  east.longitude_deg = 212.0;
  EXPECT_EQ(condition_words(east), condition_words(poker_flat()));
  const AirTable a = msis_air(poker_flat()), b = msis_air(east);
  for (std::size_t r = 0; r < a.altitude_km.size(); ++r)
    // The model's degrees are rounded in the sixth digit: a turn is none by 3e-6.
    EXPECT_NEAR(b.density_cm3[2][r] / a.density_cm3[2][r], 1.0, 1e-5) << a.altitude_km[r];
}

TEST(MsisAir, IsReadBetweenItsRowsAsTheModelHasIt) {
  const AirTable table = msis_air(poker_flat());
  EXPECT_EQ(table.altitude_km.front(), kAirBottomKm);
  EXPECT_EQ(table.altitude_km.back(), kAirTopKm);
  const MsisModel model(msis_drivers(poker_flat()));
  for (std::size_t r = 1; r < table.altitude_km.size(); ++r) {
    EXPECT_GT(table.altitude_km[r], table.altitude_km[r - 1]);
    const double between = 0.5 * (table.altitude_km[r - 1] + table.altitude_km[r]);
    if (std::abs(between - 123.5) < 0.1 || between < 90.0) continue;  // the model's jump; O is thin below
    const MsisAir air = model.at(between);
    const std::array<double, kGases> ours = {air.of(MsisGas::n2), air.of(MsisGas::o2), air.of(MsisGas::o)};
    for (std::size_t g = 0; g < kGases; ++g) {
      const double line = std::sqrt(table.density_cm3[g][r - 1] * table.density_cm3[g][r]);
      EXPECT_NEAR(line / ours[g], 1.0, between < 100.0 ? 1e-2 : 2e-3) << between << " km, gas " << g;
    }
  }
}

TEST(MsisAir, OfAnyBottomAndTopHasBothOnce) {
  const std::vector<double> altitudes = air_altitudes(72.5, 149.2);
  EXPECT_EQ(altitudes.front(), 72.5);
  EXPECT_EQ(altitudes[1], 73.0);
  EXPECT_EQ(altitudes.back(), 149.2);
  EXPECT_EQ(altitudes[altitudes.size() - 2], 149.0);
  EXPECT_EQ(air_altitudes(80.0, 81.0).size(), 2u);
}

/// Seasons and activity as textbooks have them: hot and wide at the maximum, cold mesopause in summer.
TEST(MsisAir, OfItsNamesHasTheSeasonsAndTheActivity) {
  EXPECT_EQ(air_names().size(), 6u);
  for (const std::string& name : air_names()) EXPECT_TRUE(named_air(name)) << name;
  EXPECT_FALSE(named_air("autumn"));
  for (const NamedConditions& named : named_conditions())
    EXPECT_NEAR(std::remainder(msis_drivers(named.conditions).local_time_h, 24.0), 0.0, 1e-9) << named.name;
  const auto coldest = [](const AirTable& air) {
    return *std::min_element(air.temperature_k.begin(), air.temperature_k.end());
  };
  const AirTable quiet = *named_air("winter_quiet"), active = *named_air("winter_active"),
                 summer = *named_air("summer_quiet");
  EXPECT_GT(active.temperature_k.back(), quiet.temperature_k.back() + 300.0);
  EXPECT_GT(active.density_cm3[2].back(), 10.0 * quiet.density_cm3[2].back());
  EXPECT_LT(coldest(summer), coldest(quiet) - 20.0);
}

/// Whatever the command takes, the air is one that electrons can go through.
TEST(MsisAir, IsSoundAtTheEndsOfAllConditions) {
  int refused = 0;
  for (const double latitude : {-90.0, 0.0, 65.0, 77.0})
    for (const double f107 : {50.0, 400.0})
      for (const double f107a : {50.0, 250.0})
        for (const double ap : {0.0, 100.0, 400.0})
          for (const char* time : {"2001-01-01T00:00:00Z", "2004-06-30T12:00:00Z"})
            for (const bool history : {false, true}) {
              AirConditions conditions;
              conditions.utc_s = utc_seconds(time).value();
              conditions.latitude_deg = latitude;
              conditions.longitude_deg = 130.0;
              conditions.f107 = f107;
              conditions.f107a = f107a;
              conditions.ap = ap;
              if (history) conditions.ap_history = std::array<double, 7>{ap, ap, ap, ap, ap, ap, ap};
              if (!MsisModel(msis_drivers(conditions)).sound()) {
                EXPECT_GT(ap, 100.0) << condition_words(conditions);
                EXPECT_THROW(msis_air(conditions), Error);
                ++refused;
                continue;
              }
              const AirTable air = msis_air(conditions, kMsisBottomKm, kMsisTopKm);
              for (std::size_t r = 0; r < air.altitude_km.size(); ++r) {
                ASSERT_GT(air.temperature_k[r], 50.0) << condition_words(conditions);
                ASSERT_LT(air.temperature_k[r], 6000.0) << condition_words(conditions);
                for (std::size_t g = 0; g < kGases; ++g)
                  ASSERT_TRUE(std::isfinite(air.density_cm3[g][r]) && air.density_cm3[g][r] > 0.0)
                      << condition_words(conditions) << ", " << air.altitude_km[r] << " km";
              }
            }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace vegard::sim::msis_air_test
