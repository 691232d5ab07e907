#include "sim/emit/footprint/footprint_emitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "march_case.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"
#include "tests/support/seeded_numbers.h"

namespace vegard::sim::curtain_emitter_test {
namespace {

using namespace march_case;

std::unique_ptr<Emitter<double>> curtain(const Scene& scene, MarchBy by = MarchBy::lanes) {
  return curtain_emitter<double>(
      scene, scene.footprints[0], maxwellian(), {}, [](const double& x) { return x; }, {}, by);
}

/// A straight arc to the north, from the west to the east.
Scene arc(const char* fall, double width_km = 2.0) {
  Scene scene = scene_at(0.0, "box", fall);
  Footprint& f = scene.footprints[0];
  f.model = FootprintModel::curtain;
  f.center_km = {0.0, 120.0};
  f.east_km = {-150.0, -40.0, 30.0, 150.0};
  f.north_km = {0.0, 0.0, 0.0, 0.0};
  f.width_km = width_km;
  return scene;
}

TEST(CurtainEmitter, SeenFaceOnHasTheLightOfTheVolume) {
  for (const std::string fall : {"vertical", "field", "dipole"}) {
    Scene scene = arc(fall == "dipole" ? "field" : fall.c_str());
    if (fall == "dipole") scene.field.model = FieldModel::dipole;
    scene.march.step_km = 0.5;
    const auto map = plane(-150.0, 100.0, 0.5, 600, 80, [](double, double north) {
      return 5.0 * std::exp(-0.5 * std::pow((north - 120.0) / 2.0, 2));
    });
    // All altitudes, since the volume is seen a little above and below where the wall is.
    Rays rays;
    for (int i = 0; i < 280; ++i) rays.add(10.0 + 0.25 * i, 3.0);
    const Light wall = rays.through(*curtain(scene), 3),
                volume = rays.through(*emitter(scene, map, maxwellian()), 3);
    double of_wall = 0.0, of_volume = 0.0, weighted = 0.0;
    for (std::size_t i = 0; i < rays.count(); ++i) {
      of_wall += wall.rayleigh[rays.count() + i];
      of_volume += volume.rayleigh[rays.count() + i];
      if (volume.rayleigh[rays.count() + i] > 1000.0)
        weighted = std::max(weighted, std::abs(wall.depth_km[i] / volume.depth_km[i] - 1.0));
    }
    EXPECT_GT(of_volume, 1e4);
    EXPECT_NEAR(of_wall / of_volume, 1.0, 0.01) << fall;
    EXPECT_LT(weighted, 0.02) << fall;
  }
}

TEST(CurtainEmitter, IsSeenFromBothSidesAndNotBeyondItsEnds) {
  const auto wall = curtain(arc("vertical"));
  Scene beyond = arc("vertical");
  beyond.footprints[0].center_km.north = -120.0;
  Rays north, south;
  north.add(40.0, 0.0);
  north.add(40.0, 75.0);  // passes the end
  south.add(40.0, 180.0);
  south.add(40.0, 105.0);
  const Light front = north.through(*wall, 3), back = south.through(*curtain(beyond), 3);
  EXPECT_GT(front.rayleigh[2], 100.0);
  EXPECT_NEAR(front.rayleigh[2] / back.rayleigh[2], 1.0, 1e-9);
  EXPECT_EQ(front.rayleigh[3], 0.0);
  EXPECT_EQ(south.through(*wall, 3).rayleigh[2], 0.0);
}

TEST(CurtainEmitter, IsNoBrighterAlongItselfThanAtThreeDegrees) {
  // From below the wall, along it: the path stays that at the least angle.
  Scene scene = arc("vertical");
  scene.footprints[0].center_km.north = 0.001;
  Rays rays;
  rays.add(60.0, 89.99);
  const Light light = rays.through(*curtain(scene), 3);
  const double path = 5.0 * 2.0 * 2.5066 / 0.052;
  double most = 0.0;
  const ProfileTable profiles = maxwellian();
  for (int row = 0; row < HeightProfile::kAltitudes; ++row)
    most = std::max(most,
                    static_cast<double>(profiles.of_energy[0].rate[static_cast<std::size_t>(row) * 4 + 1]));
  EXPECT_LE(light.rayleigh[1], 1.1 * kRayleighsPerKm * path * most);
}

// Two points make no closed curve, and so one wall, not a second one all along it.
TEST(CurtainEmitter, OfTwoPointsIsOneWallClosedOrNot) {
  Scene scene = arc("vertical");
  Footprint& f = scene.footprints[0];
  f.east_km = {-150.0, 150.0};
  f.north_km = {0.0, 0.0};
  Rays rays;
  for (int i = 0; i < 20; ++i) rays.add(30.0 + 2.0 * i, 3.0 + i);
  const Light open = rays.through(*curtain(scene), 3);
  f.closed = true;
  const Light closed = rays.through(*curtain(scene), 3);
  EXPECT_GT(*std::max_element(open.rayleigh.begin(), open.rayleigh.end()), 100.0);
  EXPECT_EQ(open.rayleigh, closed.rayleigh);
}

/// Curls around the zenith, folds that cross themselves, or an oval around the Earth.
Scene folded(double altitude_km, const char* shape, const char* fall, FieldModel field) {
  Scene scene = scene_at(altitude_km, shape, fall);
  scene.site.latitude_deg = 67.0;
  scene.site.time_utc = "2015-03-17T22:00:00Z";
  scene.field.model = field;
  Footprint& f = scene.footprints[0];
  f.model = FootprintModel::curtain;
  f.center_km = {10.0, 40.0};
  f.top_km = 600.0;
  constexpr int kPoints = 40;
  for (int i = 0; i < kPoints; ++i) {
    const double turn = 2.0 * kPi * i / kPoints;
    f.east_km.push_back(-500.0 + 25.0 * i + 60.0 * std::sin(3.0 * turn));
    f.north_km.push_back(250.0 * std::sin(turn) + 80.0 * std::cos(5.0 * turn));
    f.latitude_deg.push_back(68.0 + 3.0 * std::sin(4.0 * turn));
    f.longitude_deg.push_back(360.0 * i / kPoints);
  }
  f.closed = f.shape == FootprintShape::shell;
  return scene;
}

// A wall whose box were too small would lose light at its ends or at the top.
TEST(CurtainEmitter, FindsByItsBoxesTheLightOfAllWalls) {
  const struct {
    double altitude_km;
    const char *shape, *fall;
    FieldModel field;
  } cases[] = {
      {0.2, "box", "vertical", FieldModel::uniform}, {0.2, "box", "field", FieldModel::uniform},
      {0.2, "box", "field", FieldModel::dipole},     {0.2, "box", "field", FieldModel::igrf},
      {400.0, "box", "field", FieldModel::dipole},   {0.2, "shell", "field", FieldModel::dipole},
      {400.0, "shell", "field", FieldModel::dipole}, {20000.0, "shell", "field", FieldModel::dipole}};
  for (const auto& one : cases) {
    const Scene scene = folded(one.altitude_km, one.shape, one.fall, one.field);
    // From high above the Earth is 14 degrees in radius.
    const double lowest_deg = one.altitude_km > 100.0 ? -90.0 : 0.0,
                 range_deg = one.altitude_km > 1000.0 ? 20.0 : 90.0;
    Rays rays;
    for (std::uint32_t i = 0; i < 2500; ++i)
      rays.add(lowest_deg + range_deg * uniform(7, i), 360.0 * uniform(7, i, 1));
    const Light found = rays.through(*curtain(scene), 3),
                all = rays.through(*curtain(scene, MarchBy::reference), 3);
    const auto lit =
        std::count_if(all.rayleigh.begin(), all.rayleigh.end(), [](double r) { return r > 1.0; });
    EXPECT_GT(lit, one.altitude_km > 1000.0 ? 50 : 500) << one.shape << " " << one.altitude_km;
    EXPECT_EQ(found.rayleigh, all.rayleigh) << one.shape << " " << one.fall << " " << one.altitude_km;
    EXPECT_EQ(found.depth_km, all.depth_km);
    EXPECT_EQ(found.entry_km, all.entry_km);
  }
}

// The plane of an upright wall goes through the middle of the Earth and out on the other side.
TEST(CurtainEmitter, AroundTheEarthIsNotSeenOverTheAntipodes) {
  Scene scene = folded(2000.0, "shell", "field", FieldModel::dipole);
  Footprint& f = scene.footprints[0];
  f.closed = false;
  f.latitude_deg = {60.0, 60.0, 60.0};
  f.longitude_deg = {-30.0, 0.0, 30.0};
  const auto most = [&](double latitude_deg, double longitude_deg) {
    scene.site.latitude_deg = latitude_deg;
    scene.site.longitude_deg = longitude_deg;
    Rays rays;
    for (std::uint32_t i = 0; i < 4000; ++i) {
      rays.add(-90.0 + 50.0 * uniform(9, i), 360.0 * uniform(9, i, 1));
      if (rays.end_km.back() = ground_km(2000.0, rays.direction[2].back(), kEarthRadiusKm);
          !(rays.end_km.back() > 0.0))
        rays.end_km.back() = kInfinity;
    }
    const Light light = rays.through(*curtain(scene, MarchBy::reference), 3);
    return *std::max_element(light.rayleigh.begin(), light.rayleigh.end());
  };
  EXPECT_GT(most(60.0, 0.0), 1000.0);
  EXPECT_EQ(most(-60.0, 180.0), 0.0);
}

/// [line][ray], with the tangents of these numbers.
std::vector<FreeDual> dual_light(const Scene& scene, const std::vector<const double*>& free,
                                 const Rays& rays) {
  const auto emitter =
      curtain_emitter<FreeDual>(scene, scene.footprints[0], maxwellian(), {}, tests::seeded(free));
  const std::size_t count = rays.count();
  std::vector<FreeDual> direction[3], rayleigh(3 * count, FreeDual(0.0)), kept(3 * count, FreeDual(1.0));
  std::vector<double> entry(count, kInfinity), depth(count, kInfinity);
  for (int a = 0; a < 3; ++a) direction[a].assign(rays.direction[a].begin(), rays.direction[a].end());
  emitter->march({count, {direction[0].data(), direction[1].data(), direction[2].data()}, rays.end_km.data()},
                 {3, rayleigh.data(), kept.data(), entry.data(), depth.data()});
  return rayleigh;
}

// Light goes as width_km, and so its derivative is the light over it.
TEST(CurtainEmitter, HasItsDerivativeByWidth) {
  const Scene scene = arc("vertical", 2.5);
  Rays rays;
  for (int i = 0; i < 10; ++i) rays.add(30.0 + 4.0 * i, 3.0 + i);
  const std::vector<FreeDual> rayleigh = dual_light(scene, {&scene.footprints[0].width_km}, rays);
  const Light wider = [&] {
    Scene other = scene;
    other.footprints[0].width_km = 3.5;
    return rays.through(*curtain(other), 3);
  }();
  double most = 0.0;
  for (std::size_t i = 0; i < rayleigh.size(); ++i) {
    most = std::max(most, rayleigh[i].v);
    EXPECT_NEAR(rayleigh[i].d.t[0], wider.rayleigh[i] - rayleigh[i].v, 1e-9 * rayleigh[i].v);
  }
  EXPECT_GT(most, 100.0);
}

// The curve's points move its rays, and by its length the place where a closed curve's rays pass into each
// other.
TEST(CurtainEmitter, WithRaysHasItsDerivativesByItsPoints) {
  for (const bool closed : {false, true}) {
    Scene scene = arc("vertical");
    Footprint& f = scene.footprints[0];
    f.closed = closed;
    f.east_km = {10.0, 70.0, 0.0, -80.0};
    f.north_km = {-30.0, 20.0, 70.0, 15.0};
    f.ray_contrast = 0.6;
    f.ray_width_km = 12.0;
    scene.seed = 5;
    // The curve begins and ends in the south, next to the observer.
    Rays rays;
    for (int i = 0; i < 60; ++i) rays.add(52.3, -45.0 + 1.7 * i);
    const std::vector<double*> numbers = {&f.east_km[0], &f.north_km[0], &f.east_km[2], &f.north_km[2]};
    const std::vector<FreeDual> dual = dual_light(scene, {numbers.begin(), numbers.end()}, rays);
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      constexpr double kStep = 1e-5;
      const double was = *numbers[n];
      *numbers[n] = was + kStep;
      const Light more = rays.through(*curtain(scene), 3);
      *numbers[n] = was - kStep;
      const Light less = rays.through(*curtain(scene), 3);
      *numbers[n] = was;
      double most = 0.0;
      for (const FreeDual& light : dual) most = std::max(most, std::abs(light.d.t[n]));
      EXPECT_GT(most, 1.0);
      for (std::size_t i = 0; i < dual.size(); ++i)
        EXPECT_NEAR(dual[i].d.t[n], (more.rayleigh[i] - less.rayleigh[i]) / (2.0 * kStep), 1e-5 * most)
            << closed << " number " << n << " ray " << i;
    }
  }
}

}  // namespace
}  // namespace vegard::sim::curtain_emitter_test
