#include "sim/emit/footprint/footprint_emitter.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "march_case.h"
#include "sim/base/number/constants.h"
#include "sim/emit/footprint/footprint_kernel_types.h"
#include "sim/emit/footprint/lit_map.h"
#include "sim/light/form_profile.h"
#include "tests/support/glow.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::footprint_emitter_test {
namespace {

using namespace march_case;

constexpr double kDegree = 0.017453292519943295;

/// Kilometres of a ray from r0 between two spheres, before `end`, by the closed form.
double path_km(double observer_km, double up, double bottom_km, double top_km, double end = kInfinity,
               double sphere_km = kEarthRadiusKm) {
  const double r0 = sphere_km + observer_km, closest = -r0 * up;
  const auto until = [&](double altitude_km, double to) {  // kilometres inside a sphere, from 0 to `to`
    const double radius = sphere_km + altitude_km;
    const double half2 = closest * closest + radius * radius - r0 * r0;
    if (half2 <= 0.0) return 0.0;
    const double half = std::sqrt(half2);
    return std::max(0.0, std::min(closest + half, to) - std::max(0.0, closest - half));
  };
  return until(top_km, end) - until(bottom_km, end);
}

double patchy(double east, double north) {
  const double wave = std::sin(east * 0.03 + std::cos(north * 0.05) * 2.0) * std::sin(north * 0.02);
  return std::max(0.0, wave - 0.7) * 30.0;
}

double patchy_globe(const double d[3]) {
  return std::max(0.0, std::sin(9.0 * d[0] + 2.0) * std::sin(8.0 * d[1]) * std::cos(7.0 * d[2]) - 0.6) * 20.0;
}

Rays sky(int count, std::uint32_t seed, double lowest_deg, double highest_deg) {
  Rays rays;
  for (int i = 0; i < count; ++i)
    rays.add(lowest_deg + (highest_deg - lowest_deg) * uniform(seed, i, 0), 360.0 * uniform(seed, i, 1));
  return rays;
}

/// Of the Earth, or of a body as large as Jupiter.
class UniformShell : public ::testing::TestWithParam<double> {};

TEST_P(UniformShell, HasItsPathInClosedForm) {
  const auto even = cube(16, [](const double*) { return 2.0; });
  for (const double observer : {0.0, 10.0, 150.0, 400.0, 2000.0}) {
    Scene scene = scene_at(observer, "shell");
    scene.body.radius_km = GetParam();
    const auto shell = emitter(scene, even, drawn([](double) { return 50.0; }));
    const Rays rays = sky(200, 7, -89.0, 89.0);
    const Light light = rays.through(*shell, 2);
    int lit = 0;
    for (std::size_t i = 0; i < rays.count(); ++i) {
      // The path at the limb is exact; what is left is the rounding of floats.
      const double want =
          0.1 * 2.0 * 50.0 * path_km(observer, rays.direction[2][i], 80.0, 300.0, kInfinity, GetParam());
      EXPECT_NEAR(light.rayleigh[i], want, 3e-6 * want) << observer << " " << i;
      EXPECT_NEAR(light.rayleigh[rays.count() + i], 0.25 * want, 1e-6 * want);
      lit += want > 0.0 ? 1 : 0;
    }
    EXPECT_GT(lit, 30);
  }
}

INSTANTIATE_TEST_SUITE_P(FootprintEmitter, UniformShell, ::testing::Values(kEarthRadiusKm, 69911.0));

TEST(FootprintEmitter, BrightensAThinShellAtItsLimbAsTheClosedFormHasIt) {
  // A layer of four kilometres, with the ramps of its table's rows: so its mean over rows is the path between
  // the spheres at 108 and 112 km, each taken at the middle of the ramp, to second order in the ramp.
  Scene scene = scene_at(400.0, "shell");
  scene.march.step_km = 0.25;  // the layer's edges are sharp
  const auto layer = emitter(scene, cube(16, [](const double*) { return 1.0; }),
                             drawn([](double h) { return h > 107.9 && h < 112.1 ? 100.0 : 0.0; }));
  Rays rays;
  rays.add(-90.0, 0.0, 399.9);
  // Tangent within the layer, at 110 km; and 60 km below it.
  for (const double tangent : {110.0, 50.0})
    rays.add(-std::acos((kEarthRadiusKm + tangent) / (kEarthRadiusKm + 400.0)) / kDegree, 30.0);
  const Light light = rays.through(*layer, 2);
  const double expected = 0.1 * 100.0;
  EXPECT_NEAR(light.rayleigh[0], expected * 4.25, 1e-3 * expected);  // 17 rows
  for (int i : {1, 2}) {
    const double path = path_km(400.0, rays.direction[2][i], 107.875, 112.125);
    EXPECT_NEAR(light.rayleigh[i] / (expected * path), 1.0, 1e-3) << i;
  }
  EXPECT_GT(light.rayleigh[1], 70.0 * light.rayleigh[0]);
}

TEST(FootprintEmitter, StopsWhereTheRayDoes) {
  Scene scene = scene_at(400.0, "shell");
  const auto shell =
      emitter(scene, cube(16, [](const double*) { return 1.0; }), drawn([](double) { return 1.0; }));
  Rays rays;
  for (const double end : {50.0, 200.0, 350.0, 2000.0}) rays.add(-60.0, 100.0, end);
  const Light light = rays.through(*shell, 2);
  for (std::size_t i = 0; i < rays.count(); ++i) {
    const double want = 0.1 * path_km(400.0, rays.direction[2][i], 80.0, 300.0, rays.end_km[i]);
    EXPECT_NEAR(light.rayleigh[i], want, 1e-5 * want);
  }
  EXPECT_EQ(light.entry_km[0], kInfinity);
}

TEST(FootprintEmitter, SeesAGaussianTubeAcrossItsWidth) {
  // From within, level with the peak of a form, thirty kilometres before a straight arc to the north.
  Scene scene = scene_at(110.0, "box", "vertical");
  const double width = 3.0, flux = 5.0;
  const auto map = plane(-60.0, -30.0, 0.5, 240, 240, [&](double, double north) {
    return flux * std::exp(-0.5 * std::pow((north - 30.0) / width, 2));
  });
  ProfileTable table;
  table.of_energy.push_back(form_profile(tests::glow(), {557.7}, 3.0, {110.0, 8.0, 20.0}));
  const auto tube = emitter(scene, map, table);
  Rays rays;
  rays.add(0.0, 0.0);
  rays.add(0.0, 40.0);
  const Light light = rays.through(*tube, 1);
  const double rate = table.of_energy[0].rate[static_cast<std::size_t>((110 - 80) * 4) * 4];
  const double want = 0.1 * flux * width * std::sqrt(2.0 * std::acos(-1.0)) * rate;
  // Thirty kilometres on the ray is 0.07 km higher, where the form is dimmer by 1e-5; half a kilometre of
  // bilinear cells widens the Gaussian, but keeps its integral.
  EXPECT_NEAR(light.rayleigh[0] / want, 1.0, 1e-3);
  EXPECT_NEAR(light.rayleigh[1] / want * std::cos(40.0 * kDegree), 1.0, 1e-3);
  EXPECT_NEAR(light.depth_km[0], 30.0, 0.05);
  EXPECT_LT(light.entry_km[0], 30.0);
}

TEST(FootprintEmitter, AgreesInLanesWithDoublePrecision) {
  const Rays up = sky(150, 3, 2.0, 89.0), down = sky(150, 4, -80.0, 5.0);
  for (const char* fall : {"vertical", "field", "dipole", "igrf"}) {
    const bool own = fall == std::string("dipole") || fall == std::string("igrf");
    Scene scene = scene_at(0.5, "box", own ? "field" : fall);
    if (own) scene.field.model = tests::kind_named<FieldModel>(fall);
    scene.site.time_utc = "2012-03-04T00:00:00Z";
    const auto map = plane(-400.0, -300.0, 2.0, 400, 350, patchy);
    const Light lanes = up.through(*emitter(scene, map, maxwellian()), 3);
    const Light one = up.through(*emitter(scene, map, maxwellian(), MarchBy::reference), 3);
    const double peak = *std::max_element(one.rayleigh.begin(), one.rayleigh.end());
    ASSERT_GT(peak, 100.0);
    for (std::size_t i = 0; i < one.rayleigh.size(); ++i)
      EXPECT_NEAR(lanes.rayleigh[i], one.rayleigh[i], 1e-5 * peak) << fall << " " << i;
    for (std::size_t i = 0; i < up.count(); ++i) {
      if (one.rayleigh[i] < 1e-3 * peak) continue;
      EXPECT_NEAR(lanes.depth_km[i], one.depth_km[i], 0.05);
      EXPECT_NEAR(lanes.entry_km[i], one.entry_km[i], 1e-6);
    }
  }
  for (const char* model : {"uniform", "dipole", "igrf"}) {
    Scene scene = scene_at(400.0, "shell");
    scene.field.model = tests::kind_named<FieldModel>(model);
    scene.site.time_utc = "2012-03-04T00:00:00Z";
    const auto globe = cube(128, patchy_globe);
    const Light lanes = down.through(*emitter(scene, globe, maxwellian()), 3);
    const Light one = down.through(*emitter(scene, globe, maxwellian(), MarchBy::reference), 3);
    const double peak = *std::max_element(one.rayleigh.begin(), one.rayleigh.end());
    ASSERT_GT(peak, 100.0);
    // Along a field a float's rounding of the place is that of the foot times the slope of the way there.
    const double allowed = model == std::string("uniform") ? 1e-5 : 1e-4;
    for (std::size_t i = 0; i < one.rayleigh.size(); ++i)
      EXPECT_NEAR(lanes.rayleigh[i], one.rayleigh[i], allowed * peak) << model << " " << i;
  }
}

TEST(FootprintEmitter, AgreesWithABruteMarchOfShortSteps) {
  // The light of the default step of 2 km against that of 0.05 km, of an arc whose border is steep, in each
  // ray that is not dark against the others.
  Scene scene = scene_at(0.0, "box", "field");
  const auto map = plane(-400.0, -100.0, 1.0, 800, 400, [](double east, double north) {
    return 10.0 * std::exp(-0.5 * std::pow((north - 100.0 - 0.1 * east) / 6.0, 2));
  });
  ProfileTable steep;
  steep.of_energy.push_back(form_profile(tests::glow(), {630.0, 557.7}, 5.0, {105.0, 1.5, 25.0}));
  const Rays rays = sky(120, 11, 20.0, 70.0);
  const Light coarse = rays.through(*emitter(scene, map, steep), 2);
  scene.march.step_km = 0.05;
  const Light fine = rays.through(*emitter(scene, map, steep, MarchBy::reference), 2);
  const double peak = *std::max_element(fine.rayleigh.begin(), fine.rayleigh.end());
  for (std::size_t i = 0; i < fine.rayleigh.size(); ++i)
    EXPECT_NEAR(coarse.rayleigh[i], fine.rayleigh[i], 3e-3 * peak) << i;
}

TEST(FootprintEmitter, StepsNoFartherThanAThinFootprintAllows) {
  // An arc of 0.9 km on cells of 0.3 km: steps of 2 km read its peak too often or too seldom.
  for (const char* fall : {"vertical", "field", "dipole"}) {
    Scene scene = scene_at(0.0, "box", fall == std::string("dipole") ? "field" : fall);
    if (fall == std::string("dipole")) scene.field.model = FieldModel::dipole;
    const auto map = plane(0.0, 240.0, 0.3, 800, 400, [](double east, double north) {
      return 10.0 * std::exp(-0.5 * std::pow((north - 300.0 - 0.1 * (east - 120.0)) / 0.9, 2));
    });
    Rays rays;
    for (int i = 0; i < 150; ++i) rays.add(15.0 + 0.2 * i, 20.0);
    const Light coarse = rays.through(*emitter(scene, map, maxwellian()), 3);
    scene.march.step_cells = 100.0;
    const Light unlimited = rays.through(*emitter(scene, map, maxwellian()), 3);
    scene.march.step_km = 0.05;
    const Light fine = rays.through(*emitter(scene, map, maxwellian(), MarchBy::reference), 3);
    const double peak = *std::max_element(fine.rayleigh.begin(), fine.rayleigh.end());
    double total = 0.0, total_of_fine = 0.0, most = 0.0;
    for (std::size_t i = 0; i < fine.rayleigh.size(); ++i) {
      EXPECT_NEAR(coarse.rayleigh[i], fine.rayleigh[i], 5e-3 * peak) << fall << " " << i;
      most = std::max(most, std::abs(unlimited.rayleigh[i] - fine.rayleigh[i]));
      total += coarse.rayleigh[i];
      total_of_fine += fine.rayleigh[i];
    }
    EXPECT_NEAR(total, total_of_fine, 1e-3 * total_of_fine) << fall;
    EXPECT_GT(most, 5e-3 * peak) << fall;  // so the limit is what helped
  }
}

TEST(FootprintEmitter, PassesOverNothingThatShines) {
  // A block adds the same whether others are passed over or not, and those that are would have added zeros.
  const Rays up = sky(300, 21, 1.0, 89.0), down = sky(300, 22, -80.0, 20.0);
  const auto compare = [&](const Scene& scene, const auto& map, const Rays& rays) {
    Scene through = scene;
    through.march.skip = false;
    const Light with = rays.through(*emitter(scene, map, maxwellian()), 3);
    const Light without = rays.through(*emitter(through, map, maxwellian()), 3);
    double sum = 0.0;
    for (std::size_t i = 0; i < with.rayleigh.size(); ++i) {
      EXPECT_EQ(with.rayleigh[i], without.rayleigh[i]) << i;
      sum += with.rayleigh[i];
    }
    EXPECT_GT(sum, 1000.0);
    EXPECT_EQ(with.entry_km, without.entry_km);
    EXPECT_EQ(with.depth_km, without.depth_km);
  };
  const auto spots = [](double east, double north) {
    return std::hypot(east - 150.0, north + 90.0) < 20.0 || std::hypot(east + 100.0, north - 200.0) < 5.0
               ? 8.0
               : 0.0;
  };
  for (const char* model : {"uniform", "dipole", "igrf"}) {
    Scene scene = scene_at(0.0, "box", "field");
    scene.site.time_utc = "2012-03-04T00:00:00Z";
    scene.field.model = tests::kind_named<FieldModel>(model);
    scene.field.inclination_deg = 60.0;
    compare(scene, plane(-300.0, -250.0, 1.0, 600, 550, spots), up);
    compare(scene, plane(-300.0, -250.0, 1.0, 600, 550, patchy), up);
  }
  compare(scene_at(0.0, "box", "vertical"), plane(-300.0, -250.0, 1.0, 600, 550, spots), up);
  compare(scene_at(300.0, "box", "field"), plane(-300.0, -250.0, 1.0, 600, 550, patchy), down);
  // From places whose rays cross the edges and corners of the cube's faces.
  for (const char* model : {"uniform", "dipole", "igrf"})
    for (const double latitude : {0.0, 35.3, 46.0, 89.0}) {
      Scene scene = scene_at(400.0, "shell");
      scene.site.latitude_deg = latitude;
      scene.site.longitude_deg = 45.0;
      scene.field.model = tests::kind_named<FieldModel>(model);
      scene.site.time_utc = "2012-03-04T00:00:00Z";
      // Near the equator a field's feet run away: there is aurora from some 50 degrees on.
      const auto polar = [](const double d[3]) { return std::abs(d[2]) > 0.75 ? patchy_globe(d) : 0.0; };
      if (model == std::string("uniform"))
        compare(scene, cube(256, patchy_globe), down);
      else if (latitude > 40.0)
        compare(scene, cube(256, polar), down);
    }
}

TEST(FootprintEmitter, PassesOverWhatIsDark) {
  // From the ground, to a spot of 20 km in a map of 600 km: all of a ray but the blocks about the spot.
  const Scene scene = scene_at(0.0, "box", "vertical");
  const auto map = plane(-300.0, -300.0, 1.0, 600, 600, [](double east, double north) {
    return std::hypot(east - 150.0, north + 90.0) < 20.0 ? 8.0 : 0.0;
  });
  const StepProfile profile(maxwellian(), scene.footprints[0].top_km, scene.march.step_km);
  const MarchRays cutter(scene, scene.footprints[0], profile.bottom_km());
  const TexelStore texels(map.grid, 1e-3, false);
  const LitMap lit = plane_lit_map(600, 600, lit_texels(map.grid, 1e-3), 1);
  FootprintKernel kernel;
  kernel.first_x = kernel.first_y = 300.0 - 0.5;
  kernel.window[0] = texels.window();
  kernel.profile = &profile;
  const Rays rays = sky(300, 23, 5.0, 60.0);
  std::vector<MarchSpan> spans;
  for (std::size_t i = 0; i < rays.count(); ++i) {
    const double enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
    MarchSpan cut[2];
    const int count = cutter.cut(enu, kInfinity, cut);
    spans.insert(spans.end(), cut, cut + count);
  }
  std::vector<SpanLight> light(spans.size());
  const std::size_t all = sim::march_spans(kernel, spans.data(), spans.size(), light.data());
  kernel.lit[0] = &lit;
  const std::size_t marched = sim::march_spans(kernel, spans.data(), spans.size(), light.data());
  EXPECT_GT(marched, 0u);
  EXPECT_LT(marched, all / 10);
}

TEST(FootprintEmitter, GivesTheSameBitsOnEveryInstructionSet) {
  const Rays up = sky(100, 31, 1.0, 89.0), down = sky(100, 32, -80.0, 20.0);
  Scene box = scene_at(0.0, "box", "field"), dipole = box, shell = scene_at(400.0, "shell");
  dipole.field.model = FieldModel::dipole;
  Scene reference = box, round = shell;
  reference.field.model = round.field.model = FieldModel::igrf;
  reference.site.time_utc = round.site.time_utc = "2012-03-04T00:00:00Z";
  auto map = plane(-300.0, -250.0, 1.0, 600, 550, patchy);
  const auto of_box = emitter(box, map, maxwellian()), of_dipole = emitter(dipole, map, maxwellian());
  const auto of_shell = emitter(shell, cube(256, patchy_globe), maxwellian()),
             of_round = emitter(round, cube(256, patchy_globe), maxwellian());
  const auto of_reference = emitter(reference, map, maxwellian());
  const auto all = [&] {
    std::vector<double> light;
    for (const auto& [rays, from] : {std::pair{&up, of_box.get()},
                                     {&up, of_dipole.get()},
                                     {&down, of_shell.get()},
                                     {&up, of_reference.get()},
                                     {&down, of_round.get()}}) {
      const Light seen = rays->through(*from, 3);
      light.insert(light.end(), seen.rayleigh.begin(), seen.rayleigh.end());
      light.insert(light.end(), seen.depth_km.begin(), seen.depth_km.end());
    }
    return light;
  };
  const std::vector<double> here = all();
  for (const std::int64_t target : {std::int64_t{HWY_SSE4}, std::int64_t{HWY_AVX2}, std::int64_t{HWY_AVX3}}) {
    if ((hwy::SupportedTargets() & target) == 0) continue;
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(all(), here) << hwy::TargetName(target);
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST(FootprintEmitter, HasNoSeamsBetweenTheFaces) {
  // A footprint that is linear in the direction is nearly so on each face: across an edge its light must not
  // step by more than between neighbours elsewhere.
  Scene scene = scene_at(400.0, "shell");
  scene.site.latitude_deg = 45.0;
  scene.site.longitude_deg = 0.0;
  const auto shell =
      emitter(scene, cube(64, [](const double* d) { return 5.0 + d[0] + 2.0 * d[1] - d[2]; }), maxwellian());
  Rays rays;
  for (int i = 0; i <= 200; ++i) rays.add(-90.0 + 0.1 * std::abs(i - 100), i < 100 ? 180.0 : 0.0, 399.0);
  const Light light = rays.through(*shell, 3);
  double most = 0.0;
  for (std::size_t i = 2; i < rays.count(); ++i)
    most = std::max(most, std::abs(light.rayleigh[i] - 2.0 * light.rayleigh[i - 1] + light.rayleigh[i - 2]));
  EXPECT_LT(most, 2e-4 * light.rayleigh[100]);
}

TEST(FootprintEmitter, LosesTheNearHalfOfTheEarthByTheLiteralRuleOnly) {
  const auto even = cube(16, [](const double*) { return 1.0; });
  const auto flat = drawn([](double) { return 1.0; });
  // From orbit: down to the ground; along the limb; up.
  Rays from_orbit;
  from_orbit.add(-60.0, 0.0, 500.0);
  from_orbit.add(-15.0, 0.0);
  from_orbit.add(30.0, 0.0);
  Scene scene = scene_at(400.0, "shell");
  const Light span = from_orbit.through(*emitter(scene, even, flat), 2);
  scene.march.ghosts = GhostRule::literal;
  const Light literal = from_orbit.through(*emitter(scene, even, flat), 2);
  EXPECT_GT(span.rayleigh[0], 0.0);
  EXPECT_EQ(literal.rayleigh[0], 0.0);
  EXPECT_NEAR(literal.rayleigh[1] / span.rayleigh[1], 0.5, 1e-6);
  EXPECT_EQ(span.rayleigh[2], 0.0);
  EXPECT_GT(literal.rayleigh[2], 0.0);  // a ghost: it lies behind the camera
  // From within the shell what lies behind the camera is a ghost that the literal rule lets through.
  Rays within;
  within.add(20.0, 0.0);
  Scene high = scene_at(200.0, "shell");
  const double ahead = 0.1 * path_km(200.0, within.direction[2][0], 80.0, 300.0);
  EXPECT_NEAR(within.through(*emitter(high, even, flat), 2).rayleigh[0], ahead, 1e-5 * ahead);
  high.march.ghosts = GhostRule::literal;
  EXPECT_GT(within.through(*emitter(high, even, flat), 2).rayleigh[0], 1.1 * ahead);
  // From the ground the two rules agree.
  Rays from_ground;
  from_ground.add(5.0, 10.0);
  from_ground.add(80.0, 10.0);
  Scene ground = scene_at(0.0, "shell");
  const Light here = from_ground.through(*emitter(ground, even, flat), 2);
  ground.march.ghosts = GhostRule::literal;
  EXPECT_EQ(from_ground.through(*emitter(ground, even, flat), 2).rayleigh, here.rayleigh);
}

TEST(FootprintEmitter, FollowsTheEnergyOfTheFoot) {
  // Two energies side by side, in a table of three: each half as by a profile of its own.
  Scene scene = scene_at(0.0, "box", "vertical");
  auto map = plane(-200.0, -200.0, 2.0, 200, 200, [](double, double) { return 1.0; });
  for (int i = 0; i < 200 * 200; ++i) map.grid.ln_energy.push_back(i % 200 < 100 ? 0.0 : std::log(4.0));
  ProfileTable table;
  table.ln_step = std::log(2.0);
  for (const double energy : {2.0, 4.0, 8.0}) table.of_energy.push_back(maxwellian(energy).of_energy[0]);
  Rays rays;
  rays.add(60.0, -90.0);
  rays.add(60.0, 90.0);
  for (const MarchBy by : {MarchBy::lanes, MarchBy::reference}) {
    const Light light = rays.through(*emitter(scene, map, table, by), 3);
    map.grid.ln_energy.clear();
    const Light soft = rays.through(*emitter(scene, map, maxwellian(2.0), by), 3);
    const Light hard = rays.through(*emitter(scene, map, maxwellian(8.0), by), 3);
    for (int l = 0; l < 3; ++l) {
      EXPECT_NEAR(light.rayleigh[2 * l], soft.rayleigh[2 * l], 1e-5 * soft.rayleigh[2 * l]);
      EXPECT_NEAR(light.rayleigh[2 * l + 1], hard.rayleigh[2 * l + 1], 1e-5 * hard.rayleigh[2 * l + 1]);
    }
    for (int i = 0; i < 200 * 200; ++i) map.grid.ln_energy.push_back(i % 200 < 100 ? 0.0 : std::log(4.0));
  }
}

}  // namespace
}  // namespace vegard::sim::footprint_emitter_test
