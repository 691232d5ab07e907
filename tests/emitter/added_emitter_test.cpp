// A kind of emitter that a program adds to the registry is one as those that were built in.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "fit/fit.h"
#include "sim/base/error.h"
#include "sim/render/film.h"
#include "sim/render/render_memory.h"
#include "sim/render/volumes/scene_grid.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/emitter/glow_ball/glow_ball.h"
#include "tests/support/expect_error.h"
#include "tests/support/rendered_photo.h"

namespace vegard::tests::added_emitter_test {
namespace {

const char* const kScene = R"(
seed = 3
[emission]
lines = [557.7, 630.0]
[blur]
width_deg = [0.0, 0.0]
[camera]
width = 64
height = 48
hfov_deg = 40
azimuth_deg = 0
elevation_deg = 22
[[glow_ball]]
name = "lamp"
place_km = [3.0, 100.0, 40.0]
width_km = 6.0
rayleigh = [4000.0, 1000.0]
[[glow_ball]]
name = "spark"
place_km = [-18.0, 90.0, 45.0]
width_km = 3.0
rayleigh = [2000.0, 0.0]
[sensor]
response = "grey"
gain_per_kilorayleigh = 0.1
[sky]
level = [0.02, 0.02, 0.02]
[fit]
bands = 4
sky_terms = 1
model_error = 0.002
scan_points = 0
)";

sim::Scene two_balls() { return sim::parse_scene(kScene, "balls.toml"); }

double& number(sim::Scene& scene, const std::string& path) {
  return *sim::real_value(scene, sim::resolve(scene, path).front());
}

TEST(AddedEmitter, EveryKindHasBothHalvesOfItsRow) {
  std::set<std::string> kinds, makers;
  for (const sim::EmitterKind& kind : sim::emitter_kinds()) {
    EXPECT_TRUE(kinds.insert(kind.table).second) << kind.table;
    ASSERT_NE(kind.rows, nullptr) << kind.table;
    for (const sim::Declaration& d : kind.rows()) EXPECT_EQ(sim::kind_of_table(d.table), &kind) << d.table;
  }
  for (const sim::EmitterMaker& maker : sim::emitter_makers()) makers.insert(maker.table);
  EXPECT_EQ(kinds, makers);
  EXPECT_EQ(kinds.count("glow_ball"), 1u);
  EXPECT_EQ(sim::emitter_makers().back().table, "glow_ball");
}

TEST(AddedEmitter, NoneComesOnceTheyAreInUse) {
  const std::size_t before = sim::emitter_kinds().size();
  sim::EmitterKind late = glow_ball_kind();
  late.table = "late";
  EXPECT_THROW(sim::add_emitter_kind(late), std::logic_error);
  sim::EmitterMaker maker = glow_ball_maker();
  maker.table = "late";
  EXPECT_THROW(sim::add_emitter(late, maker), std::logic_error);
  EXPECT_THROW(sim::add_emitter(glow_ball_kind(), maker), std::logic_error) << "halves of two kinds";
  EXPECT_EQ(sim::emitter_kinds().size(), before);
}

TEST(AddedEmitter, IsReadWrittenSetAndChecked) {
  sim::Scene scene = two_balls();
  ASSERT_EQ(glow_balls().in(std::as_const(scene)).size(), 2u);
  EXPECT_EQ(number(scene, "glow_ball.lamp.place_km.up"), 40.0);
  sim::set_from_text(scene, "glow_ball.spark.width_km", "2.5");
  EXPECT_EQ(glow_balls().in(std::as_const(scene))[1].width_km, 2.5);
  const sim::Scene again = sim::parse_scene(sim::write_scene(scene), "again.toml");
  EXPECT_EQ(sim::write_scene(again), sim::write_scene(scene));

  // A copy has numbers of its own.
  sim::Scene copy = scene;
  number(copy, "glow_ball.lamp.width_km") = 1.0;
  EXPECT_EQ(number(scene, "glow_ball.lamp.width_km"), 6.0);

  const auto refused = [&](const std::string& path, const std::string& value) {
    sim::Scene other = scene;
    return tests::expect_error(sim::ErrorKind::scene, [&] {
      sim::set_from_text(other, path, value);
      sim::validate(other);
    });
  };
  EXPECT_NE(refused("glow_ball.lamp.width_km", "-1").find("outside the limits"), std::string::npos);
  EXPECT_NE(refused("glow_ball.lamp.rayleigh", "[1.0]").find("1 numbers for 2 emission lines"),
            std::string::npos);
  EXPECT_NE(refused("glow_ball.lamp.name", "\"spark\"").find("two of [[glow_ball]]"), std::string::npos);
  EXPECT_NE(refused("glow_ball.lamp.widht_km", "1").find("glow_ball.lamp.width_km"), std::string::npos);
  EXPECT_NE(refused("fit.free", "[\"glow_ball.lamp.rise_km_s\"]").find("the clock stands at 0"),
            std::string::npos);
}

TEST(AddedEmitter, ShinesAlongRaysWithItsDerivatives) {
  sim::Scene scene = two_balls();
  scene.time.start_s = 2.0;
  const std::vector<std::string> paths = {"glow_ball.lamp.place_km.up", "glow_ball.lamp.width_km",
                                          "glow_ball.lamp.rayleigh.6300", "glow_ball.spark.rise_km_s",
                                          "camera.elevation_deg"};
  std::vector<sim::ParameterId> free;
  for (const std::string& path : paths) free.push_back(sim::parameter_at(scene, path).value());
  const sim::FilmGeometry film = sim::film_for(scene, 0, 0, 64, 48, 1.0, 1.0);
  const sim::Volumes volumes(scene, 1);
  const std::size_t cells = static_cast<std::size_t>(film.columns) * film.rows;
  std::vector<float> derivative(2 * cells * free.size(), 0.0f);
  volumes.add_derivatives(scene, film, free, free.size(), derivative.data());
  const auto light_of = [&](const sim::Scene& of) { return volumes.light(of, film).rayleigh; };

  // The ray to the lamp's middle has all of its light, and a little of the other's.
  const auto light = light_of(scene);
  float most = 0.0f;
  for (std::size_t cell = 0; cell < cells; ++cell) most = std::max(most, light[cells + cell]);
  EXPECT_NEAR(most, 1000.0f, 5.0f) << "630.0 nm is the lamp's alone";

  for (std::size_t j = 0; j < paths.size(); ++j) {
    const double step = 1e-3;
    sim::Scene less = scene, more = scene;
    number(less, paths[j]) -= step;
    number(more, paths[j]) += step;
    const auto low = light_of(less), high = light_of(more);
    double largest = 0.0, off = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
      const double expected = (static_cast<double>(high[i]) - low[i]) / (2.0 * step);
      largest = std::max(largest, std::abs(expected));
      off = std::max(off, std::abs(expected - derivative[i * free.size() + j]));
    }
    EXPECT_GT(largest, 0.0) << paths[j];
    EXPECT_LT(off, 0.01 * largest + 0.3) << paths[j];  // films are floats: 4000 R have steps of 2e-4
  }
}

