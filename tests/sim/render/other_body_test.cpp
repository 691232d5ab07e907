// Scenes on other bodies than the Earth: what is drawn stands where geometry has it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/base/number/constants.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/render.h"
#include "sim/scene/lines/bodies.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/structs/site_axes.h"
#include "sim/view/camera/camera.h"
#include "tests/support/all_points.h"
#include "tests/support/kind_named.h"
#include "tests/support/same_bytes.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::other_body_test {
namespace {

OwnLine layer_line() {
  OwnLine own;
  own.name = "mine";
  own.wavelength_nm = 600.0;
  own.rayleigh_per_mw_m2 = 1000.0;
  own.peak_km = 200.0;
  own.scale_height_km = 25.0;
  return own;
}

Scene on(const std::string& body) {
  Scene scene = tests::small_scene();
  scene.body.name = body;
  adopt_body(scene);
  scene.own_lines = {layer_line()};
  change_lines(scene, {600.0});
  scene.blur.width_deg = {0.0};
  scene.sheets[0].profile = ProfileKind::layer;
  return scene;
}

TEST(OtherBody, OfTheEarthsNumbersHasTheEarthsBits) {
  Footprint shell;
  shell.name = "shell";
  shell.shape = FootprintShape::shell;
  shell.face_cells = 256;
  shell.width_km = 60.0;
  shell.profile = ProfileKind::layer;
  shell.latitude_deg = {66.0, 67.0, 66.5};
  shell.longitude_deg = {-6.0, 0.0, 6.0};
  for (const FieldModel field : {FieldModel::uniform, FieldModel::dipole}) {
    Scene earth = on("earth");
    earth.field.model = field;
    earth.footprints = {shell};
    Scene own = earth;
    own.body.name = "own";
    const Rendering a = render(earth, {}), b = render(own, {});
    EXPECT_TRUE(tests::same_bytes(a.rayleigh.data, b.rayleigh.data));
    EXPECT_TRUE(tests::same_bytes(a.rgb.data, b.rgb.data));
    // And the test would notice a radius that counts.
    own.body.radius_km = 6400.0;
    EXPECT_FALSE(tests::same_bytes(a.rayleigh.data, render(own, {}).rayleigh.data));
  }
}

TEST(OtherBody, HasItsBeamsBetweenTheSpheresOfTheirLight) {
  Scene scene = on("jupiter");
  scene.field.model = FieldModel::uniform;
  scene.field.inclination_deg = 90.0;
  Sheet& sheet = scene.sheets[0];
  sheet.center_km = {0.0, 1500.0};
  sheet.top_km = 500.0;
  sheet.loss_cone_deg = 0.0;
  sheet.pitch_step_rad = 0.0;
  const EmissionPoints points = tests::all_points(scene);
  const double radius = scene.body.radius_km;
  double light = 0.0, altitudes = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float* at = points.position_in_enu_km.data() + 3 * i;
    const double altitude = std::hypot(at[0], at[1], at[2] + radius + 1e-3 * scene.site.altitude_m) - radius;
    ASSERT_GT(altitude, 79.9);
    ASSERT_LT(altitude, 500.1);
    light += points.photons_per_s[i];
    altitudes += points.photons_per_s[i] * altitude;
    // From the tangent plane of the site the body falls away by d^2 / 2R.
    const double level2 = at[0] * at[0] + at[1] * at[1];
    EXPECT_NEAR(altitude - at[2] - 0.3, level2 / (2.0 * radius), 0.02 * level2 / (2.0 * radius) + 0.02);
  }
  const HeightProfile profile = sheet_profile({600.0}, scene, 0);
  double rates = 0.0, moments = 0.0;
  for (int a = 0; HeightProfile::altitude_km(a) <= 500.0; ++a) {
    const double rate = profile.rate[static_cast<std::size_t>(a) * profile.stride];
    rates += rate;
    moments += rate * HeightProfile::altitude_km(a);
  }
  // 800 beams of some 300 points each: the mean is good to a fraction of a kilometre.
  EXPECT_NEAR(altitudes / light, moments / rates, 1.0);
}

TEST(OtherBody, ShowsAShellsLightWhereItsLatitudeAndLongitudeAre) {
  for (const char* name : {"jupiter", "saturn"}) {
    Scene scene = on(name);
    scene.sheets.clear();
    scene.field.model = FieldModel::uniform;  // light falls straight down
    scene.site.latitude_deg = 50.0;
    scene.site.longitude_deg = 150.0;
    scene.site.altitude_m = 4e8;
    scene.march.step_km = 20.0;
    Camera& camera = scene.camera;
    camera.width = camera.height = 200;
    camera.hfov_deg = 22.0;
    camera.azimuth_deg = 0.0;
    camera.elevation_deg = -88.0;
    camera.roll_deg = 0.0;
    Footprint spot;
    spot.name = "spot";
    spot.shape = FootprintShape::shell;
    spot.face_cells = 512;
    spot.width_km = 900.0;
    spot.top_km = 500.0;
    spot.profile = ProfileKind::layer;
    spot.latitude_deg = {68.0, 68.0, 68.0};
    spot.longitude_deg = {162.9, 163.0, 163.1};
    scene.footprints = {spot};
    const Image picture = render(scene, {}).rayleigh;
    double light = 0.0, x_light = 0.0, y_light = 0.0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const double here = picture.at(x, y, 0);
        light += here;
        x_light += here * (x + 0.5);
        y_light += here * (y + 0.5);
      }
    ASSERT_GT(light, 0.0);
    const double height =
        scene.body.radius_km + 214.0;  // the mean of the layer, 0.58 scale heights above its peak
    Site there;
    there.latitude_deg = 68.0;
    there.longitude_deg = 163.0;
    const SiteAxes axes = axes_at(scene.site), up = axes_at(there);
    double enu[3], x_px = 0.0, y_px = 0.0;
    for (int i = 0; i < 3; ++i) {
      enu[i] = i == 2 ? -(scene.body.radius_km + 4e5) : 0.0;
      for (int k = 0; k < 3; ++k) enu[i] += axes.axis[i][k] * height * up.axis[2][k];
    }
    ASSERT_TRUE(pixel_of_enu(camera_view(camera), enu, x_px, y_px));
    // A pixel is 700 km: the spot's middle is known far better than that, and its tilt to the line of sight
    // moves it by less than a tenth.
    EXPECT_NEAR(x_light / light, x_px, 0.2) << name;
    EXPECT_NEAR(y_light / light, y_px, 0.2) << name;
  }
}

TEST(OtherBody, GivesTheSamePictureForAnyNumberOfThreads) {
  const Scene scene = on("jupiter");
  RenderOptions one, three;
  one.threads = 1;
  three.threads = 3;
  EXPECT_TRUE(tests::same_bytes(render(scene, one).rayleigh.data, render(scene, three).rayleigh.data));
}

}  // namespace
}  // namespace vegard::sim::other_body_test
