#include "fit/border/cut_peaks.h"

#include <gtest/gtest.h>

#include "sim/base/image.h"

namespace vegard::fit::cut_peaks_test {
namespace {

/// Degrees of elevation are rows, ten pixels each; what lies from one elevation to another is clipped.
Photo clipped(const sim::Camera& camera, double from_deg, double to_deg) {
  Photo photo = photo_of_light(sim::Image(camera.width, camera.height, {"L"}), {}, "clipped");
  photo.usable.assign(photo.linear.data.size(), 1);
  const sim::CameraView<double> view = sim::camera_view(camera);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      double enu[3];
      if (!sim::enu_of_pixel(view, x + 0.5, y + 0.5, enu)) continue;
      const double up_deg = sim::direction_of_enu(enu).elevation_deg;
      if (up_deg > from_deg && up_deg < to_deg) photo.usable[photo.linear.index(x, y, 1)] = 0;
    }
  return photo;
}

TEST(CutPeaks, CountWhereMoreIsClippedThanTheLightFallsIn) {
  sim::Camera camera;
  camera.width = camera.height = 200;
  camera.hfov_deg = 20.0;
  camera.azimuth_deg = 0.0;
  camera.elevation_deg = 20.0;
  BorderTrace trace;
  for (double azimuth_deg : {356.0, 358.0, 0.0, 2.0}) {
    BorderPoint point;
    point.azimuth_deg = azimuth_deg;
    point.elevation_deg = 18.0;
    point.peak_elevation_deg = 19.0;
    point.fall_deg = 0.8;
    trace.points.push_back(point);
  }
  EXPECT_EQ(cut_peak_share(trace, clipped(camera, 50.0, 60.0), camera, 1), 0.0);
  EXPECT_EQ(cut_peak_share(trace, clipped(camera, 18.6, 19.2), camera, 1), 0.0);
  EXPECT_EQ(cut_peak_share(trace, clipped(camera, 18.6, 20.2), camera, 1), 1.0);
  // A border that is not known has no peak.
  trace.points.back().limit = BorderLimit::mask;
  trace.points.front().elevation_deg = trace.points.front().peak_elevation_deg = 12.0;
  EXPECT_DOUBLE_EQ(cut_peak_share(trace, clipped(camera, 18.6, 20.2), camera, 1), 2.0 / 3.0);
  EXPECT_EQ(cut_peak_share(BorderTrace(), clipped(camera, 18.6, 20.2), camera, 1), 0.0);
}

}  // namespace
}  // namespace vegard::fit::cut_peaks_test
