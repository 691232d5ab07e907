// Features of pictures that are made by formula: each tells what it is called by.
#include "fit/survey/filter/frame_features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sim/base/number/constants.h"
#include "sim/base/utc_time.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/moon.h"
#include "sim/view/sky/star_place.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::frame_features_test {
namespace {

using F = SkyFeature;
using Enu = std::array<double, 3>;
using Rgb = std::array<double, 3>;

sim::Scene northern_scene() {
  sim::Scene scene;
  scene.site.latitude_deg = 65.0;
  scene.site.longitude_deg = 20.0;
  scene.camera.width = 256;
  scene.camera.height = 192;
  scene.camera.hfov_deg = 80.0;
  scene.camera.azimuth_deg = 10.0;
  scene.camera.elevation_deg = 35.0;
  scene.camera.roll_deg = 5.0;
  scene.field.declination_deg = 10.0;
  return scene;
}

const double kNight_s = *sim::utc_seconds("2014-10-13T22:00:00Z");

Photo picture_of(const sim::Scene& scene, const std::function<Rgb(const Enu& enu)>& light) {
  Photo photo;
  photo.linear = sim::Image(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  for (int y = 0; y < scene.camera.height; ++y)
    for (int x = 0; x < scene.camera.width; ++x) {
      double enu[3] = {0.0, 0.0, 1.0};
      sim::enu_of_pixel(view, x + 0.5, y + 0.5, enu);
      const Rgb rgb = light({enu[0], enu[1], enu[2]});
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) = static_cast<float>(std::min(1.0, rgb[static_cast<std::size_t>(c)]));
    }
  return photo;
}

SkyFeatures features_of(const sim::Scene& scene, const Photo& photo, double utc_s = kNight_s) {
  return frame_features(photo, scene, filter_cells(scene, {}), utc_s);
}

/// A band about the line that runs from the horizon in this azimuth over the place this high above it.
Rgb band(const Enu& enu, double azimuth_deg, double height_deg) {
  const double a = azimuth_deg * sim::kRadiansPerDegree;
  const double across = enu[0] * std::cos(a) - enu[1] * std::sin(a);  // to the right of that azimuth
  const double angle_deg = std::atan2(enu[2], -across) / sim::kRadiansPerDegree;
  const double off = (angle_deg - height_deg) / 4.0, light = 0.2 * std::exp(-off * off);
  return {0.01 + 0.2 * light, 0.01 + light, 0.01 + 0.2 * light};
}

TEST(FrameFeatures, TellAnArcFromABandAcrossIt) {
  const sim::Scene scene = northern_scene();
  // An arc along magnetic east (azimuth 100), its line 30 degrees above the northern horizon.
  const SkyFeatures arc =
      features_of(scene, picture_of(scene, [](const Enu& enu) { return band(enu, 100.0, 30.0); }));
  EXPECT_GT(feature(arc, F::banded), 0.9);
  EXPECT_GT(feature(arc, F::crosswise), 0.9);
  EXPECT_GT(feature(arc, F::elongated), 0.8);
  EXPECT_GT(feature(arc, F::green), 0.4);
  EXPECT_LT(feature(arc, F::lamp_peak), 0.2);
  // One that runs from the north up through the zenith, such as the Milky Way.
  const SkyFeatures other =
      features_of(scene, picture_of(scene, [](const Enu& enu) { return band(enu, 10.0, 80.0); }));
  EXPECT_LT(feature(other, F::banded), 0.5);
  EXPECT_LT(feature(other, F::crosswise), 0.0);
  EXPECT_GT(feature(other, F::elongated), 0.8);
}

TEST(FrameFeatures, CountStars) {
  const sim::Scene scene = northern_scene();
  Photo photo = picture_of(scene, [](const Enu&) { return Rgb{0.01, 0.01, 0.01}; });
  const double none = feature(features_of(scene, photo), F::points);
  for (int i = 0; i < 31; ++i)
    for (int c = 0; c < 3; ++c) photo.linear.at(12 + 7 * i, 30 + (i * 37) % 80, c) = 0.2f;
  EXPECT_EQ(none, 0.0);
  EXPECT_NEAR(feature(features_of(scene, photo), F::points), std::log10(32.0), 1e-9);
}

TEST(FrameFeatures, TellTheMoonFromALampByItsPlace) {
  sim::Scene scene = northern_scene();
  const double date = 2440587.5 + kNight_s / 86400.0;
  sim::Observer observer;
  observer.latitude_deg = scene.site.latitude_deg;
  observer.longitude_deg = scene.site.longitude_deg;
  const Enu moon = sim::direction_of_moon(observer, date);
  ASSERT_GT(moon[2], 0.05);
  scene.camera.azimuth_deg = std::atan2(moon[0], moon[1]) / sim::kRadiansPerDegree + 15.0;
  const auto blob = [](const Enu& at) {
    return [at](const Enu& enu) {
      const double cosine = enu[0] * at[0] + enu[1] * at[1] + enu[2] * at[2];
      const double light = 0.02 + 2.0 * std::exp(-(1.0 - cosine) / 2e-4);
      return Rgb{light, light, light};
    };
  };
  const SkyFeatures of_moon = features_of(scene, picture_of(scene, blob(moon)));
  EXPECT_GT(feature(of_moon, F::moon_peak), 0.8);
  EXPECT_LT(feature(of_moon, F::lamp_peak), 0.2);
  EXPECT_GT(feature(of_moon, F::moon_light), 0.4);
  // A quarter of an hour's turn of the sky is enough for it not to be the Moon any more, an hour certainly.
  const SkyFeatures later = features_of(scene, picture_of(scene, blob(moon)), kNight_s + 3600.0);
  EXPECT_LT(feature(later, F::moon_peak), 0.1);
  EXPECT_GT(feature(later, F::lamp_peak), 0.8);
}

TEST(FrameFeatures, KnowTheSun) {
  const sim::Scene scene = northern_scene();
  const Photo photo = picture_of(scene, [](const Enu& enu) {
    const double light = 0.1 * std::pow(10.0, 0.5 * enu[0]);  // towards the east
    return Rgb{0.5 * light, light, 1.5 * light};
  });
  // Local midnight of 13 October: 90 - 65 + 7.9 degrees of declination below.
  EXPECT_NEAR(feature(features_of(scene, photo, *sim::utc_seconds("2014-10-13T22:26:00Z")), F::sun_elevation),
              -32.9, 0.2);
  const SkyFeatures morning = features_of(scene, photo, *sim::utc_seconds("2014-10-14T05:00:00Z"));
  EXPECT_NEAR(feature(morning, F::sun_elevation), -4.5, 1.0);
  EXPECT_GT(feature(morning, F::sunward), 0.2);
  EXPECT_NEAR(feature(morning, F::blue), 1.0 / 3.0, 1e-3);
  EXPECT_LT(feature(features_of(scene, photo, *sim::utc_seconds("2014-10-13T16:00:00Z")), F::sunward), -0.2);
}

TEST(FrameFeatures, LeaveOutWhatIsMasked) {
  const sim::Scene scene = northern_scene();
  Photo photo = picture_of(scene, [](const Enu& enu) { return band(enu, 100.0, 30.0); });
  const SkyFeatures without = features_of(scene, photo);
  std::vector<std::uint8_t> kept(static_cast<std::size_t>(scene.camera.width) * scene.camera.height, 1);
  for (int y = 40; y < 80; ++y)
    for (int x = 100; x < 140; ++x) {
      kept[static_cast<std::size_t>(y) * scene.camera.width + x] = 0;
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = 1.0f;
    }
  const SkyFeatures masked = frame_features(photo, scene, filter_cells(scene, kept), kNight_s);
  EXPECT_EQ(feature(masked, F::clipped), feature(without, F::clipped));
  EXPECT_GT(feature(features_of(scene, photo), F::clipped), feature(without, F::clipped) + 1.0);
  EXPECT_LT(feature(masked, F::lamp_peak), 0.2);
  tests::expect_error(sim::ErrorKind::unreadable_input,
                      [&] { filter_cells(scene, std::vector<std::uint8_t>(kept.size(), 0)); });
  sim::Scene other = scene;
  other.camera.width = 128;
  tests::expect_error(sim::ErrorKind::unreadable_input, [&] { features_of(other, photo); });
}

}  // namespace
}  // namespace vegard::fit::frame_features_test
