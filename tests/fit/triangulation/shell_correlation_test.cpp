#include "fit/triangulation/shell_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fit/triangulation/shared_view.h"

namespace vegard::fit::shell_correlation_test {
namespace {

constexpr int kSize_px = 120;

ViewPoint all_sky(double latitude_deg, double longitude_deg) {
  PlacedCamera camera;
  camera.camera.model = sim::LensModel::equidistant;
  camera.camera.width = camera.camera.height = kSize_px;
  camera.camera.focal_px = 45.0;
  camera.camera.elevation_deg = 90.0;
  camera.site.latitude_deg = latitude_deg;
  camera.site.longitude_deg = longitude_deg;
  camera.pointing_error_deg = 0.05;
  return {camera, EarthShape::wgs84};
}

/// Light in waves of some tens of kilometres in all directions, on a thin shell, through a tone curve.
Photo light_on_shell(const ViewPoint& view, double height_km, double gamma, double gain) {
  sim::Image light(kSize_px, kSize_px, {"L"});
  for (int y = 0; y < kSize_px; ++y)
    for (int x = 0; x < kSize_px; ++x) {
      const auto direction = view.direction({x + 0.5, y + 0.5});
      const auto place = direction ? place_at_height(view, *direction, height_km) : std::nullopt;
      if (!place) continue;
      const GeodeticPlace at = geodetic_place(EarthShape::wgs84, *place);
      const double east = 40.0 * at.longitude_deg, north = 111.0 * at.latitude_deg;
      const double waves = std::sin(east / 9.0 + 2.0 * std::sin(north / 31.0)) +
                           std::sin(north / 7.0 + 0.4 * std::sin(east / 17.0));
      light.at(x, y, 0) = static_cast<float>(gain * std::pow(0.3 + 0.15 * waves, gamma));
    }
  return photo_of_light(light, {}, "shell");
}

ShellCorrelation heights_of(const std::vector<ViewPoint>& views, const Photo& a, const Photo& b) {
  ShellSettings settings;
  settings.grid_km = 9.0;
  settings.farthest_km = 130.0;
  return shell_correlation(views, {&a, &b}, settings);
}

TEST(ShellCorrelation, FindsTheShellWhateverTheToneCurves) {
  const std::vector<ViewPoint> views = {all_sky(68.0, 20.0), all_sky(67.6, 21.0)};
  const double truth_km = 143.0;
  const Photo a = light_on_shell(views[0], truth_km, 1.0, 1.0),
              b = light_on_shell(views[1], truth_km, 0.45, 0.3);
  const ShellCorrelation found = heights_of(views, a, b);
  ASSERT_FALSE(found.heights.empty());
  EXPECT_GT(found.heights.front().weight, 0.9);
  // Half a pixel of 45 to a radian is 1.5 km at this distance; hundreds of places have a tenth of that.
  EXPECT_NEAR(found.heights.front().km, truth_km, 2.5);
  EXPECT_LT(found.heights.front().error_km, 6.0);
}

TEST(ShellCorrelation, FindsNothingInOtherLight) {
  const std::vector<ViewPoint> views = {all_sky(68.0, 20.0), all_sky(67.6, 21.0)};
  const Photo a = light_on_shell(views[0], 110.0, 1.0, 1.0);
  // Of a shell that is 1000 km high: nothing below 250 km fits.
  const Photo b = light_on_shell(views[1], 1000.0, 1.0, 1.0);
  EXPECT_TRUE(heights_of(views, a, b).heights.empty());
}

TEST(SharedView, IsTheShareOfTheSky) {
  const ViewPoint here = all_sky(68.0, 20.0), near = all_sky(68.1, 20.0), far = all_sky(-68.0, 20.0);
  EXPECT_GT(shared_sky(here, near, 110.0), 0.8);
  EXPECT_EQ(shared_sky(here, far, 110.0), 0.0);
  const auto outline = view_outline(here, 110.0);
  ASSERT_GT(outline.size(), 50u);
  for (const GeodeticPlace& place : outline) EXPECT_NEAR(place.height_km, 110.0, 1e-6);
}

}  // namespace
}  // namespace vegard::fit::shell_correlation_test
