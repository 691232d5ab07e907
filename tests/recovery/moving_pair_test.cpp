// A sheet that drifts, seen by a camera that was open for 1 s and by another, 100 km away, that was open for
// 20 s from the same instant on: fitted as each saw it, and as if both had seen one instant.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "fit/fit.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::moving_pair_test {
namespace {

constexpr double kDrift_km_s = 0.6, kTruth_km = 180.0, kPeak_km = 112.0;
constexpr int kInstants = 8;

/// The entry's picture is the mean over this many seconds from the instant 0 on. An instant stands for the
/// eighth of the exposure of which it is the middle.
void expose(sim::PhotoEntry& entry, double seconds) {
  entry.set.emplace_back("time.exposure_s", std::to_string(seconds));
  entry.set.emplace_back("time.instants", std::to_string(kInstants));
  entry.set.emplace_back("time.start_s", std::to_string(0.5 * seconds / kInstants));
}

sim::Scene still_pair() {
  sim::Scene scene = tests::two_stations();
  scene.sheets[0].layers = 1;
  scene.sheets[0].beams = 3000;
  scene.sheets[0].ray_contrast = 0.0;
  return scene;
}

sim::Scene moving_pair() {
  sim::Scene scene = still_pair();
  scene.sheets[0].drift_km_s = {0.0, kDrift_km_s};
  expose(scene.fit.photos[0], 1.0);
  expose(scene.fit.photos[1], 20.0);
  return scene;
}

/// The same model with other beams, from a wrong place; its light is of known form if `free` says so.
sim::Scene start_of(sim::Scene scene, std::initializer_list<const char*> free_keys) {
  scene.seed += 1;
  scene.sheets[0].beams = 500;
  scene.sheets[0].center_km.north *= 1.05;
  for (const char* key : free_keys) {
    sim::FreeParameter free;
    free.path = "sheet.main." + std::string(key);
    scene.fit.free.push_back(free);
  }
  return scene;
}

double value_of(const FitResult& result, const std::string& key) {
  for (const FittedParameter& parameter : result.parameters)
    if (parameter.path == "sheet.main." + key) return parameter.value;
  ADD_FAILURE() << "no " << key;
  return 0.0;
}

double sigma_of(const FitResult& result, const std::string& key) {
  for (const FittedParameter& parameter : result.parameters)
    if (parameter.path == "sheet.main." + key) return parameter.sigma.value_or(0.0);
  return 0.0;
}

// The long exposure's light is, in the mean, 6 km farther than that of the short one, and 12 km wide.
TEST(MovingPair, IsFoundAsEachCameraSawIt) {
  const std::vector<Photo> photos = tests::photos_of(moving_pair(), 0.002);
  const auto fitted = [&](const char* name, const sim::Scene& scene) {
    sim::Scene start = start_of(scene, {"center_km.north", "bearing_deg", "peak_km"});
    start.sheets[0].peak_km += 4.0;
    const FitResult fit = fit_photos(start, photos, {});
    std::printf("%s: north %.2f ± %.2f km, peak %.2f ± %.2f km, chi2 %.0f\n", name,
                value_of(fit, "center_km.north"), sigma_of(fit, "center_km.north"), value_of(fit, "peak_km"),
                sigma_of(fit, "peak_km"), fit.chi2);
    return fit;
  };
  const FitResult found = fitted("as seen", moving_pair());
  EXPECT_NEAR(value_of(found, "center_km.north"), kTruth_km, 1.0);
  EXPECT_NEAR(value_of(found, "peak_km"), kPeak_km, 1.0);
  const FitResult at_once = fitted("at once", still_pair());
  EXPECT_GT(std::abs(value_of(at_once, "center_km.north") - kTruth_km), 3.0);
  EXPECT_GT(std::abs(value_of(at_once, "peak_km") - kPeak_km), 3.0);
  sim::Scene at_middles = moving_pair();
  for (sim::PhotoEntry& entry : at_middles.fit.photos) entry.set.emplace_back("time.instants", "1");
  at_middles.fit.photos[0].set.emplace_back("time.start_s", "0.5");
  at_middles.fit.photos[1].set.emplace_back("time.start_s", "10.0");
  const FitResult unsmeared = fitted("at the middles", at_middles);
  EXPECT_GT(unsmeared.chi2, 1.2 * found.chi2);
}

TEST(MovingPair, TellsTheDriftOfLightOfKnownHeight) {
  const std::vector<Photo> photos = tests::photos_of(moving_pair(), 0.002);
  sim::Scene start = start_of(moving_pair(), {"center_km.north", "drift_km_s.north"});
  start.sheets[0].drift_km_s.north = 0.1;
  const FitResult found = fit_photos(start, photos, {});
  std::printf("drift %.3f +- %.3f km/s\n", value_of(found, "drift_km_s.north"),
              sigma_of(found, "drift_km_s.north"));
  EXPECT_NEAR(value_of(found, "drift_km_s.north"), kDrift_km_s, 0.1);
}

}  // namespace
}  // namespace vegard::fit::moving_pair_test
