#include "fit/answer/energy_flux.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/view/sensor/expected_counts.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::energy_flux_test {
namespace {

/// The answer has a gain that is `share` of the known one, good to 5 %.
FittedPhoto found_with(const sim::Scene& known, double share) {
  FittedPhoto fitted;
  fitted.best = known;
  fitted.best.sensor.exposure = sim::ExposureRule::gain;
  fitted.best.sensor.gain_per_kilorayleigh = share * known.sensor.gain_per_kilorayleigh;
  fitted.solved = {{"gain", 0.06, 0.003}, {"sky.level.red", 0.1, 0.1}};
  return fitted;
}

TEST(EnergyFlux, IsTheScenesTimesTheGainsShare) {
  sim::Scene known = tests::with_sheet({});
  known.sensor.calibration_error = 0.12;
  std::string why;
  const auto flux = found_flux(known, found_with(known, 0.4), 0, why);
  ASSERT_TRUE(flux && flux->sigma);
  EXPECT_NEAR(flux->mw_m2, 0.4 * known.sheets[0].energy_flux_mw_m2, 1e-12);
  EXPECT_NEAR(*flux->sigma / flux->mw_m2, 0.13, 1e-12);
}

// Modes of the tables move the gains of all bands together, noise each by itself.
TEST(EnergyFlux, AddsUpWhatModesDoToEachBand) {
  sim::Scene known = tests::with_sheet({});
  known.sensor.calibration_error = 0.12;
  FittedPhoto found = found_with(known, 1.0);
  found.solved = {{"gain.band_0", 0.05, 0.003, {0.001, -0.001}},
                  {"gain.band_1", 0.07, 0.004, {0.002, 0.001}},
                  {"sky.level.red", 0.1, 0.1, {0.05, 0.05}}};
  std::string why;
  const auto flux = found_flux(known, found, 0, why);
  ASSERT_TRUE(flux && flux->sigma);
  const double noise = 0.003 * 0.003 - 2e-6 + 0.004 * 0.004 - 5e-6, modes = 0.003 * 0.003 + 0.0;
  EXPECT_NEAR(*flux->sigma / flux->mw_m2, std::hypot(std::sqrt(noise + modes) / 0.12, 0.12), 1e-12);
}

TEST(EnergyFlux, IsMissingWithAReason) {
  sim::Scene known = tests::with_sheet({});
  std::string why;
  EXPECT_FALSE(found_flux(known, found_with(known, 1.0), 0, why));
  EXPECT_NE(why.find("not calibrated"), std::string::npos) << why;
  known.sensor.calibration_error = 0.1;
  known.sheets[0].brightness_kilorayleigh = 10.0;
  EXPECT_FALSE(found_flux(known, found_with(known, 1.0), 0, why));
  EXPECT_NE(why.find("brightness"), std::string::npos) << why;
  known.sheets[0].brightness_kilorayleigh = 0.0;
  known.fit.white_balance_known = false;
  EXPECT_FALSE(found_flux(known, found_with(known, 1.0), 0, why));
  EXPECT_NE(why.find("channel"), std::string::npos) << why;
}

TEST(EnergyFlux, OfACameraByItsDataSheetIsAsUncertainAsThat) {
  sim::Scene known = tests::with_sheet({});
  known.sensor.exposure = sim::ExposureRule::camera;
  known.time.exposure_s = 5.0;
  std::string why;
  const auto flux = found_flux(known, found_with(known, 1.0), 0, why);
  ASSERT_TRUE(flux && flux->sigma) << why;
  EXPECT_NEAR(*flux->sigma / flux->mw_m2, std::hypot(0.05, *sim::expected_counts(known).relative_uncertainty),
              1e-12);
}

TEST(EnergyFlux, OfSeveralPhotographsIsThatOfTheBestCalibrated) {
  sim::Scene rough = tests::with_sheet({}), fine = rough;
  rough.sensor.calibration_error = 0.3;
  fine.sensor.calibration_error = 0.1;
  FitResult result;
  result.best = rough;
  result.photos = {found_with(rough, 1.2), found_with(fine, 1.0), found_with(rough, 1.4)};
  const auto fluxes = energy_fluxes({&rough, &fine, &rough}, result);
  ASSERT_EQ(fluxes.size(), 1u);
  EXPECT_NEAR(fluxes[0].value, fine.sheets[0].energy_flux_mw_m2, 1e-12);
  EXPECT_TRUE(fluxes[0].why_none.empty());
}

TEST(EnergyFlux, ThatWasFreeIsWhatWasFound) {
  FitResult result;
  result.best = tests::with_sheet({});
  FittedParameter flux;
  flux.path = "sheet.main.energy_flux_mw_m2";
  flux.value = 3.25;
  flux.sigma = 0.25;
  result.parameters = {flux};
  const auto fluxes = energy_fluxes({}, result);
  ASSERT_EQ(fluxes.size(), 1u);
  EXPECT_EQ(fluxes[0].value, 3.25);
  EXPECT_EQ(fluxes[0].sigma, 0.25);
}

}  // namespace
}  // namespace vegard::fit::energy_flux_test
