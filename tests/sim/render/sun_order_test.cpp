// Light before, within and behind what absorbs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/render/beam_exposer.h"
#include "sim/render/film.h"
#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/free_paths.h"

namespace vegard::sim::sun_order_test {
namespace {

constexpr double kRaised = 1.25;  // radius of the shell's outer sphere, in radii of the photosphere
constexpr double kPower = 4.0;

/// The Sun, 0.5 degrees wide, in white light, with a corona alone.
Scene corona_scene() {
  Scene scene;
  scene.sheets.clear();
  scene.emission.lines = {560.0};
  scene.blur.width_deg = {0.0};
  scene.camera.width = 64;
  scene.camera.height = 48;
  scene.camera.hfov_deg = 1.5;
  scene.camera.elevation_deg = scene.sun.elevation_deg;
  scene.sun.shown = true;
  Corona corona;
  corona.share = {1.0};
  corona.power = {kPower};
  corona.reach = 4.0;
  corona.rayleigh = {1000.0};
  scene.coronae = {corona};
  return scene;
}

Chromosphere shell_of(double extinction) {
  Chromosphere shell;
  shell.innerradius = 695.7;
  shell.outerradius = kRaised * 695.7;
  // A cutoff far below any turbulence, at its amplitude everywhere: density 1.
  shell.coverage = -1.0;
  shell.sharpness = 1000.0;
  shell.extinction = extinction;
  shell.step = 20.0;
  return shell;
}

TEST(SunOrder, BehindAnOpaqueShellNothingShowsOfTheCorona) {
  Scene behind_shell = corona_scene();
  behind_shell.chromospheres = {shell_of(1e3)};
  // The same corona about a ball as large as the shell: light goes as (r / R)^-power.
  Scene raised = corona_scene();
  raised.sun.radius *= kRaised;
  raised.coronae[0].reach /= kRaised;
  raised.coronae[0].density = std::pow(kRaised, -kPower);
  const Image a = render(behind_shell).rayleigh, b = render(raised).rayleigh;
  ASSERT_EQ(a.data.size(), b.data.size());
  int in_disc = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) {
    // Both edges are drawn smoothly, each in its own way: the pixel in which they lie may differ.
    const double x = static_cast<double>(i % 64) - 31.5, y = static_cast<double>(i / 64) - 23.5;
    const double radius_px = kRaised * 695700.0 / 149597870.7 / (1.5 * 3.14159265358979 / 180.0) * 64.0;
    if (std::abs(std::hypot(x, y) - radius_px) < 1.5) continue;
    // The hidden ball's edge too: there pixels are means over several rays.
    if (std::abs(std::hypot(x, y) - radius_px / kRaised) < 1.5) continue;
    in_disc += std::hypot(x, y) < radius_px;
    // Single precision, and the corona's quadrature on another span.
    EXPECT_NEAR(a.data[i], b.data[i], 1e-4 * b.data[i]) << i;
  }
  EXPECT_GT(in_disc, 100);
}

TEST(SunOrder, ALoopByVoxelsIsDimmedAsItsStrandsAre) {
  Scene scene = corona_scene();
  scene.coronae.clear();
  scene.chromospheres = {shell_of(2e-3)};
  Loop loop;  // in the middle of the disc, its feet within the shell and its top above it
  loop.height = 300.0;
  loop.width = 300.0;
  loop.strands = 1;
  loop.strand_radius = 60.0;
  loop.rayleigh = {500.0};
  scene.loops = {loop};
  const auto sum = [](const Image& image) {
    double all = 0.0;
    for (const float one : image.data) all += one;
    return all;
  };
  Scene clear = scene;
  clear.chromospheres.clear();
  const double kept = sum(render(scene).rayleigh) / sum(render(clear).rayleigh);
  for (Scene* each : {&scene, &clear}) each->loops[0].voxel = 10.0;
  const double kept_of_voxels = sum(render(scene).rayleigh) / sum(render(clear).rayleigh);
  EXPECT_LT(kept, 0.95);
  EXPECT_GT(kept, 0.3);
  EXPECT_NEAR(kept_of_voxels, kept, 0.01);  // steps of half a voxel, over 174 of the shell
}

TEST(SunOrder, AThinShellDimsOnlyWhatLiesBehindItsBeginning) {
  const Scene clear = corona_scene();
  Scene dimmed = clear;
  dimmed.chromospheres = {
      shell_of(1e-4)};  // an optical depth of 0.017 through the shell where it is thinnest
  const Image a = render(clear).rayleigh, b = render(dimmed).rayleigh;
  Scene opaque = clear;
  opaque.chromospheres = {shell_of(1e3)};
  const Image front = render(opaque).rayleigh;
  // In the middle of the disc: what is in front stays, the rest comes through exp(-tau).
  const std::size_t middle = 24 * 64 + 32;
  const double tau = 1e-4 * (kRaised - 1.0) * 695.7;
  const double expected = front.data[middle] + std::exp(-tau) * (a.data[middle] - front.data[middle]);
  ASSERT_LT(front.data[middle], 0.9 * a.data[middle]);
  // The ray through the pixel's middle is half a pixel off the disc's: the way is longer by less than a
  // thousandth.
  EXPECT_NEAR(b.data[middle], expected, 1e-3 * tau * a.data[middle] + 1e-6 * expected);
}

/// Light of a film by every number of the Sun, of what stands on it and of the camera, beside differences.
TEST(SunOrder, DerivativesThroughAnAbsorberAgreeWithDifferences) {
  Scene scene = corona_scene();
  scene.camera.width = 24;
  scene.camera.height = 18;
  scene.camera.elevation_deg += 0.13;  // off the limb and on the disc
  scene.sun.latitude_deg = 5.0;
  scene.sun.longitude_deg = 3.0;
  scene.chromospheres = {shell_of(4e-3)};
  Loop loop;
  loop.latitude_deg = 20.0;
  loop.longitude_deg = 10.0;
  loop.height = 250.0;
  loop.width = 300.0;
  loop.strands = 3;
  loop.spread = 40.0;
  loop.strand_radius = 60.0;
  loop.rayleigh = {500.0};
  scene.loops = {loop};
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  BeamExposer exposer(scene, film, 0, 0.5);
  const std::vector<std::string> paths = {
      "sun.distance_km",       "sun.azimuth_deg",  "sun.elevation_deg",
      "sun.latitude_deg",      "camera.hfov_deg",  "camera.azimuth_deg",
      "corona.corona.power.0", "loop.loop.height", "chromosphere.chromosphere.extinction"};
  const std::vector<ParameterId> free = tests::ids_of(scene, paths);
  Exposure exposure;
  exposer.expose_with_derivatives(scene, free, exposure);
  for (std::size_t j = 0; j < paths.size(); ++j) {
    const bool is_angle = paths[j].find("_deg") != std::string::npos;
    const double step = is_angle ? 2e-4 : 1e-4 * std::max(1e-2, std::abs(*number_at(scene, free[j])));
    Scene more = scene, less = scene;
    *number_at(more, free[j]) += step;
    *number_at(less, free[j]) -= step;
    Exposure up, down;
    up.one_ray = down.one_ray = true;
    exposer.expose(more, up);
    exposer.expose(less, down);
    double size = 0.0, off = 0.0;
    int counted = 0;
    for (std::size_t i = 0; i < up.rayleigh.size(); ++i) {
      const double difference = (static_cast<double>(up.rayleigh[i]) - down.rayleigh[i]) / (2.0 * step);
      const double exact = exposure.derivative[i * exposure.free_stride + j];
      // A ray of the limb, and one on the shell's edge, change from one case to the other: they have corners.
      const double x = static_cast<double>(i % 24), y = static_cast<double>(i / 24);
      const double px_deg = scene.camera.hfov_deg / scene.camera.width;
      const double radius = 695700.0 / scene.sun.distance_km / 3.14159265358979 * 180.0 / px_deg;
      const double away = std::hypot(x - 11.5, y - 8.5 - 0.13 / px_deg);
      if (std::abs(away - radius) < 1.5 || std::abs(away - kRaised * radius) < 1.5) continue;
      size += difference * difference;
      off += (difference - exact) * (difference - exact);
      ++counted;
    }
    EXPECT_GT(counted, 200);
    EXPECT_GT(size, 0.0) << paths[j];
    // Single precision of the film's light, over a step.
    EXPECT_LT(std::sqrt(off), 0.02 * std::sqrt(size)) << paths[j];
  }
}

}  // namespace
}  // namespace vegard::sim::sun_order_test
