#include "sim/emit/aurora/sheet_brightness.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/render/beams/kernel_scene.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::sheet_brightness_test {
namespace {

TEST(BrightnessClass, IsToldInWordsAboutTheClassesOfTheAtlas) {
  EXPECT_EQ(brightness_class(1.0), "IBC 1");
  EXPECT_EQ(brightness_class(10.5), "IBC 2");
  EXPECT_EQ(brightness_class(24.0), "IBC 2\u20133");
  EXPECT_EQ(brightness_class(95.0), "IBC 3");
  EXPECT_EQ(brightness_class(1000.0), "IBC 4");
  EXPECT_EQ(brightness_class(2000.0), "above IBC 4");
  EXPECT_EQ(brightness_class(0.5), "below IBC 1");
  EXPECT_EQ(brightness_class(0.0), "below IBC 1");
  EXPECT_NEAR(brightness_coefficient(100.0), 3.0, 1e-12);
}

TEST(SheetPower, OfOneMilliwattAtOneKiloelectronvoltIsTheKnownFlux) {
  // 1 mW m^-2 = 1 erg cm^-2 s^-1 = 6.2415e8 keV cm^-2 s^-1; a Maxwellian's mean energy is 2 E0.
  Sheet sheet;
  sheet.energy_kev = 0.5;
  sheet.energy_flux_mw_m2 = 1.0;
  const SheetBrightness brightness = sheet_brightness(tests::with_sheet(sheet), 0);
  ASSERT_TRUE(brightness.power);
  EXPECT_NEAR(brightness.power->mean_energy_kev, 1.0, 1e-12);
  EXPECT_NEAR(brightness.power->electrons_cm2_s, 6.2415e8, 1e4);
}

TEST(SheetPower, IsThatOfAllItsBeams) {
  Scene scene = tests::small_scene();
  scene.sheets[0].arcs = 2;
  const Sheet& sheet = scene.sheets[0];
  double flux_km2_mw_m2 = 0.0;
  for (int arc = 0; arc < sheet.arcs; ++arc) {
    const SheetShape<double> shape = shape_of(scene, 0, arc, 0.0, NoSeeds());
    for (int layer = 0; layer < sheet.layers; ++layer) {
      const LayerPlaces places(sheet, layer_address(0, arc, layer), scene.seed, 0.0);
      std::vector<BeamPlace> some(LayerPlaces::kSumEvery);
      for (int first = 0; first < places.size(); first += LayerPlaces::kSumEvery) {
        const int count = std::min(LayerPlaces::kSumEvery, places.size() - first);
        places.fill(first, count, some.data());
        for (int i = 0; i < count; ++i)
          flux_km2_mw_m2 +=
              beam_foot(shape, stretch_of(sheet, 0.0), some[i], layer, sheet.layers, false).flux_km2_mw_m2;
      }
    }
  }
  const SheetPower power = *sheet_brightness(scene, 0).power;
  EXPECT_NEAR(power.watts / (1e3 * flux_km2_mw_m2), 1.0, 1e-9);
  EXPECT_NEAR(power.watts / (power.watts_per_km * 2.0 * sheet.length_km), 1.0, 1e-12);
}

TEST(SheetPower, OfAGivenBrightnessIsWhatWouldMakeIt) {
  for (const char* profile : {"maxwellian", "form"}) {
    Scene by_flux = tests::small_scene();
    by_flux.sheets[0].profile = tests::kind_named<ProfileKind>(profile);
    const SheetBrightness flux = sheet_brightness(by_flux, 0);
    Scene by_brightness = by_flux;
    by_brightness.sheets[0].brightness_kilorayleigh = flux.layer_green_kilorayleigh;
    by_brightness.sheets[0].energy_flux_mw_m2 = 777.0;
    const SheetBrightness given = sheet_brightness(by_brightness, 0);
    EXPECT_NEAR(given.power->energy_flux_mw_m2 / by_flux.sheets[0].energy_flux_mw_m2, 1.0, 1e-6) << profile;
    EXPECT_NEAR(given.layer_green_kilorayleigh / flux.layer_green_kilorayleigh, 1.0, 1e-6) << profile;
    for (std::size_t l = 0; l < flux.layer_rayleigh.size(); ++l)
      EXPECT_NEAR(given.layer_rayleigh[l] / flux.layer_rayleigh[l], 1.0, 1e-6) << profile;
  }
}

TEST(SheetBrightness, FollowsTheSubstormAndTheExposure) {
  Scene scene = tests::small_scene();
  const SheetBrightness full = sheet_brightness(scene, 0);
  EXPECT_EQ(full.power->joules, 0.0);
  scene.substorm.quiet = 0.2;
  scene.time.start_s = -1e6;  // long before it
  scene.time.exposure_s = 4.0;
  const SheetBrightness quiet = sheet_brightness(scene, 0);
  EXPECT_NEAR(quiet.level, 0.2, 1e-12);
  EXPECT_NEAR(quiet.layer_rayleigh[1] / full.layer_rayleigh[1], 0.2, 1e-9);
  EXPECT_NEAR(quiet.power->joules / (0.2 * full.power->watts * 4.0), 1.0, 1e-12);
}

TEST(SheetBrightness, HasNoPowerWhereNoElectronsAreSaid) {
  Scene scene = tests::small_scene();
  scene.sheets[0].center_km = {0.0, 4500.0};  // below the horizon of everything: no beam falls there
  const SheetBrightness nowhere = sheet_brightness(scene, 0);
  EXPECT_FALSE(nowhere.power);
  EXPECT_EQ(nowhere.layer_green_kilorayleigh, 0.0);
}

}  // namespace
}  // namespace vegard::sim::sheet_brightness_test
