// Fits through a fisheye, of pictures that the simulator itself renders with other beams.
#include <gtest/gtest.h>

#include "fit/fit.h"
#include "tests/support/free_paths.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::fisheye_fit_test {
namespace {

/// A band 190 km to the north, seen by an all-sky camera.
sim::Scene all_sky() {
  sim::Scene scene = tests::small_scene();
  sim::Camera& camera = scene.camera;
  camera.model = sim::LensModel::equisolid;
  camera.width = 200;
  camera.height = 200;
  camera.focal_px = 70.0;
  camera.azimuth_deg = 180.0;  // north at the top, east at the left
  camera.elevation_deg = 88.0;
  camera.roll_deg = 1.0;
  camera.principal_x_px = 2.0;
  scene.sheets[0].beams = 1500;
  scene.sheets[0].energy_kev = 4.0;
  scene.sheets[0].length_km = 600.0;
  scene.sky.level = {0.002, 0.003, 0.004};
  scene.fit.roi_px = {60, 8, 80, 62};
  scene.fit.bands = 4;
  scene.fit.sky_terms = 1;
  scene.fit.scan_points = 0;
  return scene;
}

TEST(FisheyeFit, FindsDistanceAndEnergyOfABandInTheAllSkyPicture) {
  const sim::Scene truth = all_sky();
  sim::Scene scene = truth;
  scene.seed = 99;
  scene.fit.free = {tests::free_entry("sheet.main.center_km.north"),
                    tests::free_entry("sheet.main.energy_kev")};
  scene.fit.free[0].start = 230.0;
  scene.fit.free[1].start = 6.0;
  const FitResult result = fit_photo(scene, tests::linear_photo(truth), {});
  ASSERT_EQ(result.parameters.size(), 2u);
  // Other beams, and cells wider than the picture's pixels: 1 %, as elsewhere (tests/fit/tied_fit_test.cpp).
  EXPECT_NEAR(result.parameters[0].value, truth.sheets[0].center_km.north, 2.0);
  EXPECT_NEAR(result.parameters[1].value, 4.0, 0.04);
}

TEST(FisheyeFit, FindsTheTiltAndTheScaleOfTheLensWhereTheBandIsKnown) {
  // Of 1500 beams the draws of five seeds are told apart by 0.06 degrees and 0.06 px (standard deviation).
  sim::Scene truth = all_sky();
  truth.sheets[0].beams = 40000;
  sim::Scene scene = truth;
  scene.seed = 99;
  scene.fit.free = {tests::free_entry("camera.elevation_deg"), tests::free_entry("camera.focal_px")};
  // From above, (87, 71), the search meets the bound of 90 degrees in the valley along which the two trade off, and
  // the verdict says that chi2 still falls.
  scene.fit.free[0].start = 86.5;
  scene.fit.free[0].min = 80.0;
  scene.fit.free[0].max = 90.0;
  scene.fit.free[1].start = 69.0;
  scene.fit.free[1].min = 60.0;
  scene.fit.free[1].max = 80.0;
  const FitResult result = fit_photo(scene, tests::linear_photo(truth), {});
  ASSERT_EQ(result.parameters.size(), 2u);
  // A tenth of a pixel, at 1.2 px to a degree and 80 px from the axis.
  EXPECT_NEAR(result.parameters[0].value, 88.0, 0.1);
  EXPECT_NEAR(result.parameters[1].value, 70.0, 0.1);
}

}  // namespace
}  // namespace vegard::fit::fisheye_fit_test
