#include "fit/answer/derived.h"
#include "tests/support/expect_error.h"
#include "tests/support/free_paths.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>

namespace vegard::fit::derived_test {
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

TEST(NearestDistance, FollowsTheDriftAndTakesTheNearestArc) {
  sim::Sheet sheet;
  sheet.center_km = {0.0, 300.0};
  sheet.bearing_deg = 90.0;
  sheet.drift_km_s = {0.0, -2.5};
  EXPECT_NEAR(nearest_distance_km(sheet, 40.0), 200.0, 1e-9);
  sheet.arcs = 4;
  sheet.arc_spacing_km = 30.0;
  EXPECT_NEAR(nearest_distance_km(sheet, 40.0), 155.0, 1e-9);
  sheet.bearing_deg = 270.0;  // the same arcs from the other end
  EXPECT_NEAR(nearest_distance_km(sheet, 40.0), 155.0, 1e-9);
}

TEST(Altitudes, ArePlacedAsTheSourcesHaveThem) {
  // GLOW's 557.7 peaks at 126, 109 and 101 km for E0 = 1, 3 and 10 keV (data/glow/ver_maxwellian.csv).
  sim::Sheet sheet;
  const auto scene = [&] {
    sim::Scene one = tests::with_sheet(sheet);
    one.emission.tables = "glow";
    return one;
  };
  for (const auto& [energy, peak] : {std::pair{1.0, 126.0}, std::pair{3.0, 109.0}, std::pair{10.0, 101.0}}) {
    sheet.energy_kev = energy;
    EXPECT_NEAR(peak_altitude_km(557.7, scene(), 0), peak, 1.0);
    EXPECT_LT(lower_border_km(557.7, scene(), 0), peak_altitude_km(557.7, scene(), 0));
  }
}

TEST(Altitudes, AreThoseOfAFormWhereTheSheetHasOne) {
  // 557.7 nm makes up nearly all of the total between 110 and 125 km at 3 keV, so it follows the curve.
  sim::Sheet sheet;
  sheet.profile = sim::ProfileKind::form;
  sheet.peak_km = 118.0;
  sheet.lower_km = 5.0;
  EXPECT_NEAR(peak_altitude_km(557.7, tests::with_sheet(sheet), 0), 118.0, 0.5);
  EXPECT_NEAR(lower_border_km(557.7, tests::with_sheet(sheet), 0), 113.0, 0.5);
}

TEST(BoundarySeparation, IsTwiceTheAmplitudeTimesTheSineOfHalfTheShift) {
  // The source paper's largest shift, 0.35 pi: 1.045 w.
  sim::Sheet sheet;
  sheet.thickness_km = 4.0;
  sheet.phase_shift_rad = 0.35 * std::acos(-1.0);
  EXPECT_NEAR(boundary_separation_km(sheet), 4.0 * 1.045, 2e-3);
  sheet.phase_shift_rad *= -1.0;
  EXPECT_NEAR(boundary_separation_km(sheet), 4.0 * 1.045, 2e-3);
  sheet.phase_shift_rad = 0.0;
  EXPECT_EQ(boundary_separation_km(sheet), 0.0);
}

TEST(UnusualSheets, AreThoseOutsideOfTheRangeThatNaturePrefers) {
  sim::Scene scene;
  scene.sheets.resize(1);
  sim::Sheet& sheet = scene.sheets[0];
  sheet.thickness_km = 2.0;
  for (const auto& [wavelength_km, is_unusual] :
       {std::pair{20.7, true}, std::pair{20.9, false}, std::pair{125.5, false}, std::pair{125.7, true}}) {
    sheet.wavelength_km = wavelength_km;
    EXPECT_EQ(unusual_sheets(scene).size(), is_unusual ? 1u : 0u) << wavelength_km;
  }
  EXPECT_TRUE(tests::has_facts(unusual_sheets(scene).at(0), "main sheet | 31.4")) << unusual_sheets(scene)[0];
}

TEST(DerivedNumbers, TellTheShapeWithItsErrorAndNoBoundariesOfOneLayer) {
  sim::Scene scene;
  scene.sheets.resize(2);
  scene.sheets[1].name = "thin";
  scene.sheets[1].layers = 1;
  scene.fit.free = {tests::free_entry("sheet.main.thickness_km")};
  const std::vector<DerivedNumber> derived =
      derived_numbers(scene, free_numbers(scene), {3.0}, {{{0.04}}, {}});
  int boundaries = 0;
  for (const DerivedNumber& d : derived) {
    if (d.name.find("between the boundaries") == std::string::npos) continue;
    ++boundaries;
    EXPECT_NEAR(d.value, 6.0 * std::sin(0.25), 1e-12);
    ASSERT_TRUE(d.sigma.has_value());
    EXPECT_NEAR(*d.sigma, 2.0 * std::sin(0.25) * 0.2, 1e-4);
  }
  EXPECT_EQ(boundaries, 1);
}

TEST(DerivedNumbers, CarryErrorsAlongAndNoneAcrossWhatIsUndetermined) {
  sim::Scene scene;
  scene.sheets.resize(1);
  scene.sheets[0].center_km = {0.0, 200.0};
  scene.sheets[0].bearing_deg = 90.0;
  scene.fit.free = {tests::free_entry("sheet.main.center_km")};
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

TEST(DerivedNumbers, HaveTheAzimuthOfTheNearestPointAndWhatItDependsOn) {
  // A sheet that runs at right angles to the line from the observer, 200 km away, a hair west of north: its
  // middle is the nearest point, and where it stands along itself turns that by nothing.
  sim::Scene scene;
  scene.sheets.resize(1);
  scene.sheets[0].center_km = {-0.001, 200.0};
  scene.sheets[0].bearing_deg = 90.0;
  scene.sheets[0].length_km = 400.0;
  scene.fit.free = {tests::free_entry("sheet.main.bearing_deg"), tests::free_entry("sheet.main.energy_kev")};
  const std::vector<DerivedNumber> derived = derived_numbers(
      scene, free_numbers(scene), {90.0, scene.sheets[0].energy_kev}, {{{4.0, 0.0}, {0.0, 0.01}}, {}});
  const DerivedNumber& azimuth = derived.at(1);
  EXPECT_EQ(azimuth.name.rfind("azimuth of the nearest point", 0), 0u);
  // The foot of the perpendicular lies where the bearing less a right angle points.
  EXPECT_NEAR(std::remainder(azimuth.value, 360.0), 0.0, 1e-6);
  ASSERT_TRUE(azimuth.sigma.has_value());
  EXPECT_NEAR(*azimuth.sigma, 2.0, 1e-3);
  EXPECT_EQ(azimuth.depends_on, std::vector<std::string>{"sheet.main.bearing_deg"});
}

TEST(DerivedNumbers, HaveTheMeanEnergyOfTheSpectrumThatTheSheetHas) {
  sim::Scene scene;
  scene.sheets.resize(1);
  scene.fit.free = {tests::free_entry("sheet.main.energy_kev")};
  const auto mean = [&](const std::string& profile) -> std::optional<DerivedNumber> {
    scene.sheets[0].profile = tests::kind_named<sim::ProfileKind>(profile);
    for (const DerivedNumber& d : derived_numbers(scene, free_numbers(scene), {3.0}, {{{0.04}}, {}}))
      if (d.name == "mean electron energy of the main sheet") return d;
    return std::nullopt;
  };
  EXPECT_NEAR(mean("maxwellian")->value, 6.0, 1e-12);
  EXPECT_NEAR(mean("mono")->value, 3.0, 1e-12);
  EXPECT_NEAR(mean("mono")->sigma.value(), 0.2, 1e-6);
  EXPECT_NEAR(mean("gaussian")->value, 3.0, 1e-5);
}

}  // namespace
}  // namespace vegard::fit::derived_test
