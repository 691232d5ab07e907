#include "sim/scene/structs/scene.h"
#include "sim/view/colour/sensor_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/sensor.h"

namespace vegard::sim::spectral_resolution_test {
namespace {

Scene with_table(const std::string& rows) {
  Scene scene;
  scene.sensor.response = "own.csv";
  scene.sensor.response_per = ResponsePer::photon;
  scene.tables["sensor.response"] = "wavelength_nm,red,green,blue\n" + rows;
  return scene;
}

TEST(ResolvingKernel, OfThreeBoxesIsBackusAndGilberts) {
  // Boxes of width w side by side: the middle one alone has the spread w, each neighbour 13 w, and since they
  // do not overlap the least spread is 1 / (1/w + 2/(13 w)) = 13 w / 15.
  constexpr double kWidth = 100.0;
  const SensorResponse boxes(
      with_table("400,0,0,0\n400.5,0,0,1\n500,0,0,1\n500.5,0,1,0\n600,0,1,0\n600.5,1,0,0\n700,1,0,0\n"
                 "700.5,0,0,0\n701,0,0,0\n"));
  const ResolvingKernel kernel = resolving_kernel(boxes, 550.5);
  EXPECT_NEAR(kernel.spread_nm, 13.0 / 15.0 * kWidth, 0.2);
  EXPECT_NEAR(kernel.weights[1], 13.0 / 15.0, 2e-3);
  EXPECT_NEAR(kernel.fwhm_nm, kWidth, 1.0);
}

TEST(ResolvingKernel, OfCamerasIsAboutAHundredNanometres) {
  // Jackel et al. 2014 state about 100 nm for the three channels of colour CCDs; theirs are not among these
  // cameras, and they give no error: a third either way is asked of the mean over the lines, the least by
  // which a channel (some 80 to 110 nm wide) and two (some 150 and more) could be told apart.
  for (const std::string& camera : built_in_cameras()) {
    Scene scene;
    scene.sensor.response = camera;
    const SensorResponse response(scene);
    double sum = 0.0;
    std::printf("%s:", camera.c_str());
    for (const double nm : {450.0, 540.0, 600.0}) {
      const ResolvingKernel kernel = resolving_kernel(response, nm);
      std::printf(" %.0f nm: %.0f nm (peak at %.0f, spread %.0f)", nm, kernel.fwhm_nm, kernel.peak_nm,
                  kernel.spread_nm);
      sum += kernel.fwhm_nm / 3.0;
    }
    std::printf(", mean %.0f nm\n", sum);
    EXPECT_GT(sum, 67.0) << camera;
    EXPECT_LT(sum, 133.0) << camera;
  }
}

TEST(ResolvingKernel, WantsTheNearInfraredBlocked) {
  // Jackel et al. 2014: a filter against the near infrared stabilises the inversion. Above 700 nm silicon
  // behind colour filters leaks through all channels alike (the leak's size is ours): three channels then
  // have four things to tell apart, and no sum of them keeps the near infrared out of a window in the
  // visible.
  const auto channels = [](bool blocked) {
    std::string rows;
    for (int nm = 400; nm <= 1000; nm += 10) {
      const auto band = [&](double centre) { return std::exp(-0.5 * std::pow((nm - centre) / 38.0, 2)); };
      const double leak = !blocked && nm > 700 ? 0.6 * (1000 - nm) / 300.0 : 0.0;
      char row[120];
      std::snprintf(row, sizeof row, "%d,%.6f,%.6f,%.6f\n", nm, band(610) + leak, band(535) + leak,
                    band(455) + leak);
      rows += row;
    }
    return SensorResponse(with_table(rows));
  };
  for (const double nm : {460.0, 540.0}) {
    const double open = resolving_kernel(channels(false), nm).spread_nm;
    const double blocked = resolving_kernel(channels(true), nm).spread_nm;
    std::printf("%.0f nm: spread %.0f nm open, %.0f nm blocked\n", nm, open, blocked);
    EXPECT_GT(open, 3.0 * blocked);
  }
}

}  // namespace
}  // namespace vegard::sim::spectral_resolution_test
