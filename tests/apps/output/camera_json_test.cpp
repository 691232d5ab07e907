// The matrices against the renderer itself: where they put a beam, its light is on the film.
#include "apps/output/camera_json.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "sim/render/beams/points.h"
#include "sim/render/film.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"

namespace vegard::apps::camera_json_test {
namespace {

using nlohmann::json;
using Pixel = std::array<double, 2>;

/// One beam, seen by a rolled camera off its axis.
sim::Scene one_beam() {
  sim::Scene scene = tests::small_scene();
  scene.camera.roll_deg = 20.0;
  sim::Sheet& sheet = scene.sheets[0];
  sheet.center_km = {60.0, 190.0};
  sheet.layers = sheet.beams = 1;
  sheet.length_km = 5.0;
  sheet.width_km = 1e-3;
  sheet.energy_flux_mw_m2 = 1e5;
  return scene;
}

Pixel by_intrinsics(const json& camera, const double world[3]) {
  double seen[3] = {}, homogeneous[3] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) seen[i] += camera["camera_from_enu"][i][j].get<double>() * world[j];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) homogeneous[i] += camera["K"][i][j].get<double>() * seen[j];
  return {homogeneous[0] / homogeneous[2], homogeneous[1] / homogeneous[2]};
}

Pixel by_opengl(const json& camera, const double world[3]) {
  const double point[4] = {world[0], world[1], world[2], 1.0};
  double eye[4] = {}, clip[4] = {};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) eye[i] += camera["opengl_view"][i][j].get<double>() * point[j];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) clip[i] += camera["opengl_projection"][i][j].get<double>() * eye[j];
  EXPECT_LT(std::abs(clip[2] / clip[3]), 1.0) << "between near and far";
  return {camera["image"]["width_px"].get<double>() * 0.5 * (1.0 + clip[0] / clip[3]),
          camera["image"]["height_px"].get<double>() * 0.5 * (1.0 - clip[1] / clip[3])};
}

/// Mean pixel of the green light of the points, by either way of projecting.
template <class Projection>
Pixel centre_of_points(const sim::Scene& scene, const Projection& project) {
  Pixel centre{};
  double light = 0.0;
  sim::stream_points(scene, {}, [&](const sim::EmissionPoints& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      double world[3];
      double range2 = 0.0;
      for (int k = 0; k < 3; ++k) {
        world[k] = points.position_in_enu_km[3 * i + k];
        range2 += world[k] * world[k];
      }
      const Pixel pixel = project(world);
      if (pixel[0] < 0.5 || pixel[0] > 159.5 || pixel[1] < 0.5 || pixel[1] > 119.5) continue;
      // 1/(r^2 Omega), Omega by the angle to the axis.
      const double f = 80.0 / std::tan(0.5 * 60.0 * M_PI / 180.0);
      const double x = pixel[0] - 80.0, y = pixel[1] - 60.0;
      const double seen = points.photons_per_s[i * points.lines + 1] / range2 *
                          std::pow(1.0 + (x * x + y * y) / (f * f), 1.5);
      light += seen;
      for (int k = 0; k < 2; ++k) centre[k] += seen * pixel[k];
    }
  });
  EXPECT_GT(light, 0.0);
  return {centre[0] / light, centre[1] / light};
}

TEST(CameraJson, PutsABeamWhereTheRendererDoes) {
  const sim::Scene scene = one_beam();
  const json camera = json::parse(camera_json(scene));
  sim::FilmGeometry film;
  film.columns = scene.camera.width;
  film.rows = scene.camera.height;
  sim::Exposure exposure;
  sim::make_exposer(scene, film, 0)->expose(scene, exposure);
  double light = 0.0;
  Pixel on_film{};
  for (int r = 0; r < film.rows; ++r)
    for (int c = 0; c < film.columns; ++c) {
      const double here =
          exposure.rayleigh[exposure.cells() + static_cast<std::size_t>(r) * film.columns + c];
      light += here;
      on_film[0] += here * (c + 0.5);
      on_film[1] += here * (r + 0.5);
    }
  ASSERT_GT(light, 0.0);
  const Pixel k = centre_of_points(scene, [&](const double* world) { return by_intrinsics(camera, world); });
  const Pixel gl = centre_of_points(scene, [&](const double* world) { return by_opengl(camera, world); });
  for (int i = 0; i < 2; ++i) {
    // The splat keeps the centre; floats and a point or two at the film's edge are left.
    EXPECT_NEAR(k[i], on_film[i] / light, 1e-3);
    EXPECT_NEAR(gl[i], on_film[i] / light, 1e-3);
  }
  EXPECT_GT(std::hypot(k[0] - 80.0, k[1] - 60.0), 20.0) << "a beam on the axis would prove little";
}

TEST(CameraJson, SaysFieldOfViewAndSite) {
  sim::Scene scene = one_beam();
  const json camera = json::parse(camera_json(scene));
  EXPECT_EQ(camera["field_of_view_deg"]["horizontal"], 60.0);
  EXPECT_NEAR(camera["field_of_view_deg"]["vertical"].get<double>(),
              2.0 * std::atan(0.75 * std::tan(M_PI / 6.0)) * 180.0 / M_PI, 1e-12);
  EXPECT_EQ(camera["site"]["altitude_m"], 300.0);
  EXPECT_EQ(camera_json_name("a/b.c.png"), "a/b.c.camera.json");
  scene.camera.model = sim::LensModel::equisolid;
  tests::expect_words(sim::ErrorKind::scene, {"camera.model", "equisolid", "pinhole"},
                      [&] { camera_json(scene); });
}

}  // namespace
}  // namespace vegard::apps::camera_json_test
