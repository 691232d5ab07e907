// Light before, within and behind what absorbs.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/render/render.h"
#include "sim/scene/scene.h"

namespace vegard::sim {
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
    in_disc += std::hypot(x, y) < radius_px;
    // Single precision, and the corona's quadrature on another span.
    EXPECT_NEAR(a.data[i], b.data[i], 1e-4 * b.data[i]) << i;
  }
  EXPECT_GT(in_disc, 100);
}

TEST(SunOrder, AThinShellDimsOnlyWhatLiesBehindItsBeginning) {
  const Scene clear = corona_scene();
  Scene dimmed = clear;
  dimmed.chromospheres = {shell_of(1e-4)};  // an optical depth of 0.017 through the shell where it is thinnest
  const Image a = render(clear).rayleigh, b = render(dimmed).rayleigh;
  Scene opaque = clear;
  opaque.chromospheres = {shell_of(1e3)};
  const Image front = render(opaque).rayleigh;
  // In the middle of the disc: what is in front stays, the rest comes through exp(-tau).
  const std::size_t middle = 24 * 64 + 32;
  const double tau = 1e-4 * (kRaised - 1.0) * 695.7;
  const double expected = front.data[middle] + std::exp(-tau) * (a.data[middle] - front.data[middle]);
  ASSERT_LT(front.data[middle], 0.9 * a.data[middle]);
  // The ray through the pixel's middle is half a pixel off the disc's: the way is longer by less than a thousandth.
  EXPECT_NEAR(b.data[middle], expected, 1e-3 * tau * a.data[middle] + 1e-6 * expected);
}

}  // namespace
}  // namespace vegard::sim