TEST(AddedEmitter, FillsGridsWithTheLightThatItHasAlongRays) {
  const sim::Scene scene = two_balls();
  sim::SceneGridOptions options;
  options.voxel = 1.0;
  options.threads = 1;
  const sim::SceneGrid made = sim::grid_of_scene(scene, options);
  // A Gaussian ball of column rayleigh in its middle has 2 pi width² of it in all, over kRayleighsPerKm.
  double sum = 0.0;
  for (const auto& [at, brick] : made.grid.bricks)
    for (int v = 0; v < sim::SparseGrid::kVoxels; ++v) sum += brick[static_cast<std::size_t>(v)];
  const double expected = 2.0 * 3.14159265358979 * (4000.0 * 36.0 + 2000.0 * 9.0) / sim::kRayleighsPerKm;
  EXPECT_NEAR(sum * options.voxel * options.voxel * options.voxel, expected, 0.01 * expected);
  options.voxel = 3.5;
  const std::string text =
      tests::expect_error(sim::ErrorKind::usage, [&] { sim::grid_of_scene(scene, options); });
  EXPECT_NE(text.find("glow_ball 'spark'"), std::string::npos) << text;
}

TEST(AddedEmitter, IsMadeAnewWhenItsTableOrTheClockChanges) {
  sim::Scene scene = two_balls();
  const sim::FilmGeometry film = sim::film_for(scene, 0, 0, 64, 48, 1.0, 1.0);
  sim::RenderMemory memory;
  const auto light = [&](const sim::Scene& of) {
    memory.look_at(of, 1);
    sim::Exposure exposure;
    memory.exposer(film).expose(of, exposure);
    return exposure.volumes.rayleigh;
  };
  const auto before = light(scene);
  sim::Scene wider = scene;
  number(wider, "glow_ball.lamp.width_km") = 8.0;
  EXPECT_NE(light(wider), before);
  EXPECT_EQ(light(scene), before);
  sim::Scene later = scene;
  number(later, "glow_ball.lamp.rise_km_s") = 1.0;
  const auto rising = light(later);
  later.time.start_s = 5.0;
  EXPECT_NE(light(later), rising) << "it moves with the clock";
}

// Noise of a hundredth of the lamp's light, of a fixed seed; three sigma of two numbers.
TEST(AddedEmitter, IsFoundAgainByAFit) {
  const sim::Scene truth = two_balls();
  const fit::Photo photo = noisy_photo(truth, 0.004, 21);
  sim::Scene start = truth;
  number(start, "glow_ball.lamp.width_km") = 8.0;
  number(start, "glow_ball.lamp.place_km.up") = 41.5;
  start.fit.free.clear();
  for (const char* path : {"glow_ball.lamp.width_km", "glow_ball.lamp.place_km.up"}) {
    sim::FreeParameter entry;
    entry.path = path;
    start.fit.free.push_back(entry);
  }
  sim::validate(start);
  const fit::FitResult result = fit::fit_photo(start, photo, {});
  EXPECT_NE(result.verdict, fit::Verdict::failed) << result.verdict_line;
  ASSERT_EQ(result.parameters.size(), 2u);
  for (const fit::FittedParameter& p : result.parameters) {
    const double true_value = *sim::real_value(truth, sim::resolve(truth, p.path).front());
    ASSERT_TRUE(p.sigma) << p.path << ": " << p.why_no_sigma;
    EXPECT_LT(std::abs(p.value - true_value), 3.0 * *p.sigma) << p.path << " = " << p.value;
    EXPECT_GT(std::abs(p.initial - true_value), 6.0 * *p.sigma) << p.path << " has not been displaced";
  }
}

}  // namespace
}  // namespace vegard::tests::added_emitter_test
