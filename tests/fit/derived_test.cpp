#include "fit/derived.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace vegard::fit {
namespace {

TEST(NearestDistance, IsThePerpendicularOrAnEnd) {
  sim::Sheet sheet;
  sheet.center_km = {50.0, 200.0};
  sheet.bearing_deg = 90.0;
  sheet.length_km = 300.0;
  EXPECT_NEAR(nearest_distance_km(sheet), 200.0, 1e-9);
  sheet.center_km.east = 250.0;  // it starts 100 km to the east
  EXPECT_NEAR(nearest_distance_km(sheet), std::hypot(100.0, 200.0), 1e-9);
}

TEST(Altitudes, ArePlacedAsTheSourcesHaveThem) {
  // docs/physics.md: 557.7 peaks at 126, 109 and 101 km for E0 = 1, 3 and 10 keV.
  sim::Sheet sheet;
  for (const auto& [energy, peak] : {std::pair{1.0, 126.0}, std::pair{3.0, 109.0}, std::pair{10.0, 101.0}}) {
    sheet.energy_kev = energy;
    EXPECT_NEAR(peak_altitude_km(557.7, sheet), peak, 1.0);
    EXPECT_LT(lower_border_km(557.7, sheet), peak_altitude_km(557.7, sheet));
  }
}

TEST(Altitudes, AreThoseOfAFormWhereTheSheetHasOne) {
  // 557.7 nm makes up nearly all of the total between 110 and 125 km at 3 keV, so it follows the curve.
  sim::Sheet sheet;
  sheet.profile = "form";
  sheet.peak_km = 118.0;
  sheet.lower_km = 5.0;
  EXPECT_NEAR(peak_altitude_km(557.7, sheet), 118.0, 0.5);
  EXPECT_NEAR(lower_border_km(557.7, sheet), 113.0, 0.5);
}

TEST(DerivedNumbers, CarryErrorsAlongAndNoneAcrossWhatIsUndetermined) {
  sim::Scene scene;
  scene.sheets.resize(1);
  scene.sheets[0].center_km = {0.0, 200.0};
  scene.sheets[0].bearing_deg = 90.0;
  scene.fit.free = {{"sheet.main.center_km", {}, {}, {}, {}, 0}};
  const std::vector<FreeNumber> free = free_numbers(scene);
  // East is undetermined, north known to 2 km: the distance of a sheet that runs east is known all the same.
  ValueUncertainty known{{{0.0, 0.0}, {0.0, 4.0}}, {{1.0, 0.0}}};
  std::vector<DerivedNumber> derived = derived_numbers(scene, free, {0.0, 200.0}, known);
  ASSERT_TRUE(derived[0].sigma.has_value());
  EXPECT_NEAR(*derived[0].sigma, 2.0, 1e-3);
  known.undetermined = {{0.0, 1.0}};
  derived = derived_numbers(scene, free, {0.0, 200.0}, known);
  EXPECT_FALSE(derived[0].sigma.has_value());
}

}  // namespace
}  // namespace vegard::fit
