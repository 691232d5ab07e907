#include <gtest/gtest.h>

#include <cmath>

#include "march_case.h"
#include "sim/emit/footprint/footprint_emitter.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::footprint_field_test {
namespace {

using namespace march_case;

double spots(double east, double north) {
  return std::hypot(east - 40.0, north + 30.0) < 12.0 || std::hypot(east + 60.0, north - 50.0) < 5.0 ? 8.0
                                                                                                     : 0.0;
}

/// The light along a ray from samples of the field, 0.1 km apart.
double along(const LightField& field, double e, double n, double u, int line) {
  const int count = 6000;
  std::vector<double> x[3];
  for (int i = 0; i < count; ++i) {
    x[0].push_back(e * 0.1 * (i + 0.5)), x[1].push_back(n * 0.1 * (i + 0.5)),
        x[2].push_back(u * 0.1 * (i + 0.5));
  }
  std::vector<float> lines[3], density(count);
  for (auto& l : lines) l.resize(count);
  const double* points[3] = {x[0].data(), x[1].data(), x[2].data()};
  float* emission[3] = {lines[0].data(), lines[1].data(), lines[2].data()};
  field.sample(count, points, emission, density.data());
  double sum = 0.0;
  for (const float rate : lines[line]) sum += 0.1 * kRayleighsPerKm * rate;
  return sum;
}

TEST(FootprintField, HasTheLightThatTheMarchSees) {
  for (const char* fall : {"field", "vertical"}) {
    Scene scene = scene_at(0.0, "box", fall);
    const auto map = plane(-120.0, -120.0, 1.0, 240, 240, [](double east, double north) {
      return 5.0 * std::exp(-0.5 * (east * east + north * north) / 900.0);
    });
    const auto field = plane_footprint_field(scene, scene.footprints[0], map, maxwellian(), 1);
    Rays rays;
    rays.add(80.0, 30.0);
    scene.march.step_km = 0.1;
    const Light light = rays.through(*emitter(scene, map, maxwellian()), 3);
    for (int l = 0; l < 3; ++l) {
      const double sum = along(*field, rays.direction[0][0], rays.direction[1][0], rays.direction[2][0], l);
      EXPECT_NEAR(sum, light.rayleigh[l], 1e-3 * light.rayleigh[l]) << fall;
    }
  }
}

template <class Field>
void expect_dark_outside(const Field& field, double reach_km) {
  const Box3 bounds = field.bounds();
  int dark = 0, lit = 0;
  for (int i = 0; i < 400; ++i) {
    Box3 box;
    double x[3][27];
    for (int a = 0; a < 3; ++a) {
      const double low = bounds.low[a] - reach_km, high = bounds.high[a] + reach_km;
      box.low[a] = low + (high - low) * uniform(5, i, a);
      box.high[a] = box.low[a] + 16.0;
      for (int p = 0; p < 27; ++p)
        x[a][p] = box.low[a] + 8.0 * (p / static_cast<int>(std::pow(3, a) + 0.5) % 3);
    }
    float emission[27];
    float unused[2][27];
    const double* points[3] = {x[0], x[1], x[2]};
    float* lines[3] = {emission, unused[0], unused[1]};
    field.sample(27, points, lines, nullptr);
    const bool is_dark = field.is_dark(box);
    for (int p = 0; p < 27; ++p) {
      if (emission[p] == 0.0f) continue;
      ++lit;
      EXPECT_FALSE(is_dark);
      for (int a = 0; a < 3; ++a) {
        EXPECT_GE(x[a][p], bounds.low[a] - 1e-6);
        EXPECT_LE(x[a][p], bounds.high[a] + 1e-6);
      }
    }
    dark += is_dark ? 1 : 0;
  }
  EXPECT_GT(dark, 40);
  EXPECT_GT(lit, 40);
}

TEST(FootprintField, CallsNoBoxDarkThatShines) {
  for (const char* model : {"uniform", "dipole"}) {
    Scene scene = scene_at(0.0, "box", "field");
    scene.field.model = tests::kind_named<FieldModel>(model);
    scene.field.inclination_deg = 65.0;
    expect_dark_outside(*plane_footprint_field(scene, scene.footprints[0],
                                               plane(-100.0, -100.0, 1.0, 200, 200, spots), maxwellian(), 1),
                        20.0);
  }
  Scene shell = scene_at(0.0, "shell");
  shell.site.latitude_deg = 44.0;
  const auto globe = cube(128, [](const double* d) { return d[2] > 0.7 && d[0] > 0.68 ? 3.0 : 0.0; });
  expect_dark_outside(*cube_footprint_field(shell, shell.footprints[0], globe, maxwellian(), 1), 50.0);
}

}  // namespace
}  // namespace vegard::sim::footprint_field_test
