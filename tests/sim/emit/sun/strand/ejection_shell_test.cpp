#include "sim/emit/sun/strand/ejection_shell.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/light_derivatives.h"
#include "tests/support/seeded_numbers.h"
#include "tests/support/sun_rays.h"

namespace vegard::sim::ejection_shell_test {
namespace {

using tests::plain_double;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kDistance = 5000.0;

Scene a_scene() {
  Scene scene;
  scene.emission.lines = {557.7};
  scene.sun = tests::level_sun(kDistance);
  scene.sun.radius = 700.0;
  Ejection ejection;
  ejection.kind = EjectionKind::shell;
  ejection.longitude_deg = 70.0;
  ejection.latitude_deg = 20.0;
  ejection.start_height = 100.0;
  ejection.speed_km_s = 1.0;
  ejection.age_s = 0.0;
  ejection.density = 2.0;
  ejection.rayleigh = {3.0};
  scene.ejections = {ejection};
  return scene;
}

EjectionShell<double> shell_of(const Scene& s) {
  return {s.sun, s.time.start_s, s.ejections[0], plain_double};
}

EjectionShellEmitter<double> emitter_of(const Scene& s) {
  return {shell_of(s), s.sun, SunFrame<double>(s.sun, plain_double), s.ejections[0].rayleigh};
}

TEST(EjectionShell, SpansItsWidthUpToItsFront) {
  Scene scene = a_scene();
  for (const double age : {0.0, 500.0, 5000.0}) {
    scene.time.start_s = age;
    const EjectionShell<double> shell = shell_of(scene);
    const double distance = length3(shell.middle);
    EXPECT_NEAR(distance + shell.outer, 700.0 + 100.0 + age, 1e-9);
    EXPECT_NEAR(std::asin(shell.outer / distance) / kDegree, 20.0, 1e-9);
    EXPECT_NEAR(shell.outer - shell.inner, std::min(0.25 * (100.0 + age), shell.outer), 1e-9);
  }
}

TEST(EjectionShell, KeepsItsMass) {
  // Its field summed over cells, 60 to a side: where the photosphere's edge cuts cells, and there alone, that
  // is off by a part of a cell.
  Scene scene = a_scene();
  double first = 0.0;
  for (const double age : {0.0, 400.0, 4000.0}) {
    scene.ejections[0].age_s = age;
    const EjectionShellField field(scene, scene.ejections[0]);
    const Box3 box = field.bounds();
    constexpr int kCells = 60;
    const double cell = (box.high[0] - box.low[0]) / kCells;
    double sum = 0.0;
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j)
        for (int k = 0; k < kCells; ++k) {
          const double at[3] = {box.low[0] + (i + 0.5) * cell, box.low[1] + (j + 0.5) * cell,
                                box.low[2] + (k + 0.5) * cell};
          const double* const point[3] = {&at[0], &at[1], &at[2]};
          float emission, density;
          float* const to[1] = {&emission};
          field.sample(1, point, to, &density);
          EXPECT_EQ(density, 0.0f);  // nothing absorbs
          // 3 R to a km of density 1 is 3e6 photons cm^-2 s^-1 over 1e5 cm.
          sum += emission / 30.0;
          if (emission > 0.0f) {
            EXPECT_FALSE(
                field.is_dark({{at[0] - 1, at[1] - 1, at[2] - 1}, {at[0] + 1, at[1] + 1, at[2] + 1}}));
          }
        }
    sum *= cell * cell * cell;
    if (first == 0.0) first = sum;
    EXPECT_NEAR(sum / first, 1.0, 0.01);
    EXPECT_NEAR(sum / shell_of(scene).mass(700.0), 1.0, 0.01);
  }
}

TEST(EjectionShell, ARayIsItsDensityMarched) {
  Scene scene = a_scene();
  scene.ejections[0].age_s = 900.0;
  const EjectionShell<double> shell = shell_of(scene);
  const EjectionShellEmitter<double> emitter = emitter_of(scene);
  int lit = 0;
  for (int k = 0; k < 40; ++k) {
    const double right = 1100.0 + 600.0 * std::sin(2.4 * k), up = 350.0 + 500.0 * std::cos(1.7 * k);
    const Vec3<double> from = {kDistance, 0, 0}, d = unit3(Vec3<double>{-kDistance, right, up});
    double sum = 0.0, weighted = 0.0, entry = 1e300;
    constexpr int kSteps = 20000;
    const double step = 2.0 * kDistance / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const Vec3<double> p = along3(from, (i + 0.5) * step, d);
      if (dot3(p, p) < 700.0 * 700.0) break;
      const Vec3<double> off = minus3(p, shell.middle);
      const double here = shell.density_at(dot3(off, off)) * step;
      if (here > 0.0 && entry > 1e299) entry = (i + 0.5) * step;
      sum += here;
      weighted += here * (i + 0.5) * step;
    }
    const tests::SunRay ray = tests::sun_ray(emitter, kDistance, right, up);
    EXPECT_NEAR(ray.rayleigh, 3.0 * sum, 3.0 * 2.0 * step * 0.1 + 1e-6 * sum);
    if (sum > 1.0) {
      ++lit;
      EXPECT_NEAR(ray.depth_km, weighted / sum, step);
      EXPECT_NEAR(ray.entry_km, entry, step);
    }
  }
  EXPECT_GE(lit, 15);
}

// It grows self-similarly: its front's distance, its middle's and its radius keep their ratios.
TEST(EjectionShell, GrowsInProportion) {
  Scene scene = a_scene();
  scene.ejections[0].acceleration_m_s2 = 300.0;
  const EjectionShell<double> first = shell_of(scene);
  scene.time.start_s = 2000.0;
  const EjectionShell<double> later = shell_of(scene);
  const double grown = later.outer / first.outer;
  EXPECT_GT(grown, 1.5);
  EXPECT_NEAR(length3(later.middle) / length3(first.middle), grown, 1e-12 * grown);
}

TEST(EjectionShell, DerivativesAreThoseOfItsLight) {
  Scene scene = a_scene();
  Ejection& j = scene.ejections[0];
  j.age_s = 700.0;
  const std::vector<double*> numbers = {&j.latitude_deg,
                                        &j.longitude_deg,
                                        &j.width_deg,
                                        &j.speed_km_s,
                                        &j.start_height,
                                        &j.age_s,
                                        &j.aspect,
                                        &j.density,
                                        &scene.sun.distance_km,
                                        &scene.sun.azimuth_deg,
                                        &scene.sun.longitude_deg};
  const NumberAs<FreeDual> number = tests::seeded({numbers.begin(), numbers.end()});
  const EjectionShellEmitter<FreeDual> dual({scene.sun, scene.time.start_s, j, number}, scene.sun,
                                            SunFrame<FreeDual>(scene.sun, number), {FreeDual(3.0)});
  // Some rays are ended by the photosphere, inside of the shell.
  std::vector<std::array<double, 2>> places;
  for (int k = 0; k < 14; ++k) places.push_back({500.0 + 70.0 * k, 350.0 + 150.0 * std::cos(1.7 * k)});
  const auto make = [&] { return std::make_unique<EjectionShellEmitter<double>>(emitter_of(scene)); };
  EXPECT_GE(tests::expect_light_derivatives(dual, numbers, make, kDistance, places, 0.0), 9);
}

}  // namespace
}  // namespace vegard::sim::ejection_shell_test
