// Pictures through lenses other than a plain pinhole.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/render/beam_exposer.h"
#include "sim/render/beams/points.h"
#include "sim/render/film.h"
#include "sim/render/render.h"
#include "sim/view/camera/camera.h"
#include "tests/support/all_points.h"
#include "tests/support/exposed.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::lens_on_film_test {
namespace {

/// The whole sky, and a little more, with a sheet that stands across it.
Scene all_sky(const std::string& model) {
  Scene scene = tests::small_scene();
  Camera& camera = scene.camera;
  camera.model = tests::kind_named<LensModel>(model);
  camera.width = camera.height = 140;
  camera.hfov_deg = 110.0;
  camera.focal_px = model == "stereographic" ? 35.0 : 42.0;
  camera.elevation_deg = 84.0;
  camera.azimuth_deg = 40.0;
  camera.principal_x_px = 2.5;
  camera.mirrored = true;
  if (model == "polynomial" || model == "pinhole") camera.k1 = -0.03;
  camera.p2 = 0.001;
  scene.sheets[0].center_km = {5.0, 60.0};
  return scene;
}

class ThroughLens : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Model, ThroughLens,
                         testing::Values("pinhole", "equidistant", "equisolid", "stereographic",
                                         "orthographic", "polynomial"));

TEST_P(ThroughLens, TheFilmHasTheLightOfThePointsThatItSees) {
  const Scene scene = all_sky(GetParam());
  const EmissionPoints points = tests::all_points(scene);
  const CameraView<double> view = camera_view(scene.camera);
  const FilmGeometry film = tests::whole_picture(scene);
  std::vector<double> sum(points.lines, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double enu[3], range2 = 0.0, x = 0.0, y = 0.0;
    for (int k = 0; k < 3; ++k) {
      enu[k] = points.position_in_enu_km[3 * i + k];
      range2 += enu[k] * enu[k];
    }
    // What stands below the horizon is hidden by the Earth.
    if (enu[2] < 0.0 || !pixel_of_enu(view, enu, x, y)) continue;
    if (x < 0.5 || x >= film.columns - 0.5 || y < 0.5 || y >= film.rows - 0.5) continue;
    const double steradian = pixel_steradians(view.lens, x, y);
    for (int l = 0; l < points.lines; ++l)
      sum[l] += 1e-16 * points.photons_per_s[i * points.lines + l] / (range2 * steradian);
  }
  std::vector<double> reference;
  BeamExposer exposer(scene, film, 0);
  exposer.expose_reference(scene, reference);
  const Exposure exposure = tests::exposed(scene);
  const std::size_t cells = exposure.cells();
  for (int l = 0; l < points.lines; ++l) {
    double light = 0.0, packs = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
      light += reference[l * cells + i];
      packs += exposure.rayleigh[l * cells + i];
    }
    EXPECT_GT(light, 1e4);
    // Positions are floats: some points are on the other side of the film's edge.
    EXPECT_NEAR(sum[l] / light, 1.0, 3e-5) << l;
    EXPECT_NEAR(packs / light, 1.0, 3e-5) << l;
  }
}

TEST(ThroughLenses, AnyCircleOfTheSkyHasTheSameBeams) {
  // However large the circle is in its frame, the beams above the horizon are seen.
  std::vector<std::uint64_t> points;
  for (const double focal_px : {47.7, 52.0, 57.3, 60.0, 70.0}) {
    Scene scene = all_sky("equidistant");
    scene.camera.width = scene.camera.height = 200;
    scene.camera.focal_px = focal_px;
    scene.camera.elevation_deg = 90.0;
    points.push_back(tests::exposed(scene).deflection_points);
  }
  for (const std::uint64_t count : points)
    EXPECT_NEAR(static_cast<double>(count) / static_cast<double>(points.front()), 1.0, 0.02);
}

TEST(EarthOnFilm, HidesWhatStandsBehindIt) {
  // From 400 km the horizon is 2293 km away along the ground's tangent, 19.8 degrees down. Light at 110 km
  // beyond it can be seen over it as far as both tangents reach; a sheet on the far side of the Earth cannot.
  Scene scene = tests::small_scene();
  scene.site.altitude_m = 400e3;
  scene.sheets[0].top_km = 250.0;
  scene.field.inclination_deg = 90.0;
  scene.camera.width = 200;
  scene.camera.height = 200;
  scene.camera.azimuth_deg = 0.0;
  scene.camera.roll_deg = 0.0;
  scene.camera.elevation_deg = -20.0;
  scene.camera.hfov_deg = 60.0;
  const auto light_at = [&](double north_km) {
    Scene here = scene;
    here.sheets[0].center_km = {0.0, north_km};
    here.sheets[0].bearing_deg = 90.0;
    const Exposure exposure = tests::exposed(here);
    double sum = 0.0;
    for (const float r : exposure.rayleigh) sum += r;
    return sum;
  };
  EXPECT_GT(light_at(1500.0), 1e3) << "before the horizon";
  EXPECT_GT(light_at(2600.0), 1e3) << "above it";
  EXPECT_EQ(light_at(3900.0), 0.0) << "behind the Earth";
  scene.sheets[0].top_km = 400.0;
  EXPECT_GT(light_at(3900.0), 0.0) << "what stands above its shadow";
}

TEST(EarthOnFilm, EndsTheLightOfADistantArcAtTheHorizon) {
  // From the ground the horizon is level: no light in the rows below it.
  Scene scene = tests::small_scene();
  scene.site.altitude_m = 0.0;
  scene.camera.roll_deg = 0.0;
  scene.camera.elevation_deg = 5.0;
  scene.sheets[0].center_km = {0.0, 1150.0};
  scene.sheets[0].length_km = 1500.0;
  const Exposure exposure = tests::exposed(scene);
  double above = 0.0, below = 0.0;
  for (int r = 0; r < scene.camera.height; ++r) {
    const double up = direction_of_pixel(scene.camera, 80.5, r + 0.5).elevation_deg;
    const double down = direction_of_pixel(scene.camera, 0.5, r + 0.5).elevation_deg;
    double row = 0.0;
    for (int c = 0; c < scene.camera.width; ++c)
      row += exposure.rayleigh[static_cast<std::size_t>(r) * scene.camera.width + c];
    if (up > 0.0) above += row;
    if (std::max(up, down) < -0.6) below += row;  // a cell below, for the bilinear splat
  }
  EXPECT_GT(above, 100.0);
  EXPECT_EQ(below, 0.0);
}

}  // namespace
}  // namespace vegard::sim::lens_on_film_test
