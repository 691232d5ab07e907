// Altitudes and projection over double and over packs, for the instruction set that this file is compiled
// for.
#include "sim/scene/structs/light.h"
#include "sim/view/camera/lens-inl.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::project_test {
namespace {

using HWY_NAMESPACE::Pack;

const HWY_NAMESPACE::SphereScale kEarth(kEarthRadiusKm);

float first_lane(Pack pack) { return hwy::HWY_NAMESPACE::GetLane(pack.v); }

TEST(AltitudeKm, IsThatOfTheSphereWithinTwoCentimetres) {
  // Floats are good to some 6e-8 of the altitude more.
  for (double altitude = 0.0; altitude <= 650.0; altitude += 0.7) {
    const double excess = std::pow(kEarthRadiusKm + altitude, 2) - std::pow(kEarthRadiusKm, 2);
    EXPECT_NEAR(HWY_NAMESPACE::altitude_km(excess, kEarth), altitude, 2e-5);
    EXPECT_NEAR(first_lane(HWY_NAMESPACE::altitude_km(Pack(excess), kEarth)), altitude,
                2e-5 + 3e-7 * altitude);
  }
}

TEST(AltitudeKm, RisesFromTheEarthsCentreToTwoRadii) {
  double before = -1e9;
  for (double distance = 0.0; distance <= 2.0; distance += 0.001) {
    const double altitude =
        HWY_NAMESPACE::altitude_km(kEarthRadiusKm * kEarthRadiusKm * (distance * distance - 1.0), kEarth);
    EXPECT_GT(altitude, before) << distance;
    before = altitude;
  }
}

TEST(BeamAltitude, IsTheExcessOfThePointOverTheSphere) {
  const FallFrame<double> frame = fall_frame<double>(72.0 * kRadiansPerDegree, 0.3);
  const double observer_km = 0.4, start[3] = {-120.0, 310.0, 480.0};
  double axes[3][3];
  for (int i = 0; i < 3; ++i) {
    axes[0][i] = frame.along[i];
    axes[1][i] = frame.across1[i];
    axes[2][i] = frame.across2[i];
  }
  HWY_NAMESPACE::BeamAltitude<double> beam;
  beam.start(start, observer_km, axes, kEarthRadiusKm);
  for (double along : {0.0, 3.0, 250.0, 430.0})
    for (double across : {-9.0, 0.0, 4.0}) {
      const double way[3] = {along, across, 0.5 * across};
      double point[3];
      for (int i = 0; i < 3; ++i)
        point[i] = start[i] + way[0] * axes[0][i] + way[1] * axes[1][i] + way[2] * axes[2][i];
      const double distance =
          std::hypot(std::hypot(point[0], point[1]), point[2] + kEarthRadiusKm + observer_km);
      EXPECT_NEAR(beam.excess_km2(way), distance * distance - kEarthRadiusKm * kEarthRadiusKm, 1e-6);
    }
}

/// Points of the sky before a camera, seen by a film of the kernel, beside the lens as it is defined.
template <template <class> class Film>
void expect_seen_as_projected(const Camera& camera, double tolerance) {
  const Lens<double> lens = camera_view(camera).lens;
  const Lens<LocalDual> dual = camera_view<LocalDual>(camera, [&](CameraNumber which) {
                                 return LocalDual(camera_number(camera, which));
                               }).lens;
  FilmGeometry geometry;
  geometry.x0_px = -7.0;
  geometry.y0_px = -5.0;
  geometry.cell_width_px = 1.0;
  geometry.cell_height_px = 2.0;
  geometry.columns = camera.width + 14;
  geometry.rows = camera.height / 2 + 5;
  Film<double> film;
  film.set(dual, geometry, [](const LocalDual& number, double& to) { to = number.v; });
  int seen_points = 0;
  for (double polar = 0.02; polar < 1.9; polar += 0.13)
    for (double turn = 0.1; turn < 6.2; turn += 0.7) {
      const double range = 300.0 + 40.0 * turn;
      const double point[3] = {range * std::sin(polar) * std::cos(turn),
                               range * std::sin(polar) * std::sin(turn), range * std::cos(polar)};
      double x = 0.0, y = 0.0;
      bool visible = false;
      const auto seen = film.template see<double>(point, visible);
      if (!project(lens, point, x, y)) {
        EXPECT_FALSE(visible) << polar << " rad off the axis";
        continue;
      }
      if (x < 0.0 || y < 0.0 || x > camera.width || y > camera.height) continue;
      ++seen_points;
      EXPECT_TRUE(visible);
      EXPECT_NEAR(seen.column, x + 7.0 - 0.5, tolerance);
      EXPECT_NEAR(seen.row, (y + 5.0) / 2.0 - 0.5, tolerance);
      const double steradians_of_cell = 2.0 * pixel_steradians(lens, x, y);
      EXPECT_NEAR(seen.per_steradian_cell * range * range * steradians_of_cell, 1.0, 1e-6);
    }
  EXPECT_GT(seen_points, 40);
}

TEST(PinholeFilm, SeesPointsWhereTheLensDrawsThem) {
  Camera camera;
  camera.hfov_deg = 100.0;
  camera.aspect = 0.96;
  camera.mirrored = true;
  camera.principal_x_px = 12.0;
  expect_seen_as_projected<HWY_NAMESPACE::PinholeFilm>(camera, 1e-9);
  HWY_NAMESPACE::PinholeFilm<double> film;
  film.set(Lens<LocalDual>{}, FilmGeometry{}, [](const LocalDual&, double& to) { to = 1.0; });
  bool in_front = true;
  const double behind[3] = {1.0, 1.0, -5.0};
  film.see<double>(behind, in_front);
  EXPECT_FALSE(in_front);
}

class LensFilmOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Model, LensFilmOf,
                         testing::Values("pinhole", "equidistant", "equisolid", "stereographic",
                                         "orthographic", "polynomial"));

TEST_P(LensFilmOf, SeesPointsWhereTheLensDrawsThem) {
  Camera camera;
  camera.model = tests::kind_named<LensModel>(GetParam());
  camera.width = 720;
  camera.height = 640;
  camera.hfov_deg = 105.0;
  camera.focal_px = 200.0;
  camera.principal_x_px = -11.0;
  camera.aspect = 1.04;
  camera.mirrored = true;
  if (camera.model == LensModel::pinhole || camera.model == LensModel::polynomial) {
    camera.k1 = -0.05;
    camera.k2 = 0.004;
    camera.k3 = 0.0003;
  }
  camera.p1 = 0.003;
  camera.p2 = -0.002;
  // The series is good to 1e-7 of a radian times the focal length.
  expect_seen_as_projected<HWY_NAMESPACE::LensFilm>(camera, 3e-5);
}

}  // namespace
}  // namespace vegard::sim::project_test
